"""Merge."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from meshforge.geometry import convex_hull
from meshforge.language.actions.base import Action
from meshforge.language.actions.edit import Edit, Group


@dataclass(frozen=True, slots=True)
class Merge(Action):
    """Replaces the selected hulls of each body by the convex hull of all their points; a single hull stays as it is."""

    by_body: ClassVar[bool] = True

    def edit(self, group: Group) -> Edit:
        if len(group.hulls) == 1:
            return Edit(removes=False)
        hull = convex_hull(group.points, name=group.largest.name, thicken=group.thickness)
        note = "round primitives were merged by their tessellated points" if group.has_round else None
        return Edit.insert((hull,), group, note=note)
