"""Every action of the language, by the name it is written with."""

from __future__ import annotations

from collections.abc import Mapping

from meshforge.language.actions.add import Add
from meshforge.language.actions.base import Action
from meshforge.language.actions.delete import Delete
from meshforge.language.actions.each import Each
from meshforge.language.actions.merge import Merge
from meshforge.language.actions.replace import Replace
from meshforge.language.actions.scale import Scale

ACTIONS: Mapping[str, type[Action]] = {
    kind.__name__: kind
    for kind in (
        Delete,
        Replace,
        Add,
        Merge,
        Scale,
        Each,
    )
}
