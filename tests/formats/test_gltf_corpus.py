"""Every real glTF file: read, written back unedited, and edited with the rest as it was for trimesh and Khronos."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
import trimesh

from meshforge.common import AssetError
from meshforge.formats import read, save
from meshforge.formats.gltf.document import GltfDocument
from meshforge.geometry import Box, Floats, is_same_shape
from meshforge.symbolic import Asset, Geom
from tests.corpus_path import corpus
from tests.gltf_files import Tree, tree_of
from tests.gltf_validation import errors

EMPTY = ("scenes_robots/trimesh/empty_nodes.glb", "weird/20_empty_nodes.glb")
# hulls and opaque pieces of files of each kind: parts in one node, nodes, none convex
COUNTS = {
    "chairs/KayKit-Furniture-Bits-1.0/chair_A.gltf": (9, 0),
    "chairs/KayKit-Furniture-Bits-1.0/couch.gltf": (3, 1),
    "tables_desks/KayKit-Furniture-Bits-1.0/table_medium.gltf": (4, 1),  # its top has a step all around, below
    "doors_cabinets/KayKit-Restaurant-Bits-1.0/fridge_A.gltf": (8, 12),
    "kettles_teapots/drake-models-tutorials/assets/tea_set_01_1k.gltf": (0, 10),
    "scenes_robots/trimesh/boolean.glb": (24, 4),
    "scenes_robots/trimesh/nested.glb": (3, 0),
    "scenes_robots/trimesh/simple_pole.glb": (11, 0),
    "scenes_robots/trimesh/TestScene.gltf": (8, 1),
}


@dataclass(frozen=True, eq=False)
class Drawn:
    """A node with a mesh, as trimesh has it."""

    place: Floats
    faces: int
    extents: Floats
    material: str

    def is_like(self, other: Drawn) -> bool:
        same = self.faces == other.faces and self.material == other.material
        return same and np.allclose(self.place, other.place) and np.allclose(self.extents, other.extents)


def drawn(path: Path) -> list[Drawn]:
    """The nodes that trimesh draws; their names are its own where they occur again, and of no use."""
    scene = trimesh.load_scene(path, process=False)
    found = []
    for node in scene.graph.nodes_geometry:
        place, geometry = scene.graph[node]
        mesh = scene.geometry[geometry]
        material = getattr(getattr(mesh.visual, "material", None), "name", None)
        found.append(Drawn(place, len(mesh.faces), mesh.extents, str(material)))
    return found


def unmatched(before: list[Drawn], after: list[Drawn]) -> list[Drawn]:
    """Those drawn before that are not drawn after, each by a node of its own."""
    left, gone = list(after), []
    for thing in before:
        like = next((k for k, other in enumerate(left) if thing.is_like(other)), None)
        if like is None:
            gone.append(thing)
        else:
            del left[like]
    return gone


@pytest.fixture(scope="module")
def files() -> dict[str, Path]:
    root = corpus()
    paths = sorted([*root.rglob("*.glb"), *root.rglob("*.gltf")])
    return {path.relative_to(root).as_posix(): path for path in paths}


@pytest.fixture(scope="module")
def assets(files: dict[str, Path]) -> dict[str, Asset]:
    return {key: read(path) for key, path in files.items() if key not in EMPTY}


def test_all_are_read_but_those_without_a_mesh(files: dict[str, Path], assets: dict[str, Asset]) -> None:
    assert len(assets) >= 45
    for key in EMPTY:
        with pytest.raises(AssetError, match="there is no mesh and no collider in its scene"):
            read(files[key])
    for key, (hulls, opaque) in COUNTS.items():
        assert (len(assets[key].geoms), len(assets[key].non_convex)) == (hulls, opaque), key


def test_an_unedited_write_back_is_the_same_files(assets: dict[str, Asset], tmp_path: Path) -> None:
    for key, asset in assets.items():
        saved = save(asset, tmp_path / key)
        assert saved.path.read_bytes() == asset.path.read_bytes(), key
        for file in asset.files:
            copy = saved.path.parent / file.relative_to(asset.path.parent)
            assert copy.read_bytes() == file.read_bytes(), key
        if key.startswith("scenes_robots"):
            before, after = drawn(asset.path), drawn(saved.path)
            assert len(before) == len(after) and not unmatched(before, after), key


def edited(asset: Asset) -> tuple[Asset, set[int], int]:
    """The last hull gone and the first one a box; the nodes that this touches, and how many triangles it takes."""
    assert isinstance(asset.document, GltfDocument)
    first, gone = asset.geoms[0], {geom.name for geom in (asset.geoms[0], asset.geoms[-1])}
    boxed = Geom(f"{first.name}~1", first.body, Box.of_bounds(first.shape.aabb), first.name)
    touched, less = set(), 0
    for element in asset.document.authored:
        for k, name in enumerate(element.names):
            if name in gone and element.owner is not None:
                touched.add(element.node)
                less += int((element.owner == k).sum())
    kept = [geom for geom in asset.geoms if geom.name not in gone]
    return asset.with_geoms([*kept, boxed]), touched, less - 12


@pytest.mark.slow
@pytest.mark.parametrize("suffix", ["same", ".glb"])
def test_an_edit_leaves_the_rest_of_the_scene_as_it_was(assets: dict[str, Asset], tmp_path: Path, suffix: str) -> None:
    sources, outs = [], []
    for key, asset in assets.items():
        if len(asset.geoms) < 2:
            continue
        changed, touched, less = edited(asset)
        out = tmp_path / key
        saved = save(changed, out if suffix == "same" else out.with_suffix(suffix), collision="replace")
        again = read(saved.path)
        assert not saved.names, key
        assert [g.name for g in again.geoms if "~" not in g.name] == [g.name for g in asset.geoms[1:-1]], key
        for now, before in zip((g for g in again.geoms if "~" not in g.name), asset.geoms[1:-1], strict=True):
            assert is_same_shape(now.shape, before.shape, 1e-9), key
        assert [o.name for o in again.non_convex] == [o.name for o in asset.non_convex], key
        _assert_rest_is_drawn(asset, saved.path, touched, less, key)
        sources.append(asset.path)
        outs.append(saved.path)
    assert len(outs) >= 25
    for out, told_before, told in zip(outs, errors(sources), errors(outs), strict=True):
        assert told <= told_before, (out, told)


def without(node: Tree, *keys: str) -> Tree:
    return {key: value for key, value in node.items() if key not in keys}


def _assert_rest_is_drawn(asset: Asset, out: Path, touched: set[int], less: int, key: str) -> None:
    assert isinstance(asset.document, GltfDocument)
    before, after = drawn(asset.path), drawn(out)
    assert sum(d.faces for d in after) == sum(d.faces for d in before) - less, key
    assert len(unmatched(before, after)) <= len(touched), key
    then, now = tree_of(asset.path.read_bytes()), tree_of(out.read_bytes())
    hulls = {element.node: element.names for element in asset.document.authored}
    for index, (node, same) in enumerate(zip(then["nodes"], now["nodes"], strict=False)):
        if index not in touched:
            assert without(same, "children", "name") == without(node, "children", "name"), key
            assert same.get("name") in (node.get("name"), *hulls.get(index, ())), key  # a second `Cube` stays `Cube@2`
    for kind in ("materials", "textures", "images", "samplers", "animations", "cameras", "extras", "extensionsUsed"):
        assert now.get(kind) == then.get(kind), (key, kind)
