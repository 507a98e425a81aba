"""What stands above the assets: figures of the run, what the colours mean, the program, filters and search."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import get_args

from meshforge.batch.report.contents import (
    REMARKABLE,
    CheckStatus,
    ReportAsset,
    ReportStatus,
    RunFigures,
    format_duration,
)
from meshforge.batch.report.html import HtmlChild, HtmlNode, highlight_code, tag
from meshforge.common import pluralize
from meshforge.language import Program, explain, show, show_label
from meshforge.rendering import DIFFERENCE_COLORS, SELECTED, UNSURE

STATUSES: tuple[ReportStatus, ...] = (
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

_CHECK_STATUSES = get_args(CheckStatus)


def build_headline(title: str, figures: RunFigures, shown: int, seconds: float | None, about: str | None) -> HtmlNode:
    """Title and figures of a run; shown: how many of its assets are on the page; seconds: that it took."""
    counts = figures.counts
    rows = [_figure("assets", f"{figures.total:,}")]
    rows += [_figure(s, f"{counts[s]:,}", s) for s in STATUSES if counts.get(s)]
    rows += [_figure(name, value, extra=extra) for name, (value, extra) in figures.more.items()]
    if seconds is not None:
        rows.append(_figure("run time", format_duration(seconds)))
    parts = [tag("i", class_=s, style=f"flex:{counts[s]}") for s in STATUSES if counts.get(s)]
    return tag(
        "header",
        tag("h1", title),
        tag("p", about, class_="about") if about else None,
        tag("p", _describe_selection(shown, figures), class_="about") if shown < figures.total else None,
        tag("dl", *rows, class_="figures"),
        tag("div", *parts, class_="bar", aria_hidden="true"),
    )


def _describe_selection(shown: int, figures: RunFigures) -> str:
    """How many of very many assets are on the page."""
    some = f"{shown:,} of {figures.total:,} assets are shown"
    odd = any(n and word in REMARKABLE for word, n in figures.counts.items())
    return f"{some}, {figures.first} first." if odd else f"{some}."


def build_legend(
    assets: Sequence[ReportAsset], colors: Mapping[str, str], unlabelled: str, *, blamed: bool = False
) -> HtmlNode:
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


def build_change_legend(assets: Sequence[ReportAsset]) -> HtmlNode:
    """What the colours of the pictures of changes mean, and how many hulls are of each kind."""
    pairs = [(a.before, a.after) for a in assets if a.before and a.after]
    gone = sum(h.name not in after.index for before, after in pairs for h in before.hulls)
    made = sum(h.name not in before.index for before, after in pairs for h in after.hulls)
    kept = sum(h.name in before.index for before, after in pairs for h in after.hulls)
    rows = [
        _entry(word, DIFFERENCE_COLORS[word], n, n) for word, n in (("removed", gone), ("made", made), ("kept", kept))
    ]
    return tag("ul", *rows, class_="legend of-changes")


def _entry(name: str, color: str, before: int, after: int) -> HtmlNode:
    count = f"{before:,}" if before == after else f"{before:,} → {after:,}"
    return tag("li", tag("i", style=f"background:{color}"), name, " ", tag("span", count))


def _figure(name: str, value: str, kind: str | None = None, extra: str | None = None) -> HtmlNode:
    body = tag("dd", value, tag("small", f" {extra}") if extra else None)
    return tag("div", tag("dt", name), body, class_=kind)


def build_program_panel(program: Program, assets: Sequence[ReportAsset], colors: Mapping[str, str]) -> HtmlNode:
    """The section with the program."""
    rows = [_header_row(line, sentence, colors) for line, sentence in _header_lines(program)]
    for number, rule in enumerate(program.rules, 1):
        above = [c.strip() for c in rule.comments.above if c]
        comment = " ".join([*above, *([rule.comments.beside.strip()] if rule.comments.beside else [])])
        body = tag("td", tag("code", *highlight_code(show(rule), colors)), tag("p", explain(rule)))
        if comment:
            body.append(tag("p", f"# {comment}", class_="comment"))
        rows.append(
            tag(
                "tr",
                tag("th", str(number), scope="row"),
                body,
                tag("td", *_describe_effect(number, assets), class_="did"),
            )
        )
    return tag("section", tag("h2", "Program"), tag("table", *rows, class_="program"), id_="program")


def _header_lines(program: Program) -> Iterator[tuple[str, str | None]]:
    """The lines above the rules, with a sentence where they need one."""
    if program.labels:
        yield f"labels {', '.join(map(show_label, program.labels))}", None
    if program.contact is not None:
        yield f"contact {program.contact:g}", "Hulls this near each other touch (a share of the diagonal)."
    if program.extremity is not None:
        yield (
            f"extremity {program.extremity:g}",
            "Hulls this near the boundary are extreme (a share of the diagonal).",
        )
    if program.orient:
        yield show(program.orient), explain(program.orient)


def _header_row(line: str, sentence: str | None, colors: Mapping[str, str]) -> HtmlNode:
    body = tag("td", tag("code", *highlight_code(line, colors)), tag("p", sentence) if sentence else None, colspan=2)
    return tag("tr", tag("th"), body)


def _describe_effect(number: int, assets: Sequence[ReportAsset]) -> Iterator[HtmlChild]:
    """What one rule did over all assets."""
    traces = [t for a in assets for t in a.trace if t.rule == number]
    active = [t for t in traces if t.selected]
    if not active:
        yield "selected nothing"
        return
    hulls = pluralize(sum(len(t.selected) for t in active), "hull")
    yield f"{hulls} on {len(active)} of {pluralize(len(traces), 'asset')}, "
    yield tag("br")
    yield f"{sum(len(t.made) for t in active):,} made"


def build_toolbar(assets: Sequence[ReportAsset], *, pairs: bool, changes: bool) -> HtmlNode:
    """The bar, hidden until the script runs; pairs, changes: whether there are pictures before and after, and of what
    became of each hull."""
    every = tag("input", type="range", min=0, max=100, step="any", value=50, id_="every", aria_label="all sliders")
    modes = (_mode_button("slider", "before | after"), _mode_button("changes", "changes"))
    return tag(
        "div",
        tag("span", *_kind_buttons(assets), class_="group", id_="kinds"),
        tag("span", *modes, class_="group", id_="modes") if changes else None,
        tag("label", "before", every, "after", class_="every") if pairs else None,
        tag("input", type="search", placeholder="find an asset", id_="find", aria_label="find an asset"),
        class_="tools",
        hidden=True,
    )


def _kind_buttons(assets: Sequence[ReportAsset]) -> list[HtmlNode]:
    """A button for all assets, and one for each kind that there is."""
    kinds: list[str] = [s for s in STATUSES if any(a.status == s for a in assets)]
    if any(a.demonstrated for a in assets):
        kinds.append("demonstrated")
    if any(a.has_findings and a.status not in _CHECK_STATUSES for a in assets):
        kinds.append("doubtful")
    rest = [tag("button", kind, type="button", data_kind=kind, aria_pressed="false") for kind in kinds]
    return [tag("button", "all", type="button", data_kind="", aria_pressed="true"), *rest]


def _mode_button(mode: str, words: str) -> HtmlNode:
    pressed = str(mode == "slider").lower()
    return tag("button", words, type="button", data_mode=mode, aria_pressed=pressed)
