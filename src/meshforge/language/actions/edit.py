"""What an action is given and what it gives back: hull templates, a group of hulls, and the edit of it."""

import hashlib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from meshforge.common import ProgramError
from meshforge.geometry import FLATNESS, Aabb, Floats, Shape
from meshforge.language.hull_table import reference_length
from meshforge.symbolic import Hull, SymbolicMesh

_EQUAL = 1e-9  # volumes of like hulls differ by rounding, which must not choose between them
_NO_EXTENT = 1e-9  # sides below this share of L are rounding, not extent


@dataclass(frozen=True, eq=False)
class HullGroup:
    """The hulls that an action edits at once: all of C, or one body or component of it.

    mesh: the whole, before the action; templates: by the paths that programs write.
    """

    hulls: tuple[Hull, ...]
    mesh: SymbolicMesh
    templates: "Mapping[str, Template]"

    @property
    def length(self) -> float:
        """L of the run [m]."""
        return reference_length(self.mesh)

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

    def template(self, name: str) -> "Template":
        check_templates([name], self.templates)
        return self.templates[name]


@dataclass(frozen=True, eq=False, slots=True)
class NewShape:
    """A shape that an edit makes; main_source: the hull whose label, body and attributes it takes over.

    sources: the hulls it was made from.
    """

    shape: Shape
    main_source: Hull
    sources: tuple[Hull, ...]


@dataclass(frozen=True, eq=False, slots=True)
class GroupEdit:
    """What an action does to one group; removes: whether its hulls go; fits: False where they stay as they are, since
    what would be made does not fit."""

    made: tuple[NewShape, ...] = ()
    removes: bool = True
    note: str | None = None
    fits: bool = True

    def replaces_one(self, made: NewShape) -> bool:
        """Return whether a made shape takes the place of one hull alone."""
        return (
            self.removes
            and len(made.sources) == 1
            and sum(one.main_source is made.main_source for one in self.made) == 1
        )

    @staticmethod
    def insert(
        shapes: tuple[Shape, ...], group: HullGroup, *, removes: bool = True, note: str | None = None
    ) -> "GroupEdit":
        """Return the edit that puts shapes made from the whole group into the mesh."""
        return GroupEdit(tuple(NewShape(shape, group.largest, group.hulls) for shape in shapes), removes, note)


@dataclass(frozen=True, eq=False)
class Template:
    """The convex shapes of one template file, in the file's own frame; name: the path as programs write it."""

    shapes: tuple[Shape, ...]
    name: str

    def __post_init__(self) -> None:
        if not self.shapes:
            raise ProgramError("a template needs at least one convex hull, it has none", where=self.name)

    @cached_property
    def digest(self) -> str:
        """Thirty-two hexadecimal digits of its shapes, to the last bit: what is made of it follows from them."""
        data = hashlib.blake2b(digest_size=16)
        for shape in self.shapes:
            for part in (shape.kind.encode(), shape.vertices.tobytes(), shape.faces.tobytes()):
                data.update(len(part).to_bytes(8, "little") + part)
        return data.hexdigest()

    @property
    def aabb(self) -> Aabb:
        """The box around all its shapes."""
        return Aabb.union(shape.aabb for shape in self.shapes)


def check_templates(wanted: Iterable[str], templates: Mapping[str, Template]) -> None:
    """Raise ProgramError naming the first wanted template that is not among those given."""
    for name in wanted:
        if name not in templates:
            known = ", ".join(sorted(templates)) or "none"
            remedy = "Templates are looked for beside the program, then in the folder templates/ beside it."
            raise ProgramError(f'there is no template "{name}" (templates given: {known})', remedy=remedy)
