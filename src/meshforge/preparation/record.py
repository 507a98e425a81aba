"""A preparation as data: which pieces of an asset are replaced by which hulls, in order, and how these were made."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Literal

from meshforge.geometry import Polytope
from meshforge.words import counted

Kind = Literal["opaque", "body", "hull"]
"""What is replaced: an opaque piece; nothing, by what a body without collision geometry shows; or a hull."""


@dataclass(frozen=True, slots=True)
class Replaced:
    """One piece and the hulls that stand in its place.

    what: the name of the piece, or of the body; source: the digest of its geometry, by which a change is noticed;
    made: the digest of each hull by its name; told: how well they fit, for people.
    """

    what: str
    kind: Kind
    source: str
    made: dict[str, str]
    told: str = ""


@dataclass(frozen=True, slots=True)
class Step:
    """One thing done to an asset.

    do: `decompose` by an engine, `cut` a hull along a plane, or `split` it by a decomposition of what is seen there.
    settings: all that it was done with; software: the versions of what did it.
    """

    do: Literal["decompose", "cut", "split"]
    settings: dict[str, Any]
    software: dict[str, str]
    replaced: tuple[Replaced, ...]

    def __str__(self) -> str:
        """`link/geom0 decomposed into 12 hulls by coacd`."""
        names = [entry.what for entry in self.replaced]
        what = names[0] if len(names) == 1 else f"{len(names)} pieces"
        done = {"decompose": "decomposed", "cut": "cut", "split": "split"}[self.do]
        by = f" by {self.settings['method']}" if "method" in self.settings else ""
        return f"{what} {done} into {counted(sum(len(entry.made) for entry in self.replaced), 'hull')}{by}"


@dataclass(frozen=True, eq=False, slots=True)
class Preparation:
    """All that is done to one asset, in order; hulls: every hull that the steps name, by the digest they name it by."""

    steps: tuple[Step, ...] = ()
    hulls: Mapping[str, Polytope] = field(default_factory=dict)

    @property
    def hull_digests(self) -> dict[str, str]:
        """The digests of all hulls it makes by name, those that later steps replace too."""
        return {name: known for step in self.steps for r in step.replaced for name, known in r.made.items()}

    @property
    def source_names(self) -> tuple[str, ...]:
        """The names of the pieces and bodies that got hulls."""
        return tuple(r.what for step in self.steps for r in step.replaced if r.kind != "hull")

    @property
    def hulls_replaced(self) -> frozenset[str]:
        """The names of the hulls that its steps put others in the place of, authored ones too."""
        return frozenset(r.what for step in self.steps for r in step.replaced if r.kind == "hull")

    def with_step(self, step: Step, hulls: Iterable[Polytope]) -> Preparation:
        """With one step more, which makes these hulls."""
        return Preparation((*self.steps, step), {**self.hulls, **{hull_digest(hull): hull for hull in hulls}})

    def with_only(self, steps: Iterable[Step]) -> Preparation:
        """With these of its steps, and their hulls."""
        shorter = replace(self, steps=tuple(steps))
        return replace(shorter, hulls={known: self.hulls[known] for known in shorter.hull_digests.values()})


def hull_digest(hull: Polytope) -> str:
    """A digest of a hull to the last bit; zero has no sign."""
    content = (hull.vertices + 0.0).tobytes() + hull.faces.tobytes()
    return hashlib.blake2b(content, digest_size=8).hexdigest()


def free_names(base: str, count: int, taken: Iterable[str]) -> list[str]:
    """Names `base#0`, `base#1`, ... for new hulls, numbers that are taken left out."""
    taken, number = set(taken), 0
    names: list[str] = []
    while len(names) < count:
        name = f"{base}#{number}"
        names += [] if name in taken else [name]
        number += 1
    return names
