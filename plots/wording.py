"""Numbers and counts as words, the same in figures and report."""

import numpy as np

import selecting


def number(value, digits=3):
    """A number for a text or a table."""
    if np.isnan(value):
        return "not a number"
    return selecting.text_number(value, digits) if np.isfinite(value) else ("inf" if value > 0 else "-inf")


def span(values):
    """Smallest to largest of the finite values."""
    values = np.asarray(values, dtype=float)
    values = values[np.isfinite(values)]
    if not len(values):
        return "no finite number"
    low, high = number(values.min()), number(values.max())
    return low if low == high else f"{low} to {high}"


def joined(texts):
    """a, b and c."""
    texts = list(texts)
    return " and ".join([", ".join(texts[:-1]), texts[-1]]) if len(texts) > 1 else "".join(texts)


def some(texts, most=3):
    """a, b, c and 4 more."""
    texts = list(texts)
    return joined(texts if len(texts) <= most + 1 else [*texts[:most], f"{len(texts) - most} more"])


def counted(count, noun):
    return f"{count} {noun}" + ("" if count == 1 else "s")


def share(count, total):
    return f"{count} of {total}"
