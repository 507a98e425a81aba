"""What a user should know about how an SDF was read."""

from __future__ import annotations

from collections.abc import Iterator

from meshforge.formats.sdf.files.config import CONFIG, is_main, main_file
from meshforge.formats.sdf.files.elements import geometry_of
from meshforge.formats.sdf.files.version import NEWEST
from meshforge.formats.sdf.reading.compose import Composed
from meshforge.formats.sdf.reading.links import Links
from meshforge.words import counted, listed


def notes(composed: Composed, links: Links) -> tuple[str, ...]:
    """Notes on worlds, older versions of a model, collisions without a shape, and what is decomposed when loaded."""
    return (*_worlds(composed), *_newer(composed), *_older(composed), *_actors(composed), *_shapes(links))


def _worlds(composed: Composed) -> Iterator[str]:
    if composed.worlds:
        yield f"it is a world of {counted(len(composed.root.inner), 'model')}, which is only read"


def _newer(composed: Composed) -> Iterator[str]:
    if composed.root.version > NEWEST:
        told, known = (".".join(map(str, version)) for version in (composed.root.version, NEWEST))
        yield f"SDF {told} is newer than {known}: what is new in it is not understood"


def _older(composed: Composed) -> Iterator[str]:
    """A note where the folder's `model.config` names another file for newer versions."""
    path = composed.sources[0].path
    newest = None if is_main(path) else main_file(path.parent)
    if newest is not None:
        yield f"{CONFIG} names {newest.name} for newer versions of Gazebo, which do not read this file"


def _actors(composed: Composed) -> Iterator[str]:
    lines = [e.line for e in composed.root.element.each("actor")]
    if lines:
        yield f"{counted(len(lines), 'actor')}, the first on line {lines[0]}: passed over"


def _shapes(links: Links) -> Iterator[str]:
    bare = [f"line {c.element.line}" for c in links.collisions if geometry_of(c.element) is None]
    if bare:
        yield f"{counted(len(bare), 'collision')} without geometry ({listed(bare, 3)}): passed over"
    kinds = [geometry_of(collision.element) for collision in links.collisions]
    cut = [k for k in kinds if k is not None and k.attributes.get("optimization") == "convex_decomposition"]
    if cut:
        yield f"{counted(len(cut), 'mesh', 'meshes')} to be decomposed by Gazebo when loaded, shown as authored"
