"""Each: an action on every connected component."""

from __future__ import annotations

from dataclasses import dataclass, field

from meshforge.language.actions.arguments import Inner
from meshforge.language.actions.base import Action
from meshforge.language.actions.edit import Edit, Group
from meshforge.symbolic import SymbolicMesh, components


@dataclass(frozen=True, slots=True)
class Each(Action):
    """Does the action to every connected component of the selected hulls, body by body."""

    action: Action = field(metadata={"argument": Inner()})

    def conflict(self) -> str | None:
        return "Each cannot stand inside Each" if isinstance(self.action, Each) else None

    def groups(self, mesh: SymbolicMesh, mask: int) -> list[int]:
        return components(mesh, mask)

    def edit(self, group: Group) -> Edit:
        return self.action.edit(group)

    @property
    def templates(self) -> tuple[str, ...]:
        return self.action.templates

    @property
    def makes_hulls(self) -> bool:
        return self.action.makes_hulls
