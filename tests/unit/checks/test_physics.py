import itertools
import re

import numpy as np
import pytest

from meshforge.batch.report.contents import ReportAsset, sum_speeds
from meshforge.checks import CheckOptions, Speed, examine_mesh
from meshforge.checks.physics import speed
from meshforge.checks.physics.mechanism import check_masses
from meshforge.checks.physics.simulation import simulate
from meshforge.geometry import Capsule, Cylinder, Ellipsoid, Polytope, Pose, Shape, Sphere, convex_hull, inertia
from meshforge.symbolic import Hull, Inertial, Joint, SymbolicMesh
from tests.cups import BOTTOM, WALLS, WHOLE, cup
from tests.unit.language.scenes import box


def solid(mass: float, *shapes: Shape, body: str = "cup") -> Inertial:
    centre, moments = inertia(shapes, mass)
    return Inertial(body, mass, centre, moments)


def test_a_cup_rests() -> None:
    found = simulate(cup(BOTTOM, *WALLS, inertials=[solid(0.2, BOTTOM, *WALLS)]))
    assert found.rest is not None and found.findings == ()
    assert found.rest.jitter < 1e-4 and found.rest.tilt < 0.1 and found.rest.sunk < 1e-3


def test_what_hangs_in_the_air_is_put_on_the_plane() -> None:
    high = [shape.move(Pose.of_translation([3, 2, 5])) for shape in (BOTTOM, *WALLS)]
    found = simulate(cup(*high, shown=()))
    assert found.rest is not None and found.rest.moved < 1e-3 and found.findings == ()


@pytest.mark.parametrize(
    "shape",
    [
        box([0, 0, 0], [1, 1, 1]),
        Cylinder(Pose.identity(), 0.5, 0.2),
        convex_hull(np.random.default_rng(0).normal(size=(30, 3))),
        Sphere(Pose.identity(), 0.3),
        Capsule(Pose.identity(), 0.2, 0.3),
        Ellipsoid(Pose.identity(), np.array([0.3, 0.3, 0.2])),
    ],
)
def test_every_kind_of_shape_weighs_what_it_should_and_is_simulated(shape: Shape) -> None:
    from meshforge.checks.physics.mechanism import JointTree
    from meshforge.checks.physics.model import DENSITY, compile_model

    mesh = cup(shape, shown=())
    model = compile_model(mesh, JointTree.of(mesh))
    assert model.body_mass[1] == pytest.approx(DENSITY * shape.volume, rel=1e-4)
    assert simulate(mesh).rest is not None


def test_a_tall_needle_on_its_tip_falls_over() -> None:
    needle = convex_hull(np.array([[0, 0, 0], [0.1, 0.02, 1], [-0.05, 0.1, 1], [-0.05, -0.1, 1]], dtype=float))
    found = simulate(cup(needle, shown=()))
    assert found.rest is not None and found.rest.tilt > 60
    assert "physics-tilt" in [f.rule for f in found.findings]


def test_what_leans_a_little_is_doubtful() -> None:
    tray, foot = box([0, 0, 0.1], [1, 1, 0.2]), box([0, 0, 0], [0.2, 1, 0.1])
    found = simulate(cup(tray, foot, shown=()))
    assert found.rest is not None and 5 < found.rest.tilt < 15
    assert [(one.rule, one.severity) for one in found.findings] == [("physics-tilt", "warning")]


def test_bodies_that_start_within_each_other_are_told_and_thrown() -> None:
    first, second = box([0, 0, 0], [1, 1, 1]), box([0.6, 0, 0], [1.6, 1, 1])
    found = simulate(cup(first, second, bodies=["one", "two"], shown=()))
    (overlap,) = found.overlaps
    assert overlap.bodies == ("one", "two") and not overlap.joined
    assert overlap.depth == pytest.approx(0.4, rel=0.05)
    assert "physics-overlap" in [f.rule for f in found.findings]


def drawer(kind: str) -> Joint:
    return Joint("j", kind, "one", "two", np.zeros(3), np.array([1.0, 0, 0]), (0.0, 0.5))  # type: ignore[arg-type]


def test_bodies_that_a_joint_holds_are_told_as_joined_and_those_welded_not_at_all() -> None:
    shapes = box([0, 0, 0], [1, 1, 1]), box([0.6, 0, 0], [1.6, 1, 1])
    joined = simulate(cup(*shapes, bodies=["one", "two"], joints=[drawer("prismatic")], shown=()))
    assert [overlap.joined for overlap in joined.overlaps] == [True]
    welded = simulate(cup(*shapes, bodies=["one", "two"], joints=[drawer("fixed")], shown=()))
    assert welded.overlaps == () and welded.findings == ()


def test_a_loop_of_joints_is_cut_not_followed_for_ever() -> None:
    loop = [drawer("revolute"), Joint("k", "revolute", "two", "one", np.zeros(3), np.array([0, 0, 1.0]))]
    shapes = box([0, 0, 0], [1, 1, 1]), box([0, 0, 1], [1, 1, 2])
    assert simulate(cup(*shapes, bodies=["one", "two"], joints=loop, shown=())).rest is not None


