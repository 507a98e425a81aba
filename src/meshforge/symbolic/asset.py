"""What every file becomes: bodies with poses, convex geoms, pieces that are no hulls, and the source document."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Literal

from meshforge.geometry import Aabb, Floats, Ints, Pose, Shape
from meshforge.symbolic.mechanism import Mechanism

Mentions = tuple[tuple[str, str], ...]
"""What a file calls a piece of collision geometry besides its own name and its body's: of what kind, and the name.

Kinds: `visual`, `mesh`, `group`, `node` and `class` are its own; `shown` is what its body shows; `material`.
"""


@dataclass(frozen=True, eq=False, slots=True)
class Body:
    """A rigid part (URDF link, MJCF body); pose: root_T_body with every joint at zero."""

    name: str
    pose: Pose


@dataclass(frozen=True, eq=False, slots=True)
class Geom:
    """One convex collision shape in the root frame.

    name: unique in the asset, for ever: a made geom never takes the name of a source geom.
    parent: None for a geom of the file, which is written back as authored; for a made one, the source geom
    whose contact attributes it inherits.
    contact: those attributes of a geom of the file, by the format's names for them, where it has them geom by geom.
    mentions: what else the file calls it, which may tell what it is; a writer takes no notice of it.
    """

    name: str
    body: str
    shape: Shape
    parent: str | None = None
    contact: tuple[tuple[str, str], ...] = ()
    mentions: Mentions = ()


@dataclass(frozen=True, eq=False, slots=True)
class Surface:
    """Triangles to look at, or to decompose; vertices (n, 3) [m] in the root frame, faces (m, 3).

    body: the one that shows it, None where that is not told; rgba: its colour, four shares of 1, None where it has no
    single one.
    """

    vertices: Floats
    faces: Ints
    body: str | None = None
    rgba: tuple[float, float, float, float] | None = None


@dataclass(frozen=True, eq=False, slots=True)
class Opaque:
    """Collision geometry that is no convex hull: shown with its reason, never selected, written back untouched.

    plane: root_T_plane of one that is an endless plane, whose normal is Z; mentions: as of `Geom`.
    """

    name: str
    body: str
    reason: str
    surface: Surface | None = None
    plane: Pose | None = None
    mentions: Mentions = ()


class Document:
    """Base of the kept source of an asset; each format keeps in its own subclass what it needs to write back.

    A document is immutable and pickles, so that an asset can go to a worker process and come back.
    """

    __slots__ = ()


@dataclass(frozen=True, eq=False)
class Asset:
    """A file with collision geometry; immutable, an edit is a new asset with other geoms.

    files: every file that the document refers to, found, absolute, in order of mention.
    missing: references to visual files that are not there, as written in the document.
    notes: what a user should know about how the file was read; up: the axis that its format says points up.
    mechanism: joints and masses, empty where the format has none.
    """

    path: Path
    format: str
    bodies: tuple[Body, ...]
    geoms: tuple[Geom, ...]
    document: Document
    opaque: tuple[Opaque, ...] = ()
    visuals: Sequence[Surface] = ()
    files: tuple[Path, ...] = ()
    missing: tuple[str, ...] = ()
    notes: tuple[str, ...] = field(default=())
    mechanism: Mechanism = field(default=Mechanism())
    up: Literal["y", "z"] | None = None

    @property
    def body_poses(self) -> dict[str, Pose]:
        return {body.name: body.pose for body in self.bodies}

    @property
    def aabb(self) -> Aabb | None:
        """The box around all geoms, None where there is none."""
        return Aabb.union(g.shape.aabb for g in self.geoms) if self.geoms else None

    def with_geoms(self, geoms: Iterable[Geom]) -> Asset:
        return replace(self, geoms=tuple(geoms))


def unique_names(names: Iterable[str]) -> list[str]:
    """The names in order, a repeated one made unique by `@2`, `@3`, ...; a name that is unique stays as it is."""
    names = list(names)
    taken, out = set(names), []
    seen: dict[str, int] = {}
    for name in names:
        seen[name] = seen.get(name, 0) + 1
        unique = name
        while seen[name] > 1 and unique in taken:
            unique = f"{name}@{seen[name]}"
            seen[name] += unique in taken
        taken.add(unique)
        out.append(unique)
    return out
