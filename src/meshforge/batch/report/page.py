"""The report: one HTML file that holds everything it shows."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from importlib.resources import files
from pathlib import Path

from meshforge.batch.report.asset import ReportAsset
from meshforge.batch.report.card import card
from meshforge.batch.report.headline import headline, legend, legend_of_changes
from meshforge.batch.report.html import Node, document, tag
from meshforge.batch.report.pictures import pictures
from meshforge.batch.report.program_panel import program_panel
from meshforge.batch.report.tools import tools
from meshforge.batch.summary import Summary
from meshforge.files import write_atomically
from meshforge.language import Program
from meshforge.views import UNLABELLED, label_colors

PICTURED = 120
"""Assets with pictures by default: about 60 kB each in the page."""
_ALLOWED = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'"


def write_report(
    path: Path,
    *,
    title: str,
    program: Program,
    assets: Sequence[ReportAsset],
    seconds: float | None = None,
    about: str | None = None,
    summary: Summary | None = None,
    pictured: int = PICTURED,
    progress: Callable[[], None] | None = None,
) -> None:
    """Write the report of a batch: figures, the program, and every asset before and after, with what each rule did.

    Where assets were checked, those that failed come first, then those with findings.

    about: a line below the title; summary: of the whole run, of which `assets` are then some; pictured: how many get
    pictures, demonstrated and failed ones first; progress: called for each asset. The page refers to no other file.
    """
    if any(asset.checked for asset in assets):
        assets = sorted(assets, key=lambda asset: (not asset.broken, not asset.doubtful))
    vocabulary = _vocabulary(program, assets)
    colors = label_colors(vocabulary)
    chosen = _pictured(assets, pictured)
    cards = []
    for k, asset in enumerate(assets):
        cards.append(card(asset, program, pictures(asset, vocabulary) if k in chosen else None, colors))
        if progress:
            progress()
    main = tag(
        "main",
        headline(title, assets, seconds, about, summary),
        program_panel(program, assets, colors),
        tag(
            "section",
            tag("h2", "Assets"),
            legend(assets, colors, UNLABELLED),
            legend_of_changes(assets),
            tools(assets),
            tag("div", *cards, class_="grid"),
        ),
    )
    write_atomically(Path(path), document(_page(title, main)))


def _page(title: str, main: Node) -> Node:
    """The document around the content. Style and script come as they are: the serializer does not escape them."""
    own = files("meshforge.batch.report")
    head = tag(
        "head",
        tag("meta", charset="utf-8"),
        tag("meta", name="viewport", content="width=device-width, initial-scale=1"),
        tag("meta", name="color-scheme", content="light dark"),
        tag("meta", http_equiv="Content-Security-Policy", content=_ALLOWED),
        tag("title", title),
        tag("style", (own / "page.css").read_text("utf-8")),
    )
    return tag("html", head, tag("body", main, tag("script", (own / "page.js").read_text("utf-8"))), lang="en")


def _vocabulary(program: Program, assets: Sequence[ReportAsset]) -> list[str]:
    """The program's labels, then others of the meshes in order of the alphabet."""
    meshes = [m for a in assets for m in (a.before, a.after) if m]
    others = {h.label for m in meshes for h in m.hulls if h.label} - set(program.labels)
    return [*program.labels, *sorted(others)]


def _pictured(assets: Sequence[ReportAsset], count: int) -> frozenset[int]:
    order = sorted(range(len(assets)), key=lambda k: not (assets[k].demonstrated or assets[k].broken))
    return frozenset(order[:count])
