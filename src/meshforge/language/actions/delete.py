"""Delete."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from meshforge.language.actions.base import Action, Edit, Group


@dataclass(frozen=True, slots=True)
class Delete(Action):
    """Removes the selected hulls."""

    makes_hulls: ClassVar[bool] = False

    def edit(self, group: Group) -> Edit:
        return Edit()
