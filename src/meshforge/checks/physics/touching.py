"""What a file says of contact: which hulls may touch, and how they rub."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations

from meshforge.symbolic import Hull, SymbolicMesh


@dataclass(frozen=True, slots=True)
class Contact:
    """How a hull collides, by the names and defaults of MJCF (XML reference, body/geom)."""

    contype: int = 1
    conaffinity: int = 1
    condim: int = 3
    priority: int = 0
    friction: tuple[float, ...] = (1.0, 0.005, 0.0001)

    def can_meet(self, other: Contact) -> bool:
        """Whether the bits let the two collide."""
        return bool(self.contype & other.conaffinity or other.contype & self.conaffinity)


class Touching:
    """The contact of each hull of a mesh, in order: of the file, for a made hull of its parent, else the default.

    apart: pairs of bodies that the file keeps apart; paired: of hulls, by number, that touch all the same.
    """

    def __init__(self, mesh: SymbolicMesh) -> None:
        geoms = {geom.name: geom for geom in mesh.asset.geoms} if mesh.asset else {}
        sources = [hull.parent or hull.name for hull in mesh.hulls]
        told = [dict(geoms[name].contact) if name in geoms else {} for name in sources]
        self.hulls: tuple[Hull, ...] = mesh.hulls
        self.contacts = [_contact(attributes) for attributes in told]
        mechanism = mesh.asset.mechanism if mesh.asset else None
        self.apart = {frozenset(pair) for pair in mechanism.apart} if mechanism else set()
        self.paired = set(_numbered(mechanism.paired, sources)) if mechanism else set()

    def may_touch(self, first: int, second: int) -> bool:
        """Whether two hulls may touch, by their numbers; joints say nothing here."""
        if frozenset((first, second)) in self.paired:
            return True
        bodies = frozenset((self.hulls[first].body, self.hulls[second].body))
        return bodies not in self.apart and self.contacts[first].can_meet(self.contacts[second])


def _contact(told: dict[str, str]) -> Contact:
    usual = Contact()
    return Contact(
        contype=int(told.get("contype", usual.contype)),
        conaffinity=int(told.get("conaffinity", usual.conaffinity)),
        condim=int(told.get("condim", usual.condim)),
        priority=int(told.get("priority", usual.priority)),
        friction=tuple(float(number) for number in told["friction"].split()) if "friction" in told else usual.friction,
    )


def _numbered(pairs: tuple[tuple[str, str], ...], sources: list[str]) -> Iterator[frozenset[int]]:
    """The pairs of hulls that were made of the geoms of a pair."""
    wanted = {frozenset(pair) for pair in pairs}
    touched = {name for pair in pairs for name in pair}
    of_pairs = [k for k, name in enumerate(sources) if name in touched]
    for first, second in combinations(of_pairs, 2):
        if frozenset((sources[first], sources[second])) in wanted:
            yield frozenset((first, second))
