"""Laws of kinematic trees: from URDF to MJCF and back, hulls, joints and masses are what they were."""

import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from meshforge.formats import read, save
from meshforge.geometry import Pose
from meshforge.symbolic import Asset, Body, Document, Geom, Inertial, Joint, JointKind, Mechanism
from tests.examples import examples
from tests.shape_strategies import generators, rotation, shape

KINDS: tuple[JointKind, ...] = ("fixed", "revolute", "prismatic", "revolute")
NATIVE = ("box", "sphere", "cylinder", "polytope")


@st.composite
def mechanisms(draw: st.DrawFn) -> Asset:
    """A random tree of one to seven bodies, with joints that URDF and MJCF both have, hulls and masses."""
    rng = draw(generators())
    count = int(rng.integers(1, 8))
    names = [f"b{k}" for k in range(count)]
    poses = [Pose.identity(), *(Pose(rotation(rng), rng.normal(size=3)) for _ in names[1:])]
    joints = tuple(_joint(rng, k, names, poses) for k in range(1, count))
    geoms = tuple(
        Geom(f"{name}/{kind}{n}", name, shape(kind, rng))
        for name in names
        for n, kind in enumerate(rng.choice(NATIVE, size=int(rng.integers(1, 3))))
    )
    masses = tuple(_inertial(rng, name) for name in names if rng.random() < 0.7)
    bodies = tuple(Body(name, pose) for name, pose in zip(names, poses, strict=True))
    return Asset(Path("x.foo"), "foo", bodies, geoms, Document(), mechanism=Mechanism(joints, masses))


def _joint(rng: np.random.Generator, k: int, names: list[str], poses: list[Pose]) -> Joint:
    kind = KINDS[int(rng.integers(len(KINDS)))]
    axis = rng.normal(size=3) if rng.random() < 0.7 else np.eye(3)[int(rng.integers(3))]
    low, high = sorted(rng.uniform(-3, 3, size=2))
    limits = (float(low), float(high)) if kind == "prismatic" or (kind == "revolute" and rng.random() < 0.6) else None
    anchor = poses[k].translation if rng.random() < 0.5 else rng.normal(size=3)
    damping = float(rng.choice([0.0, 0.25]))
    effort = float(rng.choice([7.0, 50.0])) if kind != "fixed" else None
    unit = axis / np.linalg.norm(axis)
    parent = names[int(rng.integers(k))]
    return Joint(
        f"j{k}", kind, parent, names[k], anchor, unit, limits, damping if kind != "fixed" else 0.0, 0.0, effort
    )


def _inertial(rng: np.random.Generator, body: str) -> Inertial:
    turn, sides = rotation(rng), rng.uniform(0.1, 1, size=3)
    moments = np.array([sides[1] + sides[2], sides[0] + sides[2], sides[0] + sides[1]])  # of points on three axes
    return Inertial(body, float(rng.uniform(0.1, 20)), rng.normal(size=3), turn @ np.diag(moments) @ turn.T)


def through(asset: Asset, *names: str) -> Asset:
    """The asset after it was written and read in some formats, one after another."""
    with tempfile.TemporaryDirectory() as folder:
        for k, name in enumerate(names):
            asset = read(save(asset, Path(folder) / str(k) / name).path)
        return asset


def assert_same_joints(before: Asset, after: Asset) -> None:
    was = {joint.name: joint for joint in before.mechanism.joints if joint.kind != "fixed"}
    now = {joint.name: joint for joint in after.mechanism.joints if joint.kind != "fixed"}
    assert now.keys() == was.keys()
    for name, joint in was.items():
        found = now[name]
        assert (found.kind, found.parent, found.child) == (joint.kind, joint.parent, joint.child)
        np.testing.assert_allclose(found.axis, joint.axis, atol=1e-9)
        away = found.anchor - joint.anchor
        if joint.kind == "revolute":  # any point of the axis will do
            np.testing.assert_allclose(away - joint.axis * (away @ joint.axis), 0, atol=1e-9)
        assert (found.limits is None) == (joint.limits is None)
        np.testing.assert_allclose(found.limits or 0, joint.limits or 0, atol=1e-12)
        assert (found.damping, found.effort) == (joint.damping, joint.effort)


def assert_same_masses(before: Asset, after: Asset) -> None:
    now = {inertial.body: inertial for inertial in after.mechanism.inertials}
    for inertial in before.mechanism.inertials:
        found = now[inertial.body]
        np.testing.assert_allclose(found.mass, inertial.mass, rtol=1e-12)
        np.testing.assert_allclose(found.centre, inertial.centre, atol=1e-9)
        np.testing.assert_allclose(found.inertia, inertial.inertia, atol=1e-9)


def assert_same_hulls(before: Asset, after: Asset) -> None:
    now = {geom.name: geom for geom in after.geoms}
    assert now.keys() == {geom.name for geom in before.geoms}
    for geom in before.geoms:
        found = now[geom.name]
        assert (found.shape.kind, found.body) == (geom.shape.kind, geom.body)
        slack = 1e-6 * (geom.shape.aabb.diagonal + float(np.abs(geom.shape.aabb.center).max()))
        np.testing.assert_allclose(found.shape.aabb.min, geom.shape.aabb.min, atol=slack)
        np.testing.assert_allclose(found.shape.aabb.max, geom.shape.aabb.max, atol=slack)


@examples(40)
@given(mechanisms())
def test_from_urdf_to_mjcf_and_back_all_is_what_it_was(asset: Asset) -> None:
    urdf = through(asset, "m.urdf")
    assert_same_joints(asset, urdf)
    assert_same_masses(asset, urdf)
    assert_same_hulls(asset, urdf)
    mjcf = through(asset, "m.xml")
    assert_same_joints(asset, mjcf)
    assert_same_hulls(asset, mjcf)
    again = through(urdf, "m.xml", "m.urdf")
    assert_same_joints(urdf, again)
    assert_same_masses(urdf, again)
    assert_same_hulls(urdf, again)
    assert {body.name for body in again.bodies} == {body.name for body in urdf.bodies}
    assert again.body_poses.keys() == urdf.body_poses.keys()


@examples(40)
@given(mechanisms())
def test_from_sdf_to_urdf_and_back_all_is_what_it_was(asset: Asset) -> None:
    sdf = through(asset, "m.sdf")
    for other in (sdf, through(sdf, "m.urdf", "m.sdf")):
        assert_same_joints(asset, other)
        assert_same_masses(asset, other)
        assert_same_hulls(asset, other)


@examples(40)
@given(mechanisms())
def test_a_turn_of_the_root_frame_and_back_leaves_a_mechanism_as_it_was(asset: Asset) -> None:
    turn = Pose.from_rpy([1, 2, 3], [0.4, -1.1, 2.0])
    moved = replace(asset, mechanism=asset.mechanism.move(turn).move(turn.inverse()))
    assert_same_joints(asset, moved)
    assert_same_masses(asset, moved)
