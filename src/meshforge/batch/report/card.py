"""One asset on the page: its pictures, counts, error, what each rule did to it, and what checks found."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from meshforge.batch.report.contents import ORDINARY, ReportAsset, format_change
from meshforge.batch.report.html import HtmlChild, HtmlNode, highlight_code, tag, to_data_url
from meshforge.checks import Examination, Finding, draw_examination
from meshforge.common import join_names, pluralize
from meshforge.language import Program, RuleTrace, show
from meshforge.rendering import ColorBy, compare, draw_difference, render
from meshforge.symbolic import SymbolicMesh

PICTURE_SIZE = (600, 450)

_NAMES_SHOWN = 60  # of hulls in one cell of the table; the rest is counted
_NOTES_SHOWN = 6  # notes that are shown at once

CHECK_PICTURE_SIZE = (420, 315)
_FINDINGS = 40  # of one asset that are listed, errors first


@dataclass(frozen=True, slots=True)
class PictureOptions:
    """How pictures are drawn.

    vocabulary: the order in which labels take their colours; by_label: whether hulls have those, else each its own;
    changes: whether with pictures of what became of each hull.
    """

    vocabulary: tuple[str, ...]
    by_label: bool
    changes: bool


@dataclass(frozen=True, slots=True)
class AssetPictures:
    """Addresses `data:…` of an asset's pictures; after and changes are None where nothing changed.

    blamed: whether hulls that findings name stand out in them.
    """

    before: str
    after: str | None = None
    changes: str | None = None
    has_blame: bool = False


def draw_asset(asset: ReportAsset, manner: PictureOptions) -> AssetPictures | None:
    """The pictures of an asset, on transparent ground; None where there is no mesh to be seen."""
    before, after = asset.before, asset.after
    if before is None:
        return None
    color_by: ColorBy = "label" if manner.by_label else "hull"
    if after is None or after is before or asset.status == "unchanged" or not (before.hulls or after.hulls):
        blamed = _find_hulls_to_blame(asset, before) if after is before else None
        image = render(
            before,
            color_by=color_by,
            size=PICTURE_SIZE,
            highlight=blamed,
            vocabulary=manner.vocabulary,
            background=None,
            legend=False,
        )
        return AssetPictures(to_data_url(image), has_blame=blamed is not None)
    pair = compare(before, after, color_by=color_by, size=PICTURE_SIZE, vocabulary=manner.vocabulary, background=None)
    changes = (
        draw_difference(before, after, size=PICTURE_SIZE, background=None, legend=False) if manner.changes else None
    )
    return AssetPictures(to_data_url(pair[0]), to_data_url(pair[1]), to_data_url(changes) if changes else None)


def _find_hulls_to_blame(asset: ReportAsset, mesh: SymbolicMesh) -> frozenset[str] | None:
    """The hulls that findings name, None where they name none that is there, or all: then none would stand out."""
    named = asset.hulls_to_blame & mesh.index.keys()
    return named if 0 < len(named) < len(mesh.hulls) else None


def build_card(
    asset: ReportAsset, program: Program | None, pictures: AssetPictures | None, colors: Mapping[str, str]
) -> HtmlNode:
    """The article about one asset; colors: of the labels."""
    marks = [word for word, holds in (("demonstrated", asset.demonstrated), ("doubtful", asset.has_findings)) if holds]
    return tag(
        "article",
        tag("h3", tag("span", tag("bdi", asset.name), title=asset.name), *_badges(asset)),
        _picture_slider(asset, pictures) if pictures else None,
        tag("p", asset.error, class_="error") if asset.error else None,
        *_note_rows(asset.notes),
        build_checks(asset, pictures is not None),
        _rule_details(asset, program, colors),
        class_="asset",
        data_name=asset.name.lower(),
        data_kind=" ".join([asset.status, *marks]),
    )


def _badges(asset: ReportAsset) -> list[HtmlChild]:
    badges: list[HtmlChild] = [_count_badge(asset)]
    if asset.demonstrated:
        badges.append(tag("b", "demonstrated", class_="demonstrated", title="A person showed the edit on this asset"))
    if asset.status not in ORDINARY:
        badges.append(tag("b", asset.status, class_=asset.status))
    return badges


def _count_badge(asset: ReportAsset) -> HtmlChild:
    if asset.counts is None:
        return tag("em", pluralize(len(asset.before.hulls), "hull")) if asset.before else None
    before, after = asset.counts
    if before == after:
        return tag("em", pluralize(before, "hull"))
    return tag("em", f"{before} → {pluralize(after, 'hull')} ", tag("small", format_change(before, after)))


def _note_rows(notes: Sequence[str]) -> list[HtmlNode]:
    """What there is to say; of very much the first, and the rest where one opens it."""
    rows = [tag("p", note, class_="note") for note in notes]
    if len(rows) <= _NOTES_SHOWN:
        return rows
    return [
        *rows[:_NOTES_SHOWN],
        tag("details", tag("summary", f"and {len(rows) - _NOTES_SHOWN:,} more"), *rows[_NOTES_SHOWN:]),
    ]


def _picture_slider(asset: ReportAsset, pictures: AssetPictures) -> HtmlNode:
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


def _image(source: str, text: str, kind: str) -> HtmlNode:
    width, height = PICTURE_SIZE
    return tag("img", src=source, alt=text, width=width, height=height, class_=kind, loading="lazy")


def _rule_details(asset: ReportAsset, program: Program | None, colors: Mapping[str, str]) -> HtmlChild:
    if not asset.trace:
        return None
    head = tag("tr", *(tag("th", name, scope="col") for name in ("", "rule", "selected", "made")))
    rows = [_rule_row(trace, program, colors) for trace in asset.trace]
    active = sum(bool(t.selected) for t in asset.trace)
    summary = tag("summary", f"{active} of {pluralize(len(asset.trace), 'rule')} selected something")
    return tag("details", summary, tag("table", tag("thead", head), tag("tbody", *rows)))


def _rule_row(trace: RuleTrace, program: Program | None, colors: Mapping[str, str]) -> HtmlNode:
    rule = program.rules[trace.rule - 1] if program and trace.rule <= len(program.rules) else None
    code = tag("code", *highlight_code(show(rule), colors)) if rule else None
    text = tag("td", code, tag("p", trace.note) if trace.note and trace.selected else None)
    return tag(
        "tr",
        tag("th", str(trace.rule), scope="row"),
        text,
        tag("td", *_name_cell(trace.selected)),
        tag("td", *_name_cell(trace.made)),
        class_=None if trace.selected else "idle",
    )


def _name_cell(names: Sequence[str]) -> list[HtmlChild]:
    """The count, and the names behind it."""
    if not names:
        return ["–"]
    return [tag("b", str(len(names))), " ", tag("span", join_names(names, _NAMES_SHOWN))]


def build_checks(asset: ReportAsset, pictured: bool) -> HtmlChild:
    """The section about what was measured; None where nothing was. pictured: whether with pictures."""
    found = asset.checked
    if found is None:
        return None
    errors = [f for f in found.findings if f.severity == "error"]
    warnings = [f for f in found.findings if f.severity != "error"]
    counts = f"{pluralize(len(errors), 'error')}, {pluralize(len(warnings), 'warning')}"
    rows = [_row_of_finding(finding) for finding in (*errors, *warnings)[:_FINDINGS]]
    if len(found.findings) > _FINDINGS:
        rows.append(tag("li", f"and {len(found.findings) - _FINDINGS:,} more"))
    return tag(
        "details",
        tag("summary", f"checks: {counts}" if found.findings else "checks: all is well"),
        *(tag("p", line, class_="note") for line in found.descriptions),
        tag("ul", *rows, class_="findings") if rows else None,
        *(_check_figures(asset) if pictured else ()),
        class_="checks",
        open=bool(errors) or asset.status == "warnings",
    )


def _row_of_finding(finding: Finding) -> HtmlNode:
    remedy = tag("small", f" {finding.remedy}") if finding.remedy else None
    return tag("li", tag("b", finding.severity, class_=finding.severity), f" {finding.message} ", remedy)


def _check_figures(asset: ReportAsset) -> list[HtmlNode]:
    mesh = asset.after or asset.before
    if mesh is None or not isinstance(asset.checked, Examination):
        return []
    return [
        _check_figure(asset.name, words, to_data_url(image))
        for _, words, image in draw_examination(mesh, asset.checked, CHECK_PICTURE_SIZE)
    ]


def _check_figure(name: str, words: str, source: str) -> HtmlNode:
    image = tag(
        "img",
        src=source,
        alt=f"{name}: {words}",
        width=CHECK_PICTURE_SIZE[0],
        height=CHECK_PICTURE_SIZE[1],
        loading="lazy",
    )
    return tag("figure", image, tag("figcaption", words))
