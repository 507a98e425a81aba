"""When all assets of a project were prepared last: what assets were there, and from which probability hulls that span
parts are split. Assets that come later are new."""

from __future__ import annotations

from meshforge.store.layout import JsonFile


class PreparationPlanFile(JsonFile):
    """preparation.json. decomposed, split: the ids of the assets that were there when pieces of all were decomposed
    last, and when hulls of all that span parts were split last; None where that was never done. sure: the probability
    from which they were split.
    """

    decomposed: tuple[str, ...] | None = None
    split: tuple[str, ...] | None = None
    sure: float | None = None
