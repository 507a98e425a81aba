"""Laws of editing glTF: whatever the scene and the edit, the hulls are those asked for, and all else is as it was."""

import tempfile
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from hypothesis import assume, given
from hypothesis import strategies as st

from meshforge.formats import MarkName, read, save
from meshforge.formats.gltf.document import GltfDocument
from meshforge.formats.meshfile.gltf_scene import GltfScene
from meshforge.geometry import Box, Capsule, Pose, Shape, Sphere, convex_hull, is_same_shape
from meshforge.symbolic import Asset, Geom
from tests.examples import examples
from tests.gltf_files import KHR, SceneFile, Tree, buffer_of, tree_of
from tests.soups import angle, box, together

NAMES: dict[str, list[str | None]] = {
    "plain": [None, "leg", "leg", "top 1", "é/#0"],
    "unreal": ["UCX_leg_01", "UCX_leg", "ubx_top_3", "leg", None],
    "godot": ["leg-col", "leg-colonly", "top_convcol.001", "top-convcolonly", "leg"],
    "khr": [None, "leg", "leg", "top"],
}
BESIDE: list[MarkName] = ["khr", "unreal", "godot", "unity"]
NUMBERS = st.sampled_from([-2.0, -1.0, 0.5, 1.0, 3.0])
TURNS = st.sampled_from([[0, 0, 0, 1], [0.5, 0.5, 0.5, 0.5], [0, 0.6, 0, 0.8]])


@st.composite
def scenes(draw: st.DrawFn, conventions: Sequence[str] = tuple(sorted(NAMES))) -> SceneFile:
    """A scene of a convention: nodes in a random forest, with shared meshes of one to three pieces."""
    convention = draw(st.sampled_from(conventions))
    scene = SceneFile()
    scene.tree |= {"extras": {"n": 1.25}, "materials": [{"name": "wood"}, {"doubleSided": True}]}
    parts = [box(), together(box(), box((3, 0, 0))), together(box(), angle(), box((0, 5, 0))), angle()]
    for soup in draw(st.lists(st.sampled_from(parts), min_size=1, max_size=3)):
        scene.mesh(scene.primitive(soup, material=draw(st.integers(0, 1))))
    count = draw(st.integers(1, 6))
    parents = [draw(st.integers(-1, k - 1)) for k in range(count)]
    if convention == "khr":
        scene.uses(KHR)
        scene.collider("always", {"type": "box", "box": {"size": [1, 2, 3]}})
    first = len(scene.tree.get("nodes", []))
    for _ in range(count):
        node = _node(draw, scene, convention)
        name = draw(st.sampled_from(NAMES[convention]))
        scene.node(name, None, **node)
    for k, parent in enumerate(parents):
        if parent >= 0:
            scene.tree["nodes"][first + parent].setdefault("children", []).append(first + k)
    return scene


def _node(draw: st.DrawFn, scene: SceneFile, convention: str) -> Tree:
    node: Tree = {"extras": {"k": draw(st.integers(0, 9))}} if draw(st.booleans()) else {}
    if draw(st.integers(0, 4)):
        node["mesh"] = draw(st.integers(0, len(scene.tree["meshes"]) - 1))
    if draw(st.booleans()):
        node |= {"translation": [draw(NUMBERS) for _ in range(3)], "rotation": draw(TURNS)}
    if draw(st.booleans()):
        node["scale"] = [draw(NUMBERS) for _ in range(3)]
    if convention == "khr" and draw(st.booleans()):
        mesh = draw(st.integers(0, len(scene.tree["meshes"]) - 1))
        collider = {"geometry": {"mesh": mesh, "convexHull": draw(st.booleans())}, "extras": {"keep": True}}
        node["extensions"] = {KHR: {"collider": collider}}
        if draw(st.booleans()):
            node["extensions"][KHR]["motion"] = {}
    return node


def shapes() -> st.SearchStrategy[Shape]:
    turned = Pose.from_rpy([1, 2, 3], [0.3, 0.2, 0.1])
    return st.sampled_from(
        [Box(turned, np.array([1.0, 2, 3])), Sphere(turned, 2.0), Capsule(turned, 1.0, 2.0), convex_hull(angle()[0])]
    )


def edited(draw: st.DataObject, asset: Asset) -> Asset:
    """Some hulls gone, some of them with others in their stead."""
    geoms = []
    for geom in asset.geoms:
        match draw.draw(st.sampled_from(["keep", "keep", "delete", "replace"])):
            case "keep":
                geoms.append(geom)
            case "replace":
                geoms.append(Geom(f"{geom.name}~1", geom.body, draw.draw(shapes()), geom.name))
    return asset.with_geoms(geoms)


