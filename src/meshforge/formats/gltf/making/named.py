"""Making a glTF file whose collision an engine knows by name: a node for each body, and its hulls below that."""

from __future__ import annotations

from pathlib import PurePosixPath

import numpy as np

from meshforge.asset import Asset, Surface
from meshforge.formats.base import Output
from meshforge.formats.gltf.document import GltfDocument
from meshforge.formats.gltf.making.new_scene import bare_tree, material, new_draft, packed_new
from meshforge.formats.gltf.writing.naming import settle
from meshforge.formats.gltf.writing.shape_entries import place_keys
from meshforge.formats.meshfile.gltf import Json
from meshforge.formats.naming.base import EngineNames
from meshforge.formats.naming.families import Families, Family, families
from meshforge.geometry import Floats, Ints


def create_named(asset: Asset, name: str, engine: EngineNames) -> Output:
    """The files of an asset with the names of an engine.

    No node is scaled. For Unreal, the meshes of a body are in its frame, since its importers have not always obeyed the
    places of nodes with collision; for others they lie about their own middle, so that single precision is fine.
    """
    path = PurePosixPath(name)
    found = families(asset, engine, path.stem)
    main, made, names = _Maker(asset, found, engine, path.suffix.lower() == ".glb").build_files(path.stem)
    return Output(main, made, names=names, lost=found.lost, notes=found.notes)


_FAR = 1e4  # sizes of a hull away from its body, beyond which single precision would spoil it


class _Maker:
    def __init__(self, asset: Asset, found: Families, engine: EngineNames, is_binary: bool) -> None:
        self.found, self.engine, self.is_binary = found, engine, is_binary
        tree = bare_tree()
        tree["scenes"][0]["nodes"] = list(range(len(found.each)))
        tree["nodes"] = [{"name": family.name, **place_keys(family.body.pose)} for family in found.each]
        self.draft = new_draft(tree, asset.path, is_binary)

    def build_files(self, stem: str) -> tuple[bytes, dict[str, bytes], dict[str, str]]:
        """The main file, the one of its buffer, and the names of hulls in it."""
        for node, family in enumerate(self.found.each):
            if family.surfaces:
                self.draft.node(node)["mesh"] = self._add_visuals(family, node)
            self._add_collision(family, node)
        document = GltfDocument(b"", self.engine.engine, ())
        misread = settle(self.draft, document, renames=False)  # by the names of the asset
        known = {geom: name for geom, name in misread.items() if geom in self.found.names}
        return *packed_new(self.draft, stem, self.is_binary), known

    def _add_visuals(self, family: Family, node: int) -> int:
        """One mesh of all that is seen of a body, a part for each surface."""
        draft, parts = self.draft, []
        for surface in family.surfaces:
            points = draft.points_in(np.asarray(surface.vertices), node)
            parts.append(draft.build_primitive(points, surface.faces, material(draft.tree, surface.rgba)))
        return draft.add_mesh({"name": family.name, "primitives": parts})

    def _add_collision(self, family: Family, node: int) -> None:
        """The nodes of what collides of a body."""
        if not family.hulls and not family.opaque:
            return
        above = self.engine.holder(family.name)
        holder = node if above is None else self.draft.add_node({"name": above}, node)
        for name, geom in family.hulls.items():
            hull = self.draft.shape_in(geom.shape, node).tessellate()
            self._add_node(name, hull.vertices, hull.faces, holder, geom.name)
        for name, piece in family.opaque.items():
            assert isinstance(piece.surface, Surface)  # no other is in a family
            points = self.draft.points_in(np.asarray(piece.surface.vertices), node)
            self._add_node(name, points, piece.surface.faces, holder, piece.name)

    def _add_node(self, name: str, points: Floats, faces: Ints, holder: int, known: str) -> None:
        """A node with a mesh; known: the name of the piece in the asset."""
        middle, reach = (points.min(axis=0) + points.max(axis=0)) / 2, np.ptp(points, axis=0).max()
        if not self.engine.centred and np.abs(middle).max() < _FAR * reach:
            middle = np.zeros(3)
        mesh = self.draft.add_mesh({"name": name, "primitives": [self.draft.build_primitive(points - middle, faces)]})
        node: Json = {"name": name, "mesh": mesh}
        placed = {"translation": middle.tolist()} if middle.any() else {}
        self.draft.expected[self.draft.add_node({**node, **placed}, holder)] = (known,)
