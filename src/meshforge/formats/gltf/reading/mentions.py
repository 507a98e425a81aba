"""What a glTF file calls its collision besides the names of hulls: by nodes, meshes and materials."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from meshforge.asset import Mentions
from meshforge.formats.gltf.reading.sources import Source
from meshforge.formats.mentioned import without_repeats
from meshforge.formats.meshfile.gltf import Json, Scene
from meshforge.formats.meshfile.gltf.items import entries, entry

_DAMAGE = (ValueError, LookupError, TypeError, AttributeError)


def source_mentions(scene: Scene, source: Source) -> list[Mentions]:
    """What is said of each piece of a node with collision; nothing where that is damaged, which hurts no one."""
    try:
        return _mentions(scene, source)
    except _DAMAGE:
        return [()] * len(source.parts)


def _mentions(scene: Scene, source: Source) -> list[Mentions]:
    placement = scene.placements[source.node]
    node, parent = placement.node, placement.parent
    common = [("node", _name(node))]
    mesh = entry(scene.tree, "meshes", node["mesh"]) if "mesh" in node else {}
    common += [("mesh", _name(mesh))]
    common += [("node", _name(scene.placements[parent].node))] if parent is not None else []
    materials = [_name(material) for material in _materials(scene.tree, mesh)]
    own = _of_pieces(scene, source, node, materials)
    return [without_repeats([*common, *(("material", name) for name in names)]) for names in own]


def _of_pieces(scene: Scene, source: Source, node: Json, materials: Sequence[str]) -> list[list[str]]:
    """The names of the materials of each piece, those of the primitives that its triangles are of."""
    if source.owner is None or "mesh" not in node:
        return [list(materials)] * len(source.parts)
    patches = scene.mesh(node["mesh"]).patches
    of_face = np.repeat([patch.index for patch in patches], [len(patch.faces) for patch in patches])
    if len(of_face) != len(source.owner):
        return [list(materials)] * len(source.parts)
    return [[materials[k] for k in np.unique(of_face[source.owner == part])] for part in range(len(source.parts))]


def _materials(tree: Json, mesh: Json) -> Iterator[Json]:
    """The material of each primitive of a mesh; one without any is empty."""
    for part in entries(mesh, "primitives"):
        yield entry(tree, "materials", part["material"]) if "material" in part else {}


def _name(thing: Json) -> str:
    name = thing.get("name")
    return name if isinstance(name, str) else ""
