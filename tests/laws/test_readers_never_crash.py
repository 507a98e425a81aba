"""Whatever happened to a file, its reader gives an asset of finite hulls, or one error of the family."""

import json
import random
import tempfile
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from meshforge.common import MeshForgeError
from meshforge.formats import read
from meshforge.symbolic import SymbolicMesh, read_labels
from tests.corpus_case import ROOT
from tests.damage import damaged
from tests.examples import examples

WHOLE = {
    "obj": ("obj/cube.obj", "obj/groups_of_one_name.obj", "obj/corner_with_slashes.obj", "obj/index_negative.obj"),
    "stl": ("stl/ascii_cube.stl", "stl/binary_cube.stl", "stl/ascii_two_solids.stl"),
    "ply": ("ply/ascii_cube.ply", "ply/little_endian_cube.ply", "ply/big_endian_cube.ply", "ply/elements_unknown.ply"),
    "wrl": ("wrl/cube.wrl", "wrl/clockwise.wrl", "wrl/route.wrl"),
    "gltf": ("gltf/cube.gltf", "gltf/physics_box.gltf", "gltf/sparse_of_zeros.gltf", "gltf/unreal_names.gltf"),
    "glb": ("glb/cube.glb",),
    "urdf": ("urdf/mesh_beside.urdf", "urdf/two_roots.urdf", "urdf/joint_without_limits.urdf", "urdf/box.urdf"),
    "usda": ("usd/cube.usda", "usd/reference_beside.usda", "usd/mesh_index_beyond.usda"),
    "usdc": ("usd/cube.usdc", "usd/cube.usdz", "usd/made_by_hand.usdc"),
    "sdf": ("sdf/nested.sdf", "sdf/world.sdf", "sdf/geometry_mesh_submesh.sdf", "sdf/two_models.sdf"),
    "mjcf": ("mjcf/mesh_good.xml", "mjcf/box.xml", "mjcf/default_type.xml", "mjcf/include_good.xml"),
}
DAE = ("dae/parts/cube.dae", "dae/parts/mirrored.dae")


@pytest.mark.parametrize("kind", WHOLE)
@examples(60)
@given(seed=st.integers(0, 2**32))
@example(seed=256)  # a corner 100,000 times as far as the others
def test_a_damaged_asset_is_read_or_refused(kind: str, seed: int) -> None:
    rng = random.Random(seed)
    whole = ROOT / rng.choice(WHOLE[kind])
    with tempfile.TemporaryDirectory() as folder:
        if (whole.parent / "parts").is_dir():
            Path(folder, "parts").symlink_to(whole.parent / "parts")
        told_or_read(written(Path(folder, whole.name), damaged(whole.read_bytes(), rng)))


@examples(60)
@given(seed=st.integers(0, 2**32))
@example(seed=256)  # likewise
def test_a_description_of_a_damaged_mesh_is_read_or_refused(seed: int) -> None:
    rng = random.Random(seed)
    whole = ROOT / rng.choice((*DAE, *(name for kind in ("obj", "stl", "ply", "wrl", "glb") for name in WHOLE[kind])))
    with tempfile.TemporaryDirectory() as folder:
        mesh = written(Path(folder, whole.name), damaged(whole.read_bytes(), rng))
        link = f'<link name="a"><collision><geometry><mesh filename="{mesh.name}"/></geometry></collision></link>'
        told_or_read(written(Path(folder, "a.urdf"), f'<robot name="r">{link}</robot>'.encode()))


@examples(100)
@given(seed=st.integers(0, 2**32))
def test_damaged_labels_are_read_or_refused(seed: int) -> None:
    rng = random.Random(seed)
    with tempfile.TemporaryDirectory() as folder:
        path = written(Path(folder, "a.json"), damaged((ROOT / "labels/good.json").read_bytes(), rng))
        try:
            found = read_labels(path)
        except MeshForgeError as error:
            assert str(path) in error.message
        else:
            json.dumps({name: label.name for name, label in found.labels.items()}).encode("utf-8")


def written(path: Path, data: bytes) -> Path:
    path.write_bytes(data)
    return path


def told_or_read(path: Path) -> bool:
    """Whether a file is read as the program does; an error must name a file, an asset must be sound."""
    try:
        asset = read(path)
    except MeshForgeError as error:
        assert str(path.parent) in error.message
        return False
    mesh = SymbolicMesh.of(asset)
    names = [geom.name for geom in asset.geoms] + [piece.name for piece in asset.non_convex]
    assert len(set(names)) == len(names)
    for hull in mesh.hulls:
        assert np.isfinite(hull.vertices).all() and hull.volume > 0
    assert all(piece.reason for piece in asset.non_convex)
    assert len(mesh.contacts) >= 0  # the graph can be made
    return True
