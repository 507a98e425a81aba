"""What MuJoCo makes of a file before and after an edit, and whether it takes the whole or only a part."""

from __future__ import annotations

from meshforge.errors import AssetError
from meshforge.formats.mjcf.files.flat import flatten
from meshforge.formats.mjcf.files.sources import Tree
from meshforge.formats.mjcf.reading.engine import Compiled, compile_flat, compile_spec, parse_flat
from meshforge.formats.mjcf.reading.model import Reading
from meshforge.formats.mjcf.reading.reduce import reduced

_FREE = ("freejoint", "joint")


def whole(tree: Tree) -> Reading | None:
    """The model of a tree, None where MuJoCo refuses it."""
    flat = flatten(tree)
    try:
        return Reading(tree, flat, compile_flat(tree, flat))
    except AssetError:
        return None


def part(tree: Tree) -> Reading:
    """The model of the collision geometry of a tree that MuJoCo refuses. Raises AssetError."""
    refusal = AssetError("MuJoCo refuses its collision geometry", where=str(tree.main.path))
    found = reduced(tree, refusal, masses="fixed")
    return Reading(tree, found.flat, found.made, found.unweighed)


def again(tree: Tree, is_whole: bool) -> Reading:
    """The model of an edited tree, compiled as it was before. Raises AssetError with MuJoCo's message."""
    if not is_whole:
        return part(tree)
    flat = flatten(tree)
    return Reading(tree, flat, compile_flat(tree, flat))


def plain(tree: Tree, reading: Reading) -> Reading:
    """A whole reading with masses before they are scaled to a total, and free bodies in their authored frames."""
    if not any(_changes_masses(tree)):
        return reading
    flat = flatten(tree)
    spec = parse_flat(tree, flat)
    spec.compiler.settotalmass = -1
    spec.compiler.alignfree = False
    for joint in spec.joints:
        joint.align = 0
    made: Compiled = compile_spec(tree, flat, spec)
    return Reading(tree, flat, made)


def _changes_masses(tree: Tree) -> list[bool]:
    return [
        (node.tag == "compiler" and ("settotalmass" in node.attributes or "alignfree" in node.attributes))
        or (node.tag in _FREE and "align" in node.attributes)
        for node in tree.root.walk()
    ]