@examples(60)
@given(scenes(("plain",)), st.sampled_from([".glb", ".gltf"]), st.sampled_from([None, *BESIDE]), st.data())
def test_hulls_beside_an_unmarked_scene_read_back_and_the_scene_is_as_it_was(
    scene: SceneFile, suffix: str, names: MarkName | None, draw: st.DataObject
) -> None:
    with tempfile.TemporaryDirectory() as folder:
        source = scene.write(Path(folder) / f"a{suffix}")
        assume(any("mesh" in node for node in scene.tree["nodes"]))
        before = read(source)
        wanted = edited(draw, before)
        assume(wanted.geoms)
        saved = save(wanted, Path(folder) / "out" / source.name, names=names, collision="beside")
        after = read(saved.path)
        assert len(after.geoms) == len(wanted.geoms)
        if names is None:
            _assert_has(after, wanted, saved.names, baked=True)
        assert [len(surface.faces) for surface in after.visuals] == _triangles(before)
        then, now = tree_of(source.read_bytes()), tree_of(saved.path.read_bytes())
        for key in ("bufferViews", "accessors", "materials", "meshes", "nodes"):
            assert now[key][: len(then[key])] == then[key]
        if suffix == ".glb":
            assert buffer_of(saved.path).startswith(buffer_of(source))
        again = save(after, Path(folder) / "again" / source.name, collision="beside")
        assert again.path.read_bytes() == saved.path.read_bytes()


def _triangles(asset: Asset) -> list[int]:
    """How many triangles each node shows, in the order of the scene."""
    assert isinstance(asset.document, GltfDocument)
    scene = GltfScene.of(asset.document.source, asset.path)
    return [len(scene.mesh(p.node["mesh"]).faces) for p in scene.placements.values() if "mesh" in p.node]


@examples(80)
@given(scenes(), st.sampled_from([".glb", ".gltf"]), st.data())
def test_an_edit_changes_what_it_says_and_nothing_else(scene: SceneFile, suffix: str, draw: st.DataObject) -> None:
    with tempfile.TemporaryDirectory() as folder:
        source = scene.write(Path(folder) / f"a{suffix}")
        assume(any("mesh" in n or "extensions" in n for n in scene.tree["nodes"]))
        before = read(source)
        save(before, Path(folder) / "same" / source.name)
        assert (Path(folder) / "same" / source.name).read_bytes() == source.read_bytes()
        wanted = edited(draw, before)
        assume(wanted.geoms or wanted.non_convex)
        saved = save(wanted, Path(folder) / "out" / source.name, collision="replace")
        after = read(saved.path)
        _assert_has(after, wanted, saved.names)
        assert _seen(after) == _seen(before)  # collision goes, what is seen stays
        _assert_rest_is_same(before, wanted, tree_of(source.read_bytes()), tree_of(saved.path.read_bytes()))
        if suffix == ".glb":
            assert buffer_of(saved.path).startswith(buffer_of(source))


def _seen(asset: Asset) -> list[tuple[str, int, list[list[float]]]]:
    return sorted((s.body or "", len(s.faces), np.round(s.vertices, 9).tolist()) for s in asset.visuals)


def _assert_has(after: Asset, wanted: Asset, names: object, *, baked: bool = False) -> None:
    """All hulls are there under their names, or those that are told, on their bodies.

    baked: whether those that stay may have been written anew, in single precision.
    """
    assert isinstance(names, dict)
    back = {geom.name: geom for geom in after.geoms}
    assert len(back) == len(wanted.geoms)
    for geom in wanted.geoms:
        now = back[names.get(geom.name, geom.name)]
        assert now.body == geom.body
        if geom.parent is None and not baked:
            assert is_same_shape(now.shape, geom.shape, 1e-9)
        else:
            size = geom.shape.aabb.diagonal
            np.testing.assert_allclose(now.shape.aabb.min, geom.shape.aabb.min, atol=0.02 * size)
            np.testing.assert_allclose(now.shape.centroid, geom.shape.centroid, atol=0.02 * size)
    assert sorted(o.reason for o in after.non_convex) == sorted(o.reason for o in wanted.non_convex)


def _assert_rest_is_same(before: Asset, wanted: Asset, then: Tree, now: Tree) -> None:
    """Nodes, meshes, views and all else that no edit concerns are there, under the numbers that they had."""
    kept = {geom.name for geom in wanted.geoms} | {piece.name for piece in wanted.non_convex}
    assert isinstance(before.document, GltfDocument)
    touched = {e.node for e in before.document.authored if not set(e.names) <= kept}
    for k, node in enumerate(then["nodes"]):
        free = {"children", "name"} | ({"mesh", "extensions"} if k in touched else set())
        assert {a: b for a, b in now["nodes"][k].items() if a not in free} == {
            a: b for a, b in node.items() if a not in free
        }
        assert set(node.get("children", [])) - touched <= set(now["nodes"][k].get("children", []))
    for key in ("bufferViews", "accessors", "materials", "asset", "extras"):
        assert now.get(key, [])[: len(then[key])] == then[key] if isinstance(then[key], list) else now[key] == then[key]
    for mesh, same in zip(then["meshes"], now["meshes"], strict=False):
        assert [p["attributes"] for p in same["primitives"]] == [p["attributes"] for p in mesh["primitives"]]
