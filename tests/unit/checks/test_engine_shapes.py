"""The shapes that engines make are those that are read here, or an error says which are not, and why."""

from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.engines import EngineShape, ShapeComparison
from meshforge.formats import load
from meshforge.geometry import Box, Pose, convex_hull
from meshforge.symbolic import SymbolicMesh
from tests.cups import BOTTOM, WALLS, cup
from tests.mesh_files import dae
from tests.mjcf_engines import model, put
from tests.shape_strategies import KINDS, shape
from tests.unit.batch.preparation.samples import write_boxes
from tests.unit.cli.in_process import Run
from tests.urdf_sample import boxes_obj

MESH = '<collision name="row"><geometry><mesh filename="{}" scale="2 1 1"/></geometry></collision>'
BALL = '<collision name="ball"><origin xyz="0 0 3"/><geometry><sphere radius=".5"/></geometry></collision>'
SDF = """<sdf version="1.7"><model name="m"><link name="a"><inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy>
<izz>1</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial><collision name="row"><geometry><mesh>
<uri>row.obj</uri></mesh></geometry></collision></link></model></sdf>"""


def compare(mesh: SymbolicMesh, found: list[EngineShape], engine: str = "mujoco") -> list[tuple[str, tuple[str, ...]]]:
    assert mesh.asset
    findings = ShapeComparison(engine, "an engine", mesh.asset, found, "").findings
    return [(f"{one.severity} {one.rule}", one.hulls) for one in findings]


@given(st.sampled_from(KINDS), st.integers(0, 2**32 - 1), st.sampled_from(["same", "moved", "scaled", "gone", "more"]))
def test_a_shape_that_is_as_it_was_read_is_no_finding_and_any_other_is_one(kind: str, seed: int, change: str) -> None:
    rng = np.random.default_rng(seed)
    shapes = [shape(kind, rng).move(Pose.of_translation([3 * k, 0, 0])) for k in range(3)]
    mesh, one = cup(*shapes, shown=()), shapes[1]
    width = float(np.linalg.norm(one.aabb.size))
    if change == "moved":
        one = one.move(Pose.of_translation([0, 0, 0.05 * width]))
    elif change == "scaled":
        one = convex_hull(one.centroid + 1.1 * (one.vertices - one.centroid))
    made = [EngineShape.of(made) for made in (shapes[2], one, shapes[0])]
    made = made[:1] + made[2:] if change == "gone" else [*made, made[0]] if change == "more" else made
    wanted = {"same": [], "more": [("error mujoco-differs", ())]}.get(change, [("error mujoco-differs", ("h1",))])
    assert compare(mesh, made) == wanted


def test_hulls_that_an_engine_makes_one_of_are_named_and_no_others() -> None:
    mesh, joined = cup(BOTTOM, *WALLS), np.concatenate([wall.vertices for wall in WALLS])
    assert compare(mesh, [EngineShape.of(BOTTOM), EngineShape.of(joined)]) == [
        ("error mujoco-joins", ("h1", "h2", "h3", "h4"))
    ]


@pytest.mark.parametrize("engine", ["mujoco", "bullet"])
@pytest.mark.parametrize("suffix", ["obj", "stl"])
def test_a_mesh_of_several_hulls_is_an_error_until_each_has_its_file(
    engine: str, suffix: str, run: Run, tmp_path: Path
) -> None:
    pytest.importorskip("pybullet" if engine == "bullet" else "mujoco")
    write_boxes(tmp_path / "row.obj")
    if suffix == "stl":
        assert run("convert", "row.obj", "row.stl").code == 0
    put(tmp_path, {"row.urdf": f'<robot name="r"><link name="a">{MESH.format(f"row.{suffix}")}{BALL}</link></robot>'})
    told = run("check", "row.urdf", "--engine", engine)
    assert told.code == 1 and "error MF204: " in told.out and "makes one hull of all of a collision mesh" in told.out
    assert "a/row (3 pieces here)" in told.out and "--one-file-a-hull" in told.out
    assert run("convert", "row.urdf", "out/row.urdf", "--one-file-a-hull").code == 0
    fixed = run("check", "row.urdf", "--engine", engine, "--fix", "--out", "fixed")
    assert fixed.code == 0 and "fixed: a/row: each of its hulls is in a file of its own" in fixed.out
    before = load("row.urdf")
    for path in ("out/row.urdf", "fixed/row.urdf"):
        after = load(path)
        assert [(h.name, h.body, h.shape.kind) for h in after] == [(h.name, h.body, h.shape.kind) for h in before]
        for one, other in zip(before, after, strict=True):
            np.testing.assert_allclose(one.aabb.corners, other.aabb.corners, atol=1e-6)
        checked = run("check", path, "--engine", engine)
        assert checked.code == 0 and ": legal (" in checked.out
    assert mujoco.MjModel.from_xml_path("out/row.urdf").ngeom == 4


def test_the_meshes_of_an_sdf_come_apart_too_and_other_formats_refuse_to(run: Run, tmp_path: Path) -> None:
    pytest.importorskip("pybullet")
    write_boxes(tmp_path / "row.obj")
    put(tmp_path, {"row.sdf": SDF})
    assert "a/row (3 pieces here)" in run("check", "row.sdf", "--engine", "bullet").out
    assert run("convert", "row.sdf", "out/row.sdf", "--one-file-a-hull").code == 0
    assert [hull.name for hull in load("out/row.sdf")] == [hull.name for hull in load("row.sdf")]
    assert "makes one hull" not in run("check", "out/row.sdf", "--engine", "bullet").out
    refused = run("convert", "row.sdf", "out/row.xml", "--one-file-a-hull")
    assert refused.code == 2 and "--one-file-a-hull is for URDF and SDF, not MJCF" in refused.err
    assert run("convert", "row.sdf", "many", "--to", "urdf", "--one-file-a-hull").code == 0


