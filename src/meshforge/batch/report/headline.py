"""The top of the page: what was done, in figures, and what the colours mean."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

from meshforge.batch.report.asset import REMARKABLE, ReportAsset, Status
from meshforge.batch.report.figures import Figures
from meshforge.batch.report.html import Node, tag
from meshforge.batch.report.words import duration
from meshforge.views import DIFFERENCE_COLORS, SELECTED, UNSURE

STATUSES: tuple[Status, ...] = (
    "edited",
    "unchanged",
    "written",
    "skipped",
    "labelled",
    "clean",
    "doubtful",
    "warnings",
    "problems",
    "errors",
    "failed",
)
"""In the order of the page."""


def headline(title: str, figures: Figures, shown: int, seconds: float | None, about: str | None) -> Node:
    """Title and figures of a run; shown: how many of its assets are on the page; seconds: that it took."""
    counts = figures.counts
    rows = [_figure("assets", f"{figures.total:,}")]
    rows += [_figure(s, f"{counts[s]:,}", s) for s in STATUSES if counts.get(s)]
    rows += [_figure(name, value, extra=extra) for name, (value, extra) in figures.more.items()]
    if seconds is not None:
        rows.append(_figure("run time", duration(seconds)))
    parts = [tag("i", class_=s, style=f"flex:{counts[s]}") for s in STATUSES if counts.get(s)]
    return tag(
        "header",
        tag("h1", title),
        tag("p", about, class_="about") if about else None,
        tag("p", _some(shown, figures), class_="about") if shown < figures.total else None,
        tag("dl", *rows, class_="figures"),
        tag("div", *parts, class_="bar", aria_hidden="true"),
    )


def _some(shown: int, figures: Figures) -> str:
    """How many of very many assets are on the page."""
    some = f"{shown:,} of {figures.total:,} assets are shown"
    odd = any(n and word in REMARKABLE for word, n in figures.counts.items())
    return f"{some}, {figures.first} first." if odd else f"{some}."


def legend(assets: Sequence[ReportAsset], colors: Mapping[str, str], unlabelled: str, *, blamed: bool = False) -> Node:
    """Each label with its colour, and its hulls before and after.

    colors: empty where each hull has its own; blamed: whether hulls stand out for findings.
    """
    known = [(a.before, a.after) for a in assets if a.before and a.after]
    before, after = (Counter(h.label for pair in known for h in pair[k].hulls) for k in (0, 1))
    entries = [_entry(label, color, before[label], after[label]) for label, color in colors.items()]
    if not colors:
        entries.append(tag("li", tag("span", "nothing is labelled: each hull has its own colour")))
    elif before[None] or after[None]:
        entries.append(_entry("no label", unlabelled, before[None], after[None]))
    meshes = [m for a in assets for m in (a.before, a.after) if m]
    if any(h.confidence is not None and h.confidence < UNSURE for m in meshes for h in m.hulls):
        entries.append(tag("li", tag("span", "hatched: an unsure label")))
    if blamed:
        entries.append(
            tag("li", tag("i", style=f"background:{SELECTED}"), tag("span", "named by a finding, the rest pale"))
        )
    return tag("ul", *entries, class_="legend")


def legend_of_changes(assets: Sequence[ReportAsset]) -> Node:
    """What the colours of the pictures of changes mean, and how many hulls are of each kind."""
    pairs = [(a.before, a.after) for a in assets if a.before and a.after]
    gone = sum(h.name not in after.index for before, after in pairs for h in before.hulls)
    made = sum(h.name not in before.index for before, after in pairs for h in after.hulls)
    kept = sum(h.name in before.index for before, after in pairs for h in after.hulls)
    rows = [
        _entry(word, DIFFERENCE_COLORS[word], n, n) for word, n in (("removed", gone), ("made", made), ("kept", kept))
    ]
    return tag("ul", *rows, class_="legend of-changes")


def _entry(name: str, color: str, before: int, after: int) -> Node:
    count = f"{before:,}" if before == after else f"{before:,} → {after:,}"
    return tag("li", tag("i", style=f"background:{color}"), name, " ", tag("span", count))


def _figure(name: str, value: str, kind: str | None = None, extra: str | None = None) -> Node:
    body = tag("dd", value, tag("small", f" {extra}") if extra else None)
    return tag("div", tag("dt", name), body, class_=kind)
