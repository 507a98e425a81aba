"""The report: one HTML file that holds everything it shows."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from importlib.resources import files
from pathlib import Path

from meshforge.batch.report.card import AssetPictures, PictureOptions, build_card, draw_asset
from meshforge.batch.report.contents import ReportAsset, RunFigures
from meshforge.batch.report.html import HtmlNode, tag, to_html
from meshforge.batch.report.panels import (
    build_change_legend,
    build_headline,
    build_legend,
    build_program_panel,
    build_toolbar,
)
from meshforge.common import write_atomically
from meshforge.language import Program
from meshforge.rendering import UNLABELLED, label_colors
from meshforge.symbolic import SymbolicMesh

MOST_PICTURED = 120
"""Assets with pictures by default: about 60 kB each in the page."""
_CONTENT_POLICY = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'"


def write_report(
    path: Path,
    *,
    title: str,
    assets: Sequence[ReportAsset],
    program: Program | None = None,
    vocabulary: Sequence[str] = (),
    figures: RunFigures | None = None,
    seconds: float | None = None,
    about: str | None = None,
    changes: bool = True,
    pictured: int = MOST_PICTURED,
    progress: Callable[[], None] | None = None,
) -> None:
    """Write the report of a batch: figures, the program if one ran, and every asset, with what each rule did.

    Where assets were checked, those that failed come first, then those with findings.

    vocabulary: where it is about labels, those that hulls can have; figures: of the whole run, of which `assets` may be
    some; seconds: that it took; about: a line below the title; changes: whether with pictures of what became of each
    hull, by its name; pictured: how many get pictures, demonstrated and failed ones first; progress: called for each
    asset. The page refers to no other file.
    """
    if any(asset.checked for asset in assets):
        assets = sorted(assets, key=lambda asset: (not asset.is_broken, not asset.has_findings))
    meshes = [mesh for asset in assets for mesh in (asset.before, asset.after) if mesh]
    labelled = bool(vocabulary) or any(hull.label for mesh in meshes for hull in mesh.hulls)
    words = _all_labels(vocabulary or (program.labels if program else ()), meshes)
    colors = label_colors(words)
    manner = PictureOptions(tuple(words), by_label=labelled, changes=changes)
    chosen, cards, drawn = _choose_pictured(assets, pictured), list[HtmlNode](), list[AssetPictures]()
    for k, asset in enumerate(assets):
        shown = draw_asset(asset, manner) if k in chosen else None
        cards.append(build_card(asset, program, shown, colors))
        drawn += [shown] if shown else []
        if progress:
            progress()
    main = tag(
        "main",
        build_headline(title, figures or RunFigures.of_assets(assets), len(assets), seconds, about),
        build_program_panel(program, assets, colors) if program else None,
        tag(
            "section",
            tag("h2", "Assets"),
            build_legend(assets, colors if labelled else {}, UNLABELLED, blamed=any(shown.has_blame for shown in drawn))
            if meshes
            else None,
            build_change_legend(assets) if any(shown.changes for shown in drawn) else None,
            build_toolbar(
                assets, pairs=any(shown.after for shown in drawn), changes=any(shown.changes for shown in drawn)
            ),
            tag("div", *cards, class_="grid"),
        ),
    )
    write_atomically(Path(path), to_html(_build_document(title, main)))


def _build_document(title: str, main: HtmlNode) -> HtmlNode:
    """The document around the content. Style and script come as they are: the serializer does not escape them."""
    own = files("meshforge.batch.report")
    head = tag(
        "head",
        tag("meta", charset="utf-8"),
        tag("meta", name="viewport", content="width=device-width, initial-scale=1"),
        tag("meta", name="color-scheme", content="light dark"),
        tag("meta", http_equiv="Content-Security-Policy", content=_CONTENT_POLICY),
        tag("title", title),
        tag("style", (own / "page.css").read_text("utf-8")),
    )
    return tag("html", head, tag("body", main, tag("script", (own / "page.js").read_text("utf-8"))), lang="en")


def _all_labels(known: Sequence[str], meshes: Sequence[SymbolicMesh]) -> list[str]:
    """The known labels, then others of the meshes in order of the alphabet."""
    others = {h.label for m in meshes for h in m.hulls if h.label} - set(known)
    return [*known, *sorted(others)]


def _choose_pictured(assets: Sequence[ReportAsset], count: int) -> frozenset[int]:
    order = sorted(range(len(assets)), key=lambda k: not (assets[k].demonstrated or assets[k].is_broken))
    return frozenset(order[:count])
