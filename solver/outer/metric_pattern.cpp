#include "outer/metric_pattern.h"

#include <metis.h>

#include <algorithm>
#include <new>
#include <numeric>
#include <utility>

namespace pbd {
namespace {

/// Neighbours of each column, in one list.
struct Graph {
  std::vector<idx_t> start, neighbour;
};

Graph graph_of(int count, const std::vector<int>& column, const std::vector<MetricEntry>& entries) {
  std::vector<std::array<int, 2>> links;
  for (const auto& entry : entries) {
    const int a = column[entry.row], b = column[entry.column];
    if (a < 0 || b < 0 || a == b) continue;
    links.push_back({a, b});
    links.push_back({b, a});
  }
  std::sort(links.begin(), links.end());
  links.erase(std::unique(links.begin(), links.end()), links.end());
  Graph graph;
  graph.start.assign(static_cast<std::size_t>(count) + 1, 0);
  for (const auto& [a, b] : links) {
    ++graph.start[static_cast<std::size_t>(a) + 1];
    graph.neighbour.push_back(b);
  }
  std::partial_sum(graph.start.begin(), graph.start.end(), graph.start.begin());
  return graph;
}

/// Order that leaves little fill: the column that comes k-th, for each k.
std::vector<int> dissected(Graph graph) {
  auto count = static_cast<idx_t>(graph.start.size()) - 1;
  std::vector<int> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  if (graph.neighbour.empty()) return order;  // METIS takes no graph without edges
  std::vector<idx_t> found(order.size()), place(order.size());
  const int outcome = METIS_NodeND(&count, graph.start.data(), graph.neighbour.data(), nullptr, nullptr,
                                   found.data(), place.data());
  if (outcome != METIS_OK) throw std::bad_alloc();
  std::copy(found.begin(), found.end(), order.begin());
  return order;
}

std::vector<int> inverse_of(const std::vector<int>& order) {
  std::vector<int> place(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) place[order[k]] = static_cast<int>(k);
  return place;
}

/// Parents in the elimination tree of the ordered matrix, -1 of roots (liu1990role).
std::vector<int> elimination_tree(const Graph& graph, const std::vector<int>& order,
                                  const std::vector<int>& place) {
  std::vector<int> parent(order.size(), -1), ancestor(parent);
  for (int k = 0; k < std::ssize(order); ++k)
    for (idx_t i = graph.start[order[k]]; i < graph.start[order[k] + 1]; ++i) {
      int j = place[graph.neighbour[i]];
      while (j >= 0 && j < k) {
        const int next = std::exchange(ancestor[j], k);
        if (next < 0) parent[j] = k;
        j = next;
      }
    }
  return parent;
}

/// Children before their parents, the last child next to its parent: the k-th column for each k.
std::vector<int> postorder(const std::vector<int>& parent) {
  const auto count = static_cast<int>(parent.size());
  std::vector<int> child(parent.size(), -1), sibling(child), order, waiting;
  for (int j = count - 1; j >= 0; --j)
    if (parent[j] >= 0) sibling[j] = std::exchange(child[parent[j]], j);
  for (int root = 0; root < count; ++root) {
    if (parent[root] >= 0) continue;
    for (waiting = {root}; !waiting.empty();) {
      const int j = waiting.back();
      if (child[j] >= 0) {
        waiting.push_back(std::exchange(child[j], sibling[child[j]]));
      } else {
        order.push_back(j);
        waiting.pop_back();
      }
    }
  }
  return order;
}

struct Panel {
  int first, width;
  std::vector<int> row;  // below
  double zeros = 0;      // blocks that are stored and zero
  double size() const { return width * (width + 1) / 2.0 + static_cast<double>(width * row.size()); }
};

/// True if `next`, which follows, takes `panel` in: few more zeros are stored.
bool joins(const Panel& panel, const Panel& next, double& zeros) {
  constexpr double few = 0.1, some = 0.5;  // of the blocks stored: less than narrow panels lose
  constexpr int narrow = 4;                // columns
  if (panel.row.empty() || panel.row.front() != panel.first + panel.width) return false;
  Panel both{panel.first, panel.width + next.width, next.row};
  zeros = both.size() - (panel.size() - panel.zeros) - (next.size() - next.zeros);
  return zeros <= (both.width <= narrow ? some : few) * both.size();
}

/// Panels of columns in postorder, from the rows of each that its neighbours and children have.
std::vector<Panel> panels_of(const Graph& graph, const std::vector<int>& order,
                             const std::vector<int>& place) {
  const auto count = static_cast<int>(order.size());
  std::vector<Panel> panels;
  std::vector<std::vector<std::size_t>> children(order.size());  // panels whose first row below it is
  std::vector<int> mark(order.size(), -1), rows;
  const auto close = [&](Panel&& panel) {
    if (!panel.row.empty()) children[panel.row.front()].push_back(panels.size());
    panels.push_back(std::move(panel));
  };
  Panel open{0, 0, {}};
  for (int j = 0; j < count; ++j) {
    rows.clear();
    const auto add = [&](int i) {
      if (i > j && std::exchange(mark[i], j) != j) rows.push_back(i);
    };
    for (idx_t i = graph.start[order[j]]; i < graph.start[order[j] + 1]; ++i) add(place[graph.neighbour[i]]);
    const bool continues = open.width > 0 && !open.row.empty() && open.row.front() == j;
    if (continues)
      for (const int i : open.row) add(i);
    for (const std::size_t child : children[j])
      for (const int i : panels[child].row) add(i);
    if (continues && rows.size() + 1 == open.row.size()) {
      open.row.erase(open.row.begin());
      ++open.width;
      continue;
    }
    if (open.width > 0) close(std::move(open));
    std::sort(rows.begin(), rows.end());
    open = {j, 1, rows};
  }
  if (open.width > 0) close(std::move(open));
  return panels;
}

/// Panels of which narrow ones have been taken in by those that follow.
std::vector<Panel> joined(std::vector<Panel> panels) {
  std::vector<Panel> all;
  for (Panel& panel : panels) {
    double zeros = 0;
    while (!all.empty() && joins(all.back(), panel, zeros)) {
      panel.width += all.back().width;
      panel.first = all.back().first;
      panel.zeros = zeros;
      all.pop_back();
    }
    all.push_back(std::move(panel));
  }
  return all;
}

}  // namespace

int FactorPattern::row_in(int s, int i) const {
  if (i < first[s + 1]) return i - first[s];
  const auto from = row.begin() + start[s];
  return width(s) + static_cast<int>(std::lower_bound(from, row.begin() + start[s + 1], i) - from);
}

bool FactorPattern::is_of(const std::vector<double>& inverse_mass,
                          const std::vector<MetricEntry>& entries) const {
  return !place.empty() &&
         std::equal(column.begin(), column.end(), inverse_mass.begin(), inverse_mass.end(),
                    [](int own, double inverse) { return (own >= 0) == (inverse > 0); }) &&
         std::equal(pairs.begin(), pairs.end(), entries.begin(), entries.end(),
                    [](const auto& pair, const MetricEntry& entry) {
                      return pair[0] == entry.row && pair[1] == entry.column;
                    });
}

double FactorPattern::products() const {
  double sum = 0;
  for (int s = 0; s < panels(); ++s)
    for (double blocks = height(s) - width(s) + 1; blocks <= height(s); ++blocks)
      sum += blocks * (blocks + 1) / 2;
  return sum;
}

FactorPattern analyse(const std::vector<double>& inverse_mass, const std::vector<MetricEntry>& entries) {
  FactorPattern pattern;
  for (const auto& entry : entries) pattern.pairs.push_back({entry.row, entry.column});
  int count = 0;
  for (const double inverse : inverse_mass) pattern.column.push_back(inverse > 0 ? count++ : -1);
  const Graph graph = graph_of(count, pattern.column, entries);
  std::vector<int> order = dissected(graph);
  const std::vector<int> after = postorder(elimination_tree(graph, order, inverse_of(order)));
  std::vector<int> ordered(order.size());
  std::transform(after.begin(), after.end(), ordered.begin(), [&](int j) { return order[j]; });
  const std::vector<int> place = inverse_of(ordered);
  pattern.first = pattern.start = {0};
  pattern.place = {0};
  for (const Panel& panel : joined(panels_of(graph, ordered, place))) {
    pattern.panel.insert(pattern.panel.end(), panel.width, pattern.panels());
    pattern.row.insert(pattern.row.end(), panel.row.begin(), panel.row.end());
    pattern.first.push_back(panel.first + panel.width);
    pattern.start.push_back(static_cast<int>(pattern.row.size()));
    pattern.place.push_back(pattern.place.back() +
                            static_cast<std::size_t>(panel.width) * (panel.width + panel.row.size()));
  }
  for (int& column : pattern.column)
    if (column >= 0) column = place[column];
  return pattern;
}

}  // namespace pbd
