from pathlib import Path

import numpy as np
import pytest

from meshforge.checks import check
from meshforge.common import UsageError
from meshforge.engines import ENGINES
from meshforge.geometry import Aabb, Box, Cylinder, Polytope, Pose, Shape, convex_hull, polygon_sizes
from meshforge.symbolic import Asset, Body, Document, Geom, SymbolicMesh
from tests.soups import ball
from tests.unit.checks.test_legality import mesh


def prism(sides: int) -> Polytope:
    turn = np.arange(sides) * 2 * np.pi / sides
    ring = np.column_stack([np.cos(turn), np.sin(turn), np.zeros(sides)])
    return convex_hull(np.concatenate([ring, ring + np.array([0, 0, 1])]))


def rules(engine: str, *shapes: Shape) -> list[tuple[str, str]]:
    return [(f.rule, f.severity) for f in check(mesh(*shapes), engine)]


def test_the_engines_are_those_of_the_command_line() -> None:
    assert tuple(ENGINES) == ("mujoco", "physx-cpu", "physx-gpu", "unreal", "unity", "bullet", "godot")


@pytest.mark.parametrize("engine", ENGINES)
def test_a_box_is_within_the_limits_of_every_engine(engine: str) -> None:
    assert rules(engine, Box.of_bounds(Aabb([0, 0, 0], [1, 1, 1])).tessellate()) == []


@pytest.mark.parametrize("engine", ENGINES)
def test_a_native_primitive_is_within_the_limits_however_it_is_tessellated(engine: str) -> None:
    limits = [rule for rule, _ in rules(engine, Cylinder(Pose.identity(), 1.0, 0.001))]
    assert limits in ([], [f"{engine}-primitives"])


@pytest.mark.parametrize(
    ("engine", "shape", "expected"),
    [
        ("mujoco", prism(19), []),
        ("mujoco", prism(20), [("mujoco-face-vertices", "warning")]),
        ("physx-cpu", ball(129), []),
        ("physx-cpu", ball(130), [("physx-cpu-polygons", "error")]),
        ("physx-cpu", prism(127), []),
        ("physx-cpu", prism(128), [("physx-cpu-vertices", "error")]),
        ("physx-gpu", ball(30), []),
        ("physx-gpu", prism(31), []),
        ("physx-gpu", prism(32), [("physx-gpu-face-vertices", "error")]),
        ("physx-gpu", prism(33), [("physx-gpu-vertices", "error"), ("physx-gpu-face-vertices", "error")]),
        ("physx-gpu", ball(40), [("physx-gpu-polygons", "error")]),
        ("unreal", ball(32), []),
        ("unreal", ball(33), [("unreal-vertices", "warning")]),
        ("unity", prism(127), []),
        ("unity", prism(128), [("unity-vertices", "error")]),
        ("bullet", ball(100), []),
        ("bullet", ball(101), [("bullet-vertices", "warning")]),
        ("godot", ball(256), []),
        ("godot", ball(257), [("godot-vertices", "error")]),
        ("physx-gpu", Box.of_bounds(Aabb([0, 0, 0], [99, 1, 1])).tessellate(), []),
        ("physx-gpu", Box.of_bounds(Aabb([0, 0, 0], [101, 1, 1])).tessellate(), [("physx-gpu-oblong", "warning")]),
    ],
)
def test_limits_hold_to_the_last_vertex(engine: str, shape: Shape, expected: list[tuple[str, str]]) -> None:
    assert rules(engine, shape) == expected


def test_the_message_says_how_many_and_how_many_are_allowed() -> None:
    (finding,) = check(mesh(ball(40), ball(8), prism(18)), "unreal")
    assert finding.message == "h0 (40), h2 (36): more than 32 vertices; more than Unreal's own tool gives to a hull"
    assert finding.hulls == ("h0", "h2")


def test_a_body_of_many_hulls_is_told() -> None:
    boxes = [Box.of_bounds(Aabb([2 * k, 0, 0], [2 * k + 1, 1, 1])) for k in range(65)]
    assert rules("physx-gpu", *boxes) == [("physx-gpu-hulls", "warning")]
    assert rules("physx-gpu", *boxes[:64]) == []


def in_file(form: str, count: int) -> SymbolicMesh:
    geoms = tuple(Geom(f"h{k}", "b", Box.of_bounds(Aabb([2 * k, 0, 0], [2 * k + 1, 1, 1]))) for k in range(count))
    return SymbolicMesh.of(Asset(Path(f"x.{form}"), form, (Body("b", Pose.identity()),), geoms, Document()))


@pytest.mark.parametrize(
    ("engine", "severities"),
    [("mujoco", ["error"]), ("unity", ["warning"]), ("physx-gpu", ["warning"]), ("bullet", [])],
)
def test_several_hulls_in_one_mesh_file_are_one_hull_for_engines(engine: str, severities: list[str]) -> None:
    found = check(in_file("obj", 2), engine)
    assert [(f.rule, f.severity) for f in found] == [(f"{engine}-one-hull-a-file", one) for one in severities]
    assert check(in_file("obj", 1), engine) == check(in_file("urdf", 2), engine) == ()


def test_a_hull_that_is_none_is_not_measured() -> None:
    flat = Polytope(prism(30).vertices * [1, 1, 0], prism(30).faces)
    assert rules("mujoco", flat) == [("flat", "error")]


def test_an_unknown_engine_is_refused_with_the_nearest() -> None:
    with pytest.raises(UsageError, match=r"no engine 'physx-gpus'\n.*'physx-gpu'"):
        check(mesh(), "physx-gpus")


def test_the_polygons_of_a_box_are_six_squares() -> None:
    assert polygon_sizes(Box.of_bounds(Aabb([0, 0, 0], [1, 1, 1])).tessellate()) == (4,) * 6


def test_the_polygons_of_a_prism_are_its_caps_and_sides() -> None:
    assert sorted(polygon_sizes(prism(7))) == [4] * 7 + [7] * 2
