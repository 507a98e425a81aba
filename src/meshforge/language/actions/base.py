"""What every action has in common: arguments that are dataclass fields, groups of hulls to act on, an edit of each."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import MISSING, Field, dataclass, fields
from functools import cached_property
from typing import Any, ClassVar, cast

import numpy as np

from meshforge.errors import ProgramError
from meshforge.geometry import FLATNESS, Aabb, Floats, Shape
from meshforge.language.actions.arguments import Argument
from meshforge.language.groups import bodies
from meshforge.language.template import Template, check_templates
from meshforge.symbolic import Hull, SymbolicMesh

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
        """The hull of the largest volume, of equals the first."""
        return max(self.hulls, key=lambda hull: hull.volume)

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
    def inserting(shapes: tuple[Shape, ...], group: Group, *, removes: bool = True, note: str | None = None) -> Edit:
        """The edit that puts shapes made from the whole group into the mesh."""
        return Edit(tuple(Made(shape, group.largest, group.hulls) for shape in shapes), removes, note)


class Action(ABC):
    """One editing action. A subclass is a frozen dataclass; its fields, in order, are its arguments in a program."""

    __slots__ = ()
    makes_hulls: ClassVar[bool] = True
    """Whether `as LABEL` may follow."""
    by_body: ClassVar[bool] = False
    """Whether it acts on each body's hulls separately, since what it makes is one part."""

    def __post_init__(self) -> None:
        for name, argument in self.arguments().items():
            value = getattr(self, name)
            if value != _field_default(type(self), name) and not argument.fits(value):
                raise ProgramError(
                    f"{type(self).__name__} cannot take {value!r} as its {name}", remedy=f"Write {self.usage()}."
                )
        clash = self.clash()
        if clash:
            raise ProgramError(clash, remedy=f"Write {self.usage()}.")

    def clash(self) -> str | None:
        """Why the arguments do not go together, None where they do."""
        return None

    def groups(self, mesh: SymbolicMesh, mask: int) -> list[int]:
        """The parts of a selection that are edited one by one, as bit sets."""
        return bodies(mesh, mask) if self.by_body else [mask] if mask else []

    @abstractmethod
    def edit(self, group: Group) -> Edit:
        """What becomes of one group of at least one hull. Raises ProgramError for a missing template."""

    @property
    def templates(self) -> tuple[str, ...]:
        """The template files it names."""
        return ()

    @classmethod
    def arguments(cls) -> dict[str, Argument]:
        """The kind of each argument by the name of its field, in order."""
        return {f.name: cast(Argument, f.metadata["argument"]) for f in _fields(cls)}

    @classmethod
    def required(cls) -> int:
        """How many arguments cannot be left out."""
        return sum(f.default is MISSING for f in _fields(cls))

    @classmethod
    def usage(cls) -> str:
        """How it is written: `Add(+X|-X|..., "file"[, keep])`."""
        parts = ""
        for k, argument in enumerate(cls.arguments().values()):
            text = f"{', ' if k else ''}{argument.usage}"
            parts += text if k < cls.required() else f"[{text}]"
        return f"{cls.__name__}({parts})" if parts else cls.__name__

    @classmethod
    def summary(cls) -> str:
        """What it does, in one sentence."""
        return (cls.__doc__ or "").strip().splitlines()[0]

    def __str__(self) -> str:
        shown = [
            argument.show(getattr(self, name))
            for name, argument in self.arguments().items()
            if getattr(self, name) != _field_default(type(self), name)
        ]
        return f"{type(self).__name__}({', '.join(shown)})" if shown else type(self).__name__


def _fields(kind: type[Action]) -> tuple[Field[Any], ...]:
    return fields(cast(Any, kind))


def _field_default(kind: type[Action], name: str) -> Any:
    return next(f.default for f in _fields(kind) if f.name == name)
