"""When all assets of a project were prepared last: what assets were there, and from which probability bodies are
rebuilt of which hulls span parts. Assets that come later are new."""

from collections.abc import Collection

from pydantic import AliasChoices, Field

from meshforge import geometry
from meshforge.store.layout import JsonFile, Layout, read_json, write_json


class PreparationPlanFile(JsonFile):
    """preparation.json. decomposed, rebuilt: the ids of the assets that were there when pieces of all were decomposed
    last, and when bodies of all of which hulls span parts were rebuilt last (which earlier versions called split); None
    where that was never done. min_confidence: the probability from which they were; pieces: the engine of their fine
    pieces; only: which hulls and bodies, all where there are none.
    """

    decomposed: tuple[str, ...] | None = None
    rebuilt: tuple[str, ...] | None = Field(default=None, validation_alias=AliasChoices("rebuilt", "split"))
    min_confidence: float | None = Field(default=None, validation_alias=AliasChoices("min_confidence", "sure"))
    pieces: geometry.PieceEngine = "coacd"
    only: tuple[str, ...] = ()


def forget_assets(layout: Layout, assets: Collection[str]) -> None:
    """Let assets be new when they come back, under the lock that the caller holds."""
    kept = read_json(layout.preparation_plan, PreparationPlanFile)
    if kept is None:
        return
    lists = {"decomposed": kept.decomposed, "rebuilt": kept.rebuilt}
    left = {name: tuple(one for one in ids if one not in assets) for name, ids in lists.items() if ids is not None}
    if (after := kept.model_copy(update=left)) != kept:
        write_json(layout.preparation_plan, after)
