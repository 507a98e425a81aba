"""Replace."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar, Literal

from meshforge.language.actions.arguments import PRIMITIVES, PrimitiveOrFile, Words
from meshforge.language.actions.base import Action
from meshforge.language.actions.edit import Edit, Group
from meshforge.language.actions.fitting import fitted_primitive, fitted_template


@dataclass(frozen=True, slots=True)
class Replace(Action):
    """Replaces the selected hulls of each body by a primitive or a template that fills their bounding box."""

    by_body: ClassVar[bool] = True
    geometry: str = field(metadata={"argument": PrimitiveOrFile()})
    fit: Literal["tight", "longest"] | None = field(default=None, metadata={"argument": Words(("tight", "longest"))})

    def conflict(self) -> str | None:
        if self.fit == "tight" and self.geometry not in ("box", "cylinder", "capsule"):
            return f"tight is for box, cylinder and capsule, not {self.geometry}"
        if self.fit == "longest" and self.geometry in PRIMITIVES:
            return f"longest is for template files, not {self.geometry}"
        return None

    @property
    def templates(self) -> tuple[str, ...]:
        return () if self.geometry in PRIMITIVES else (self.geometry,)

    def edit(self, group: Group) -> Edit:
        if self.templates:
            return Edit.insert(fitted_template(group, self.geometry, turned=self.fit == "longest"), group)
        shape, note = fitted_primitive(group, self.geometry, tight=self.fit == "tight")
        return Edit.insert((shape,), group, note=note)
