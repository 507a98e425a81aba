"""The top of the page: what was done, in figures, and what the colours mean."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

from meshforge.batch.report.asset import ReportAsset, Status
from meshforge.batch.report.html import Node, tag
from meshforge.batch.report.words import change, duration
from meshforge.batch.summary import Summary
from meshforge.views import DIFFERENCE_COLORS, UNSURE

STATUSES: tuple[Status, ...] = ("edited", "unchanged", "skipped", "failed")


def headline(
    title: str, assets: Sequence[ReportAsset], seconds: float | None, about: str | None, summary: Summary | None = None
) -> Node:
    """Title and figures; summary: of the whole run, where only some of its assets are on the page."""
    found: Counter[Status] = summary.counts if summary else Counter(a.status for a in assets)
    figures = [_figure("assets", f"{found.total():,}")]
    figures += [_figure(s, f"{found[s]:,}", s) for s in STATUSES if found[s]]
    known = [a.counts for a in assets if a.counts]
    before, after = (summary.before, summary.after) if summary else (sum(c[k] for c in known) for k in (0, 1))
    if before or after:
        figures.append(_figure("hulls", f"{before:,} → {after:,}", extra=change(before, after)))
    if seconds is not None:
        figures.append(_figure("run time", duration(seconds)))
    parts = [tag("i", class_=s, style=f"flex:{found[s]}") for s in STATUSES if found[s]]
    return tag(
        "header",
        tag("h1", title),
        tag("p", about, class_="about") if about else None,
        tag("p", _some(len(assets), found), class_="about") if len(assets) < found.total() else None,
        tag("dl", *figures, class_="figures"),
        tag("div", *parts, class_="bar", aria_hidden="true"),
    )


def _some(shown: int, found: Mapping[Status, int]) -> str:
    """How many of very many assets are on the page."""
    some = f"{shown:,} of {sum(found.values()):,} assets are shown"
    return f"{some}, those that failed first." if found["failed"] else f"{some}."


def legend(assets: Sequence[ReportAsset], colors: Mapping[str, str], unlabelled: str) -> Node:
    """Each label with its colour, and its hulls before and after."""
    known = [(a.before, a.after) for a in assets if a.before and a.after]
    before, after = (Counter(h.label for pair in known for h in pair[k].hulls) for k in (0, 1))
    if not (before.keys() | after.keys()) - {None}:
        return tag("ul", tag("li", tag("span", "nothing is labelled: each hull has its own colour")), class_="legend")
    entries = [_entry(label, color, before[label], after[label]) for label, color in colors.items()]
    if before[None] or after[None]:
        entries.append(_entry("no label", unlabelled, before[None], after[None]))
    meshes = [m for a in assets for m in (a.before, a.after) if m]
    if any(h.confidence is not None and h.confidence < UNSURE for m in meshes for h in m.hulls):
        entries.append(tag("li", tag("span", "hatched: an unsure label")))
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
