"""What is kept of an MJCF to write it back: its files, and which hulls were read from which of its elements."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from meshforge.asset import Document, unique_names
from meshforge.formats.mjcf.files.sources import Source, Tree, gather
from meshforge.geometry import Floats, Pose


@dataclass(frozen=True, eq=False, slots=True)
class Authored:
    """A `<geom>` of the file that MuJoCo makes geoms of, or geoms that have no element in these files.

    source, start: the file and the byte offset in its text, as in the tree's nodes; source -1 for geoms out of a
    sub-model, which have no element here. body: its body, that of the first copy. names: what each copy is called in
    the asset, in the order of the compiled model; visual ones have names too, though the asset does not show them.
    collides: whether its copies take part in collisions. fixed: why an edit cannot change it, empty where it can.
    """

    source: int
    start: int
    body: str
    names: tuple[str, ...]
    collides: bool
    fixed: str = ""


@dataclass(frozen=True, eq=False, slots=True)
class MjcfBody:
    """A body as MuJoCo compiled it, before static bodies are fused.

    name: as in the asset; parent: None for the world. source, start: its element, source -1 where it has none here.
    pose: root_T_body in the reference configuration; inertial: body_T_inertial; mass [kg]; inertia: (3,) moments about
    the axes of `inertial` [kg m^2]; explicit: whether an `<inertial>` of the file tells them.
    """

    name: str
    parent: str | None
    source: int
    start: int
    pose: Pose
    inertial: Pose
    mass: float
    inertia: Floats
    explicit: bool


@dataclass(frozen=True, eq=False, slots=True)
class MjcfDocument(Document):
    """The source of an asset read from an MJCF.

    sources: the authored files, main first, then in order of mention; authored: one entry a geom element, in document
    order; bodies: in MuJoCo's order, the world first; refusal: MuJoCo's message where it refuses the file, of which
    then only the collision geometry was read, with masses that may be none.
    """

    sources: tuple[Source, ...]
    authored: tuple[Authored, ...]
    bodies: tuple[MjcfBody, ...]
    refusal: str = ""

    @property
    def tree(self) -> Tree:
        """The elements of all files, parsed from the kept bytes."""
        return gather(self.sources[0].path, {source.path: source.raw for source in self.sources})


def geom_names(geoms: Sequence[tuple[str, str]]) -> list[str]:
    """The names that geoms read as; for each, in MuJoCo's order, the name of its body and its own, empty without one.

    `body/name`, or `body/geomK` for the K-th geom of a body, visual ones counted too: so a name does not depend on
    contact bits, which a default class may set. A name that begins with `body/` is the whole name: in MuJoCo names are
    unique in the model, so an edit names a geom so where its plain name is another body's geom's already.
    """
    count: dict[str, int] = {}
    names = []
    for body, name in geoms:
        tail = name.removeprefix(f"{body}/") or f"geom{count.get(body, 0)}"
        names.append(f"{body}/{tail}")
        count[body] = count.get(body, 0) + 1
    return unique_names(names)


def body_names(names: Sequence[str]) -> list[str]:
    """The names of bodies in MuJoCo's order; the K-th is `bodyK` where it has none, the world is the 0-th."""
    return unique_names(name or f"body{k}" for k, name in enumerate(names))
