"""The bar above the assets: filters, how pictures are compared, search. The script that makes it work shows it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import get_args

from meshforge.batch.report.asset import Check, ReportAsset
from meshforge.batch.report.headline import STATUSES
from meshforge.batch.report.html import Node, tag

_CHECKED = get_args(Check)


def tools(assets: Sequence[ReportAsset], *, pairs: bool, changes: bool) -> Node:
    """The bar, hidden until the script runs; pairs, changes: whether there are pictures before and after, and of what
    became of each hull."""
    every = tag("input", type="range", min=0, max=100, step="any", value=50, id_="every", aria_label="all sliders")
    modes = (_mode("slider", "before | after"), _mode("changes", "changes"))
    return tag(
        "div",
        tag("span", *_kinds(assets), class_="group", id_="kinds"),
        tag("span", *modes, class_="group", id_="modes") if changes else None,
        tag("label", "before", every, "after", class_="every") if pairs else None,
        tag("input", type="search", placeholder="find an asset", id_="find", aria_label="find an asset"),
        class_="tools",
        hidden=True,
    )


def _kinds(assets: Sequence[ReportAsset]) -> list[Node]:
    """A button for all assets, and one for each kind that there is."""
    kinds: list[str] = [s for s in STATUSES if any(a.status == s for a in assets)]
    if any(a.demonstrated for a in assets):
        kinds.append("demonstrated")
    if any(a.has_findings and a.status not in _CHECKED for a in assets):
        kinds.append("doubtful")
    rest = [tag("button", kind, type="button", data_kind=kind, aria_pressed="false") for kind in kinds]
    return [tag("button", "all", type="button", data_kind="", aria_pressed="true"), *rest]


def _mode(mode: str, words: str) -> Node:
    pressed = str(mode == "slider").lower()
    return tag("button", words, type="button", data_mode=mode, aria_pressed=pressed)
