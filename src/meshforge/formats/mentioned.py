"""What a description calls its collision geometry besides its own names: by the meshes, classes and visuals it has."""

from __future__ import annotations

import posixpath
from collections.abc import Hashable, Iterable, Sequence
from dataclasses import dataclass

from meshforge.asset import Mentions


@dataclass(frozen=True, slots=True)
class Named:
    """The names of a shape that collides or is shown, empty where it has none.

    shape: what it is, so that one which is shown is known again where it collides; of a mesh, its reference.
    """

    shape: Hashable
    name: str = ""
    mesh: str = ""
    material: str = ""


def mentions(own: Named, shown: Sequence[Named], more: Iterable[tuple[str, str]] = ()) -> Mentions:
    """What is said of a shape that collides; shown: what its body shows; more: what else its file says of it.

    A visual of the same shape is the shape itself to look at. What else the body shows counts where that is one thing.
    """
    twins = [other for other in shown if other.shape == own.shape]
    alone = shown[0] if len(shown) == 1 and not twins else None
    found = [("visual", twin.name) for twin in twins]
    found += [("mesh", own.mesh), *more]
    found += [("shown", alone.name), ("shown", alone.mesh)] if alone else []
    found += [("material", named.material) for named in (own, *twins, *([alone] if alone else []))]
    return without_repeats(found)


def without_repeats(found: Iterable[tuple[str, str | None]]) -> Mentions:
    """The mentions that say something, each name once."""
    names: dict[str, str] = {}
    for kind, name in found:
        if name and name.strip():
            names.setdefault(name.strip(), kind)
    return tuple((kind, name) for name, kind in names.items())


def stem(reference: str) -> str:
    """The name of a file that is referred to, without folder and suffix."""
    return posixpath.splitext(posixpath.basename(reference.replace("\\", "/").strip()))[0]
