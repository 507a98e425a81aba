"""What an action is given and what it gives back: a group of hulls, and the edit of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from meshforge.geometry import FLATNESS, Aabb, Floats, Shape
from meshforge.language.template import Template, check_templates
from meshforge.symbolic import Hull

_EQUAL = 1e-9  # volumes of like hulls differ by rounding, which must not choose between them
_NO_EXTENT = 1e-9  # sides below this share of L are rounding, not extent


@dataclass(frozen=True, eq=False)
class Group:
    """The hulls that an action edits at once: all of C, or one body or component of it.

    length: L of the run [m]; templates: by the paths that programs write.
    """

    hulls: tuple[Hull, ...]
    length: float
    templates: Mapping[str, Template]

    @cached_property
    def bounds(self) -> Aabb:
        """B(C), a side without extent thickened."""
        box = Aabb.union(hull.aabb for hull in self.hulls)
        grow = np.where(box.size < _NO_EXTENT * self.length, self.thickness / 2, 0.0)
        return Aabb(box.min - grow, box.max + grow)

    @property
    def thickness(self) -> float:
        """What degenerate results are thickened to [m]."""
        return FLATNESS * self.length

    @property
    def largest(self) -> Hull:
        """The hull of the largest volume, of those that are equal but for rounding the first."""
        most = max(hull.volume for hull in self.hulls)
        return next(hull for hull in self.hulls if hull.volume >= most * (1 - _EQUAL))

    @property
    def points(self) -> Floats:
        """The vertices of all hulls (n, 3); of round primitives, those of their tessellation."""
        return np.concatenate([hull.vertices for hull in self.hulls])

    @property
    def has_round(self) -> bool:
        """Whether `points` stand in for a round primitive."""
        return any(hull.shape.kind not in ("polytope", "box") for hull in self.hulls)

    def template(self, name: str) -> Template:
        check_templates([name], self.templates)
        return self.templates[name]


@dataclass(frozen=True, eq=False, slots=True)
class Made:
    """A shape that an edit makes; heir: the hull whose label, body and attributes it takes over.

    sources: the hulls it was made from.
    """

    shape: Shape
    heir: Hull
    sources: tuple[Hull, ...]


@dataclass(frozen=True, eq=False, slots=True)
class Edit:
    """What an action does to one group; removes: whether its hulls go."""

    made: tuple[Made, ...] = ()
    removes: bool = True
    note: str | None = None

    @staticmethod
    def insert(shapes: tuple[Shape, ...], group: Group, *, removes: bool = True, note: str | None = None) -> Edit:
        """The edit that puts shapes made from the whole group into the mesh."""
        return Edit(tuple(Made(shape, group.largest, group.hulls) for shape in shapes), removes, note)
