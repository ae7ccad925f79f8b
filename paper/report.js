// What the page does beyond showing: folding, sorting, filtering, enlarging. Without it everything is there, unfolded.
"use strict";

const all = (selector, within = document) => [...within.querySelectorAll(selector)];

function element(tag, properties, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

// ---- Folding. The browser unfolds what its search finds and what a link leads to.

function fold(button, folded) {
  button.setAttribute("aria-expanded", String(!folded));
  const body = document.getElementById(button.getAttribute("aria-controls"));
  if (folded) body.setAttribute("hidden", "until-found");
  else body.removeAttribute("hidden");
}

for (const heading of all("main h2[data-body]")) {
  const title = heading.querySelector("span");
  const button = element("button", { type: "button" }, ...title.childNodes);
  const body = heading.dataset.body;
  title.replaceWith(button);
  button.setAttribute("aria-controls", body);
  fold(button, "folded" in heading.dataset);
  button.addEventListener("click", () => fold(button, button.getAttribute("aria-expanded") === "true"));
  document.getElementById(body).addEventListener("beforematch", () => fold(button, false));
}

function foldAll(folded) {
  all("h2 button").forEach((button) => fold(button, folded));
  all("main details").forEach((details) => { details.open = !folded; });
}

// ---- Tables.

const collator = new Intl.Collator("en", { numeric: true });

// The number that a cell begins with; what has none comes last.
function leading(text) {
  const found = /^[-+]?(inf|\d+\.?\d*(e[-+]?\d+)?)/.exec(text);
  return found ? Number(found[0].replace("inf", "Infinity")) : NaN;
}

function compare(a, b) {
  const [x, y] = [leading(a), leading(b)];
  if (Number.isNaN(x) !== Number.isNaN(y)) return Number.isNaN(x) ? 1 : -1;
  return x < y ? -1 : x > y ? 1 : collator.compare(a, b);
}

function sortable(table) {
  const body = table.tBodies[0];
  const rows = [...body.rows]; // as written
  const heads = [...table.tHead.rows[0].cells];
  heads.forEach((head, column) => {
    const button = element("button", { type: "button" }, ...head.childNodes);
    head.append(button);
    button.addEventListener("click", () => {
      const next = { ascending: "descending", descending: null }[head.getAttribute("aria-sort")];
      heads.forEach((other) => other.removeAttribute("aria-sort"));
      const sign = next === "descending" ? -1 : 1;
      const text = (row) => row.cells[column].textContent.trim();
      if (next === null) return body.append(...rows);
      head.setAttribute("aria-sort", next ?? "ascending");
      return body.append(...rows.toSorted((a, b) => sign * compare(text(a), text(b))));
    });
  });
}

function filterable(table) {
  const rows = [...table.tBodies[0].rows];
  const input = element("input", { type: "search" });
  const count = element("output", {});
  const label = element("label", {}, "Rows with ", input);
  input.setAttribute("aria-label", `Show rows of table ${table.id.replace("table-", "")} with these words`);
  table.parentElement.before(element("p", { className: "filter" }, label, " ", count));
  input.addEventListener("input", () => {
    const words = input.value.toLowerCase().split(/\s+/);
    for (const row of rows) row.hidden = !words.every((word) => row.textContent.toLowerCase().includes(word));
    count.value = `${rows.filter((row) => !row.hidden).length} of ${rows.length} rows`;
  });
}

for (const table of all("main table")) {
  const rows = table.tBodies[0].rows.length;
  if (rows > 2) sortable(table);
  if (rows > 8) filterable(table);
}

// ---- Enlarged figures, in a dialog that scrolls.

const dialog = document.querySelector("dialog");
const stage = dialog.querySelector("div");
let scale = 1;

function enlarge(factor) {
  scale = Math.min(Math.max(scale * factor, 0.5), 16);
  stage.firstElementChild.style.cssText = `max-width: none; width: ${100 * scale}%`;
}

for (const figure of all("figure:has(svg)")) {
  const name = figure.querySelector(".anchor").textContent.toLowerCase();
  const button = element("button", { type: "button", textContent: "Enlarge" });
  button.setAttribute("aria-label", `Enlarge ${name}`);
  figure.querySelector("figcaption").append(" ", button);
  button.addEventListener("click", () => {
    stage.replaceChildren(figure.querySelector("svg").cloneNode(true));
    scale = 1;
    enlarge(1);
    dialog.showModal();
  });
}
for (const button of all("button[data-factor]", dialog)) button.addEventListener("click", () => enlarge(Number(button.dataset.factor)));
dialog.addEventListener("keydown", (event) => {
  if ("+=".includes(event.key)) enlarge(1.5);
  if (event.key === "-") enlarge(1 / 1.5);
});

// ---- Contents.

const contents = document.querySelector("nav details");
if (matchMedia("(max-width: 60rem)").matches) contents.open = false;
contents.append(element("p", {},
  element("button", { type: "button", textContent: "Fold all", onclick: () => foldAll(true) }), " ",
  element("button", { type: "button", textContent: "Unfold all", onclick: () => foldAll(false) })));

const links = new Map(all("nav ol a").map((link) => [link.hash.slice(1), link]));
const seen = new IntersectionObserver((entries) => {
  for (const entry of entries.filter((found) => found.isIntersecting)) {
    links.forEach((link) => link.removeAttribute("aria-current"));
    links.get(entry.target.id)?.setAttribute("aria-current", "true");
  }
}, { rootMargin: "-10% 0px -80% 0px" });
all("main > section[id]").forEach((section) => seen.observe(section));