def test_pybullet_makes_one_hull_of_an_stl(run: Run, tmp_path: Path) -> None:
    pytest.importorskip("pybullet")
    write_boxes(tmp_path / "row.obj")
    assert run("convert", "row.obj", "row.stl").code == 0
    told = run("check", "row.stl", "--engine", "bullet")
    assert told.code == 1 and "(3 pieces here)" in told.out and "meshforge convert FILE OUT.urdf" in told.out


@pytest.mark.parametrize(("boxes", "code", "rule"), [(1, 0, "MF223"), (3, 1, "MF204")])
def test_pybullet_makes_one_hull_of_a_collada_file(boxes: int, code: int, rule: str, run: Run, tmp_path: Path) -> None:
    pytest.importorskip("pybullet")
    solids = [Box(Pose.of_translation([3 * k, 0, 0]), np.ones(3)).tessellate() for k in range(boxes)]
    corners = np.concatenate([one.vertices for one in solids])
    faces = np.concatenate([one.faces + 8 * k for k, one in enumerate(solids)])
    (tmp_path / "row.dae").write_bytes(dae((corners, faces)))
    put(tmp_path, {"row.urdf": f'<robot name="r"><link name="a">{MESH.format("row.dae")}{BALL}</link></robot>'})
    told = run("check", "row.urdf", "--engine", "bullet")
    assert told.code == code and rule in told.out


@pytest.mark.parametrize("objects", [1, 3])
def test_pybullet_makes_a_hull_of_each_object_of_an_obj(objects: int, run: Run, tmp_path: Path) -> None:
    pytest.importorskip("pybullet")
    boxes = [((k, 0, 0), (k + 0.5, 1, 1)) for k in range(0, 6, 2)]
    text, lines = boxes_obj(*boxes), ""
    for k, line in enumerate(line for line in text.splitlines() if line.startswith("f ")):
        lines += f"o part{k}\n" * (objects == 3 and k % 12 == 0) + line + "\n"
    vertices = "".join(f"{line}\n" for line in text.splitlines() if line.startswith("v "))
    (tmp_path / "row.obj").write_text(vertices + lines)
    told = run("check", "row.obj", "--engine", "bullet")
    assert told.code == (objects == 1) and ("(3 pieces here)" in told.out) is (objects == 1)


def test_a_mesh_that_mujoco_takes_from_another_folder_is_an_error(run: Run, tmp_path: Path) -> None:
    (tmp_path / "parts").mkdir()
    for name, x in (("row.obj", 1), ("parts/row.obj", 6)):
        (tmp_path / name).write_text(boxes_obj(((0, 0, 0), (x, 1, 1))))
    links = f'<link name="a">{MESH.format("row.obj")}{BALL}</link>'
    put(tmp_path, {"cup.urdf": f'<robot name="r"><mujoco><compiler meshdir="parts"/></mujoco>{links}</robot>'})
    told = run("check", "cup.urdf", "--engine", "mujoco")
    assert told.code == 1
    assert "does not make the same shape as is read here: a/row (the nearest shape there differs by 10 m)" in told.out


@pytest.mark.parametrize(("margin", "code"), [("0.002", 0), ("0.004", 1)])
def test_a_margin_that_closes_a_gap_is_an_error(margin: str, code: int, run: Run, tmp_path: Path) -> None:
    box = f'<geom name="{{}}" type="box" size=".1 .1 .1" pos="{{}} 0 0" margin="{margin}"/>'
    put(tmp_path, {"cup.xml": model(f'<body name="b">{box.format("l", 0)}{box.format("r", 0.205)}</body>')})
    told = run("check", "cup.xml", "--engine", "mujoco")
    assert told.code == code and ("closes gaps by the margins of hulls: b/l and b/r (5 mm)" in told.out) is bool(code)


def test_the_margin_of_bullet_counts_where_a_link_has_several_meshes_too(run: Run, tmp_path: Path) -> None:
    pytest.importorskip("pybullet")
    for name, low in (("low", 0.0), ("high", 0.1015), ("far", 0.3)):
        (tmp_path / f"{name}.obj").write_text(boxes_obj(((0, 0, low), (0.1, 0.1, low + 0.1))))
    mesh = '<collision><geometry><mesh filename="{}.obj"/></geometry></collision>'
    joint = '<joint name="j" type="prismatic"><parent link="a"/><child link="b"/><limit lower="0" upper="1"/></joint>'
    links = f'<link name="a">{mesh.format("low")}</link><link name="b">{mesh.format("high")}{mesh.format("far")}</link>'
    put(tmp_path, {"row.urdf": f'<robot name="r">{links}{joint}</robot>'})
    told = run("check", "row.urdf", "--engine", "bullet")
    assert "closes gaps by the margins of hulls: a/geom0 and b/geom0 (1.5 mm)" in told.out


def test_a_margin_that_bullet_has_by_itself_matters_between_bodies_only() -> None:
    pair = [convex_hull(BOTTOM.vertices + np.array([0, 0, z])) for z in (0, 0.0115)]
    made = [replace(EngineShape.of(one), margin=0.001) for one in pair]
    assert compare(cup(*pair), made, "bullet") == []
    assert compare(cup(*pair, bodies=["one", "two"]), made, "bullet") == [("warning bullet-margin", ("h0", "h1"))]
