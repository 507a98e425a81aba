"""When all assets of a project were prepared last: what assets were there, and from which probability hulls that span
parts are split. Assets that come later are new."""

from __future__ import annotations

from collections.abc import Collection

from meshforge import geometry
from meshforge.store.layout import JsonFile, Layout, read_json, write_json


class PreparationPlanFile(JsonFile):
    """preparation.json. decomposed, split: the ids of the assets that were there when pieces of all were decomposed
    last, and when hulls of all that span parts were split last; None where that was never done. sure: the probability
    from which they were split; rebuild: whether all hulls of their bodies were made anew; pieces: the engine of the
    fine pieces that they were found by; only: which hulls and bodies, all where there are none.
    """

    decomposed: tuple[str, ...] | None = None
    split: tuple[str, ...] | None = None
    sure: float | None = None
    rebuild: bool = False
    pieces: geometry.PieceEngine = "coacd"
    only: tuple[str, ...] = ()


def forget_assets(layout: Layout, assets: Collection[str]) -> None:
    """Let assets be new when they come back, under the lock that the caller holds."""
    kept = read_json(layout.preparation_plan, PreparationPlanFile)
    if kept is None:
        return
    lists = {"decomposed": kept.decomposed, "split": kept.split}
    left = {name: tuple(one for one in ids if one not in assets) for name, ids in lists.items() if ids is not None}
    if (after := kept.model_copy(update=left)) != kept:
        write_json(layout.preparation_plan, after)
