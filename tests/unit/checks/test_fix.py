import json
from pathlib import Path

import pytest

from meshforge.checks import check, fix
from meshforge.engines import find_engine
from meshforge.geometry import Aabb, Box, Pose, Shape, polygon_sizes
from meshforge.symbolic import Hull, Label, SymbolicMesh
from tests.mesh_files import obj
from tests.soups import ball
from tests.unit.cli.in_process import Run


def mesh(*shapes: Shape) -> SymbolicMesh:
    return SymbolicMesh(
        tuple(Hull(f"h{k}", f"b{k}", shape, Label("knob", 1.0, "user")) for k, shape in enumerate(shapes))
    )


@pytest.mark.slow
def test_a_hull_of_too_many_vertices_is_replaced_by_one_that_the_engine_takes() -> None:
    before = mesh(ball(300, 0.1), Box.of_bounds(Aabb([1, 0, 0], [2, 1, 1])))
    fixed = fix(before, find_engine("physx-gpu"))
    (change,) = fixed.changes
    assert (change.hull, change.rules) == ("h0", ("vertices", "polygons"))
    made = fixed.mesh.hull_of("h0")
    assert (made.parent, made.label, made.body) == ("h0", "knob", "b0")
    assert change.vertices == (300, len(made.vertices)) and len(made.vertices) <= 64
    assert len(polygon_sizes(made.shape.tessellate())) <= 64
    assert fixed.mesh.hulls[1] is before.hulls[1]
    assert check(fixed.mesh, "physx-gpu") == ()
    assert not fixed.left


@pytest.mark.slow
def test_what_would_stick_out_too_far_is_left_and_told() -> None:
    before = mesh(ball(300, 0.1))
    fixed = fix(before, find_engine("physx-gpu"), tolerance=0.001)
    assert fixed.mesh is before and not fixed.changes
    assert fixed.left[0].startswith("h0: left as it is, since a hull within the limits would stick out by 0.0")


def test_what_would_come_to_overlap_another_body_is_left() -> None:
    beside = Box.of_bounds(Aabb([0.0995, -1, -1], [1, 1, 1]))
    around = ball(300, 0.1).move(Pose.of_translation([-0.0005, 0, 0]))
    fixed = fix(mesh(around, beside), find_engine("unreal"), tolerance=0.1)
    assert fixed.left == ("h0: left as it is, since it would come to overlap h1 of body b1",)


def test_a_hull_that_is_too_thin_is_thickened_to_both_sides() -> None:
    plate = Box.of_bounds(Aabb([0, 0, 0], [1, 1, 0.0004])).tessellate()
    fixed = fix(mesh(plate), find_engine("physx-gpu"))
    made = fixed.mesh.hulls[0].aabb
    assert made.size[2] == pytest.approx(0.001, rel=1e-5)
    assert made.center[2] == pytest.approx(0.0002)
    assert fixed.changes[0].error == pytest.approx(0.0003, rel=1e-5)
    assert [f.rule for f in check(fixed.mesh, "physx-gpu")] == ["physx-gpu-oblong"]  # of that nothing safe is known


def test_a_number_of_vertices_is_kept_to_however_far_a_hull_sticks_out() -> None:
    before = mesh(ball(100, 0.1), ball(20, 0.1))
    fixed = fix(before, None, max_vertices=24)
    (change,) = fixed.changes
    assert change.hull == "h0" and change.vertices[0] == 100 and change.vertices[1] <= 24
    assert change.error > 0.01 * before.diagonal and len(fixed.mesh.hulls[0].vertices) == change.vertices[1]
    assert fixed.mesh.hulls[1] is before.hulls[1]
    strict = fix(before, None, tolerance=0.0001, max_vertices=24)
    assert strict.mesh is before and "would stick out by" in strict.left[0]


def test_of_two_limits_of_vertices_the_smaller_counts() -> None:
    fixed = fix(mesh(ball(100, 0.1)), find_engine("physx-gpu"), max_vertices=24)
    assert len(fixed.mesh.hulls[0].vertices) <= 24 and len(polygon_sizes(fixed.mesh.hulls[0].shape.tessellate())) <= 64


def test_a_mesh_within_the_limits_stays_the_same_object() -> None:
    before = mesh(ball(20, 0.1))
    assert fix(before, find_engine("physx-gpu")).mesh is before


@pytest.fixture
def run(run: Run) -> Run:
    hull = ball(300, 0.1)
    Path("in").mkdir()
    Path("in/ball.obj").write_text("o ball\n" + obj((hull.vertices, hull.faces)).decode())
    return run


@pytest.mark.slow
def test_the_command_line_writes_mended_files_and_leaves_the_input(run: Run) -> None:
    source = Path("in/ball.obj").read_bytes()
    words = ("check", "in", "--engine", "physx-gpu", "--fix", "--out", "out", "--tolerance", "0.02", "--json")
    told = run(*words)
    assert told.code == 0
    line = json.loads(told.out)
    assert line["fixed"]["changes"][0]["vertices"]["before"] == 300
    assert line["findings"] == []
    written = Path("out/ball.obj").read_bytes()
    assert Path("in/ball.obj").read_bytes() == source != written
    assert run("check", "out", "--engine", "physx-gpu").code == 0
    assert run(*words).code == 0 and Path("out/ball.obj").read_bytes() == written  # once more: the same
    assert [path.name for path in Path("out").iterdir()] == ["ball.obj"]


@pytest.mark.parametrize(
    ("words", "problem"),
    [
        (("--fix",), "--fix needs --engine, --max-vertices or --exclude, and --out"),
        (("--fix", "--out", "out"), "--fix needs --engine, --max-vertices or --exclude, and --out"),
        (("--engine", "unreal", "--out", "out"), "--out says nothing without --fix"),
        (("--engine", "unreal", "--tolerance", "1"), "--tolerance says nothing without --fix"),
    ],
)
def test_options_that_do_not_go_together_are_refused(run: Run, words: tuple[str, ...], problem: str) -> None:
    told = run("check", "in", *words)
    assert told.code == 2 and problem in told.err


def test_the_folder_of_the_assets_is_no_output(run: Run) -> None:
    before = Path("in/ball.obj").read_bytes()
    told = run("check", "in", "--engine", "unreal", "--fix", "--out", "in")
    assert told.code == 1 and "the output folder is the folder of the assets" in told.out
    assert Path("in/ball.obj").read_bytes() == before