@pytest.mark.parametrize(
    ("inertial", "rules"),
    [
        (solid(0.5, WHOLE), []),
        (solid(0.0, WHOLE), ["physics-mass"]),
        (solid(-1.0, WHOLE), ["physics-mass"]),
        (solid(float("nan"), WHOLE), ["physics-mass"]),
        (Inertial("cup", 1.0, np.full(3, 0.05), np.diag([1.0, 1.0, 3.0]) * 1e-3), ["physics-mass"]),
        (Inertial("cup", 1.0, np.full(3, 0.05), np.diag([0.0, 1.0, 1.0]) * 1e-3), ["physics-mass"]),
        (solid(1e-6, WHOLE), ["physics-density"]),
        (solid(100.0, WHOLE), ["physics-density"]),
        (Inertial("cup", 0.5, np.array([0.05, 0.05, 0.5]), inertia([WHOLE], 0.5)[1]), ["physics-centre"]),
        (Inertial("cup", 0.5, np.full(3, 0.05), np.eye(3)), ["physics-inertia"]),
    ],
)
def test_odd_masses_are_told(inertial: Inertial, rules: list[str]) -> None:
    assert [f.rule for f in check_masses(cup(WHOLE, inertials=[inertial]))] == rules


def test_a_mass_that_cannot_be_does_not_stop_the_simulation() -> None:
    found = simulate(cup(WHOLE, inertials=[solid(0.0, WHOLE)]))
    assert found.rest is not None and [f.severity for f in found.findings] == ["error"]


def test_hulls_that_are_none_are_left_out() -> None:
    flat = Polytope(WHOLE.vertices * [1, 1, 0], WHOLE.faces)
    mesh = SymbolicMesh((Hull("a", "body", WHOLE), Hull("b", "body", flat)))
    assert simulate(mesh).rest is not None
    assert simulate(SymbolicMesh((Hull("b", "body", flat),))).refused == "there is no hull"


def test_a_hull_that_mujoco_refuses_is_an_error_with_its_message() -> None:
    tiny = box([0, 0, 0], [1e-6, 1e-6, 1e-6]).tessellate()
    found = simulate(cup(tiny, shown=()))
    assert found.rest is None and [f.rule for f in found.findings] == ["physics-refused"]
    assert found.refused and found.refused.startswith("MuJoCo refuses it: ")


def test_the_same_mesh_gives_the_same_figures() -> None:
    mesh = cup(BOTTOM, *WALLS)
    assert simulate(mesh).to_json() == simulate(mesh).to_json()


@pytest.mark.slow
def test_very_many_bodies_in_a_chain_are_refused_or_simulated_never_more() -> None:
    def chain(count: int) -> SymbolicMesh:
        shapes = [box([2 * k, 0, 0], [2 * k + 1, 1, 1]) for k in range(count)]
        names = [f"b{k}" for k in range(count)]
        joints = [Joint("", "revolute", a, b, np.zeros(3), np.array([0, 0, 1.0])) for a, b in itertools.pairwise(names)]
        return cup(*shapes, bodies=names, joints=joints, shown=())

    assert simulate(chain(60)).rest is not None
    assert simulate(chain(600)).refused == "more than 500 bodies"


def test_the_worth_of_an_edit_is_contacts_and_rest_in_json_and_steps_of_this_machine_in_words() -> None:
    feet = [box([x, y, 0], [x + 0.1, y + 0.1, 1]) for x, y in itertools.product((0, 0.9), repeat=2)]
    before, needle = cup(*feet, box([0, 0, 1], [1, 1, 1.1]), shown=()), cup(feet[0], shown=())
    found, again = (examine_mesh(needle, CheckOptions(("speed",)), before) for _ in range(2))
    assert found.to_json() == again.to_json()
    assert found.to_json()["speed"] == {"now": {"contacts": 4, "rest": 0.0}, "before": {"contacts": 16, "rest": 0.0}}
    assert re.search(
        r"steps of MuJoCo a second, measured on this machine: [\d,]+ → [\d,]+ \(\d+\.\d times\); "
        r"contacts: 16 → 4; at rest after: 0 s → 0 s$",
        found.descriptions[0],
    )
    figures = sum_speeds(ReportAsset(name, before, needle, checked=found) for name in "ab")
    assert figures["contacts at the end"] == ("32 → 8", "−75 %")
    assert str(figures["one step of all in MuJoCo"][1]).endswith("times as fast, measured on this machine")


def test_what_falls_comes_to_rest_later_and_what_cannot_be_simulated_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    wanted = CheckOptions(("speed",))
    lying = convex_hull(np.array([[0, 0, 0], [0.1, 0.02, 1], [-0.05, 0.1, 1], [-0.05, -0.1, 1]], dtype=float))
    found = examine_mesh(cup(lying, shown=()), wanted).get("speed", Speed)
    assert found and found.before is None and found.now.rest is not None and 0.3 < found.now.rest < 6
    monkeypatch.setattr(speed, "HULLS", 0)
    many = examine_mesh(cup(lying, shown=()), wanted)
    assert many.unmeasured["speed"].startswith("speed was not measured: it has no hull, or more than 0 hulls")
    monkeypatch.setattr("meshforge.common.plugins.find_spec", lambda name: None)
    assert "needs MuJoCo, which is not installed" in examine_mesh(cup(lying, shown=()), wanted).unmeasured["speed"]
