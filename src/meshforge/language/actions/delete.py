"""Delete."""

from __future__ import annotations

from dataclasses import dataclass

from meshforge.language.actions.base import Action
from meshforge.language.actions.edit import Edit, Group


@dataclass(frozen=True, slots=True)
class Delete(Action):
    """Removes the selected hulls."""

    @property
    def makes_hulls(self) -> bool:
        return False

    def edit(self, group: Group) -> Edit:
        return Edit()
