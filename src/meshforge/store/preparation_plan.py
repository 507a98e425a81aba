"""How new assets are prepared: what assets there were when all were prepared last, from which probability hulls that
span parts are split, and by what hulls were labelled."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Literal

from meshforge.geometry import PieceEngine
from meshforge.store.layout import JsonFile, Layout, read_json, write_json


class LabelSourceLine(JsonFile):
    """One way in which hulls were labelled: `file`, `names`, or a plug-in's labeller.

    patterns: what names mean, besides the project's patterns; folder: where files are, as seen from the project, None
    for beside each asset; the rest: see `LabelFileOptions`.
    """

    source: str
    patterns: Mapping[str, str] = {}
    folder: str | None = None
    classes: tuple[str, ...] = ()
    align: Literal["check", "box", "off"] = "check"
    points_up: Literal["y", "z"] | None = None


class PreparationPlanFile(JsonFile):
    """preparation.json. decomposed, split: the ids of the assets that were there when pieces of all were decomposed
    last, and when hulls of all that span parts were split last; None where that was never done. sure: the probability
    from which they were split; rebuild: whether all hulls of their bodies were made anew; pieces: the engine of the
    fine pieces that they were found by; label_sources: by what hulls were labelled, in the order of that.
    """

    decomposed: tuple[str, ...] | None = None
    split: tuple[str, ...] | None = None
    sure: float | None = None
    rebuild: bool = False
    pieces: PieceEngine = "coacd"
    label_sources: tuple[LabelSourceLine, ...] = ()


def add_label_source(layout: Layout, line: LabelSourceLine) -> None:
    """Keep by what hulls were labelled, under the lock that the caller holds; patterns add to those of before."""
    kept = read_json(layout.preparation_plan, PreparationPlanFile) or PreparationPlanFile()
    lines = {one.source: one for one in kept.label_sources}
    if line.source in lines:
        line = line.model_copy(update={"patterns": {**lines[line.source].patterns, **line.patterns}})
    elif line == LabelSourceLine(source="file"):  # taken into account in any case
        return
    lines[line.source] = line
    if (after := kept.model_copy(update={"label_sources": tuple(lines.values())})) != kept:
        write_json(layout.preparation_plan, after)


def forget_assets(layout: Layout, assets: Collection[str]) -> None:
    """Let assets be new when they come back, under the lock that the caller holds."""
    kept = read_json(layout.preparation_plan, PreparationPlanFile)
    if kept is None:
        return
    lists = {"decomposed": kept.decomposed, "split": kept.split}
    left = {name: tuple(one for one in ids if one not in assets) for name, ids in lists.items() if ids is not None}
    if (after := kept.model_copy(update=left)) != kept:
        write_json(layout.preparation_plan, after)
