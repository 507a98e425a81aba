"""When all assets of a project were prepared last: what assets were there, and from which probability bodies are
rebuilt of which hulls span parts. Assets that come later are new."""

from pydantic import AliasChoices, Field

from meshforge import geometry
from meshforge.store.layout import JsonFile


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
