"""One asset on the page: its pictures, counts, error, and what each rule did to it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from meshforge.batch.report.asset import ORDINARY, ReportAsset
from meshforge.batch.report.checked import checked
from meshforge.batch.report.code import colored
from meshforge.batch.report.html import Child, Node, tag
from meshforge.batch.report.pictures import SIZE, Pictures
from meshforge.batch.report.words import change
from meshforge.language import Program, RuleTrace, show
from meshforge.words import counted, listed

_NAMES = 60  # of hulls in one cell of the table; the rest is counted
_SAID = 6  # notes that are shown at once


def card(asset: ReportAsset, program: Program | None, pictures: Pictures | None, colors: Mapping[str, str]) -> Node:
    """The article about one asset; colors: of the labels."""
    marks = [word for word, holds in (("demonstrated", asset.demonstrated), ("doubtful", asset.has_findings)) if holds]
    return tag(
        "article",
        tag("h3", tag("span", tag("bdi", asset.name), title=asset.name), *_badges(asset)),
        _stage(asset, pictures) if pictures else None,
        tag("p", asset.error, class_="error") if asset.error else None,
        *_notes(asset.notes),
        checked(asset, pictures is not None),
        _details(asset, program, colors),
        class_="asset",
        data_name=asset.name.lower(),
        data_kind=" ".join([asset.status, *marks]),
    )


def _badges(asset: ReportAsset) -> list[Child]:
    badges: list[Child] = [_count(asset)]
    if asset.demonstrated:
        badges.append(tag("b", "demonstrated", class_="demonstrated", title="A person showed the edit on this asset"))
    if asset.status not in ORDINARY:
        badges.append(tag("b", asset.status, class_=asset.status))
    return badges


def _count(asset: ReportAsset) -> Child:
    if asset.counts is None:
        return tag("em", counted(len(asset.before.hulls), "hull")) if asset.before else None
    before, after = asset.counts
    if before == after:
        return tag("em", counted(before, "hull"))
    return tag("em", f"{before} → {counted(after, 'hull')} ", tag("small", change(before, after)))


def _notes(notes: Sequence[str]) -> list[Node]:
    """What there is to say; of very much the first, and the rest where one opens it."""
    rows = [tag("p", note, class_="note") for note in notes]
    if len(rows) <= _SAID:
        return rows
    return [*rows[:_SAID], tag("details", tag("summary", f"and {len(rows) - _SAID:,} more"), *rows[_SAID:])]


def _stage(asset: ReportAsset, pictures: Pictures) -> Node:
    """The pictures; where there are two, with a slider between them."""
    if pictures.after is None:
        return tag("div", _image(pictures.before, f"{asset.name}", "only"), class_="stage")
    slider = tag(
        "input", type="range", min=0, max=100, step="any", value=50, aria_label=f"before and after of {asset.name}"
    )
    return tag(
        "div",
        _image(pictures.before, f"{asset.name} before", "before"),
        _image(pictures.after, f"{asset.name} after", "after"),
        _image(pictures.changes, f"{asset.name}: removed, made and kept hulls", "changes")
        if pictures.changes
        else None,
        tag("span", "before", class_="tip left"),
        tag("span", "after", class_="tip right"),
        tag("i", class_="handle"),
        slider,
        class_="stage pair",
    )


def _image(source: str, text: str, kind: str) -> Node:
    width, height = SIZE
    return tag("img", src=source, alt=text, width=width, height=height, class_=kind, loading="lazy")


def _details(asset: ReportAsset, program: Program | None, colors: Mapping[str, str]) -> Child:
    if not asset.trace:
        return None
    head = tag("tr", *(tag("th", name, scope="col") for name in ("", "rule", "selected", "made")))
    rows = [_row(trace, program, colors) for trace in asset.trace]
    active = sum(bool(t.selected) for t in asset.trace)
    summary = tag("summary", f"{active} of {counted(len(asset.trace), 'rule')} selected something")
    return tag("details", summary, tag("table", tag("thead", head), tag("tbody", *rows)))


def _row(trace: RuleTrace, program: Program | None, colors: Mapping[str, str]) -> Node:
    rule = program.rules[trace.rule - 1] if program and trace.rule <= len(program.rules) else None
    code = tag("code", *colored(show(rule), colors)) if rule else None
    text = tag("td", code, tag("p", trace.note) if trace.note and trace.selected else None)
    return tag(
        "tr",
        tag("th", str(trace.rule), scope="row"),
        text,
        tag("td", *_names(trace.selected)),
        tag("td", *_names(trace.made)),
        class_=None if trace.selected else "idle",
    )


def _names(names: Sequence[str]) -> list[Child]:
    """The count, and the names behind it."""
    if not names:
        return ["–"]
    return [tag("b", str(len(names))), " ", tag("span", listed(names, _NAMES))]
