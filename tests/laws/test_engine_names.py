"""Laws of files that are named for an engine: they hold the hulls of the asset, and the engine finds each of them."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st

from meshforge.formats import EngineName, SaveResult, read, save
from meshforge.geometry import Pose
from meshforge.symbolic import Asset, Surface, unique_names
from tests.asset_bounds import bounds_of
from tests.conversion_samples import foreign
from tests.engine_rules import godot_word, looks_like_collision_to_fbx, unreal_target
from tests.examples import examples
from tests.gltf_files import tree_of
from tests.shape_strategies import KINDS, generators, rotation, shape

MADE: list[tuple[EngineName, str]] = [("unreal", ".glb"), ("godot", ".gltf"), ("unity", ".glb")]
FITTED = 0.005  # share of its size by which the smallest capsule about an inscribed mesh differs from the capsule
WORDS = [
    *("leg", "Leg", "leg_1", "leg_1_2", "leg1", "_01", "UCX_leg", "ucx_leg_00", "top UCP", "a/b", "a_b", "a.b:c@d"),
    *("door-col", "front_wheel", "$rigid", "x-convcolonly", "arm_colliders", "noimp", "body", "Ä ö", " ", "%"),
]


@st.composite
def assets(draw: st.DrawFn) -> Asset:
    """One to four bodies, of which some show something, with one to six hulls of all kinds."""
    rng = draw(generators())
    bodies = draw(st.lists(st.sampled_from(WORDS), min_size=1, max_size=4, unique=True))
    owners = draw(st.lists(st.sampled_from(bodies), min_size=1, max_size=6))
    own = [draw(st.sampled_from(WORDS)) for _ in owners]
    names = unique_names(f"{body}/{name}" for body, name in zip(owners, own, strict=True))
    geoms = [(n, b, shape(draw(st.sampled_from(KINDS)), rng)) for n, b in zip(names, owners, strict=True)]
    poses = {body: Pose(rotation(rng), rng.normal(size=3)) for body in bodies}
    seen = [(body, shape("polytope", rng)) for body in bodies if draw(st.booleans())]
    visuals = tuple(Surface(hull.vertices, hull.faces, body, (1.0, 0.5, 0.0, 1.0)) for body, hull in seen)
    return replace(foreign(poses, geoms), visuals=visuals)


@contextmanager
def named(asset: Asset, names: EngineName, suffix: str) -> Iterator[SaveResult]:
    with TemporaryDirectory() as folder:
        yield save(asset, Path(folder) / f"thing_01{suffix}", names=names)


@pytest.mark.parametrize(("names", "suffix"), MADE)
@examples(20)
@given(asset=assets())
def test_hulls_read_back_in_place_each_under_the_name_it_has(names: EngineName, suffix: str, asset: Asset) -> None:
    with named(asset, names, suffix) as saved:
        after = {geom.name: geom.shape for geom in read(saved.path).geoms}
        again = saved.path.read_bytes()
        assert save(read(saved.path), saved.path.with_name(f"again{suffix}"), names=names).path.read_bytes() == again
    assert len(after) == len(asset.geoms)
    bounds = bounds_of(asset)
    for geom in asset.geoms:
        now = after.pop(saved.names.get(geom.name, geom.name))
        was = geom.shape if now.kind == geom.shape.kind else geom.shape.tessellate()
        near = FITTED if now.kind == "capsule" else 1e-6
        slack = 1e-6 * (1 + bounds.diagonal) + near * geom.shape.aabb.diagonal
        np.testing.assert_allclose(now.aabb.min, was.aabb.min, atol=slack, err_msg=geom.name)
        np.testing.assert_allclose(now.aabb.max, was.aabb.max, atol=slack, err_msg=geom.name)
        assert now.volume == pytest.approx(was.volume, rel=max(1e-3, 3 * near)), (geom, now)


@examples(20)
@given(asset=assets())
def test_unreal_finds_each_hull_and_the_mesh_of_its_body_for_it(asset: Asset) -> None:
    with named(asset, "unreal", ".glb") as saved:
        scene = trimesh.load_scene(saved.path, split_objects=True)
    hulls = {saved.names[geom.name]: geom for geom in asset.geoms}
    seen = {name for name in scene.graph.nodes_geometry if name not in hulls}
    assert set(scene.graph.nodes_geometry) == {*hulls, *seen}
    assert not any(looks_like_collision_to_fbx(name) for name in seen)
    targets = {geom.body: unreal_target(name, seen) for name, geom in hulls.items()}
    assert None not in targets.values() and len(set(targets.values())) == len(targets)
    assert all(unreal_target(name, seen) == targets[geom.body] for name, geom in hulls.items())
    kinds = {"box": "UBX", "sphere": "USP", "capsule": "UCP"}
    assert {name: name[:3] for name in hulls} == {n: kinds.get(g.shape.kind, "UCX") for n, g in hulls.items()}


@examples(20)
@given(asset=assets())
def test_godot_makes_a_convex_body_of_each_hull_and_nothing_else_of_anything(asset: Asset) -> None:
    with named(asset, "godot", ".glb") as saved:
        nodes = tree_of(saved.path.read_bytes())["nodes"]
    hulls = {saved.names[geom.name] for geom in asset.geoms}
    assert not any(set(node["name"]) & set('.:@/"%') or not node["name"].strip() for node in nodes)
    assert {name: godot_word(name) for name in hulls} == dict.fromkeys(hulls, "convcolonly")
    assert [node["name"] for node in nodes if node["name"] not in hulls and godot_word(node["name"])] == []


@examples(20)
@given(asset=assets())
def test_a_script_in_unity_finds_the_hulls_of_each_body_below_one_node(asset: Asset) -> None:
    with named(asset, "unity", ".glb") as saved:
        nodes = tree_of(saved.path.read_bytes())["nodes"]
    names = [node["name"] for node in nodes]
    assert len(set(names)) == len(names) and not any("/" in name for name in names)
    assert not any({"scale", "matrix"} & node.keys() for node in nodes)
    found = [{names[k] for k in node["children"]} for node in nodes if node["name"].endswith("_colliders")]
    wanted: dict[str, set[str]] = {}
    for geom in asset.geoms:
        wanted.setdefault(geom.body, set()).add(saved.names.get(geom.name, geom.name))
    assert sorted(map(sorted, found)) == sorted(map(sorted, wanted.values()))
