"""Links and joints: where everything is at zero, and which trees are none."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.geometry import Pose
from tests.examples import examples
from tests.urdf_sample import link, read, robot, sample

BALL = '<sphere radius="0.1"/>'
A, B, C = (link(BALL, name=name) for name in "abc")


def joint(parent: str, child: str, origin: str = "", kind: str = "fixed") -> str:
    ends = f'<parent link="{parent}"/><child link="{child}"/>'
    return f'<joint name="{parent}_{child}" type="{kind}">{ends}{origin}</joint>'


@pytest.mark.parametrize("kind", ["fixed", "revolute", "continuous", "prismatic", "floating", "ball"])
def test_a_joint_of_any_kind_is_taken_at_zero(kind: str, tmp_path: Path) -> None:
    text = robot(A, joint("b", "c", '<origin rpy="0 0 1.5707963267948966"/>', kind), B, C,
                 joint("a", "b", '<origin xyz="1 2 3" rpy="1.5707963267948966 0 0"/>', kind))  # fmt: skip
    asset = read(sample(tmp_path, text))
    poses = asset.body_poses
    assert list(poses) == ["a", "b", "c"]
    expected = Pose.from_rpy([1, 2, 3], [np.pi / 2, 0, 0]) @ Pose.from_rpy([0, 0, 0], [0, 0, np.pi / 2])
    np.testing.assert_allclose(poses["c"].rotation, expected.rotation, atol=1e-15)
    np.testing.assert_allclose(poses["c"].translation, [1, 2, 3])
    np.testing.assert_allclose(asset.geoms[2].shape.centroid, [1, 2, 3])


def test_the_order_of_joints_and_links_does_not_matter(tmp_path: Path) -> None:
    joints = [joint("a", "b", '<origin xyz="1 0 0"/>'), joint("b", "c", '<origin xyz="0 1 0"/>')]
    first = read(sample(tmp_path, robot(A, B, C, *joints)))
    last = read(sample(tmp_path, robot(*reversed(joints), C, B, A)))
    assert {n: p.translation.tolist() for n, p in first.body_poses.items()} == {
        n: p.translation.tolist() for n, p in last.body_poses.items()
    }
    assert last.body_poses["c"].translation.tolist() == [1, 1, 0]


def test_several_roots_are_read_with_a_note(tmp_path: Path) -> None:
    asset = read(sample(tmp_path, robot(A, B, C, joint("a", "b"))))
    assert len(asset.geoms) == 3
    assert [n for n in asset.notes if "2 links have no parent joint (a, c)" in n]


def test_a_chain_of_two_thousand_links_is_placed(tmp_path: Path) -> None:
    links = [f'<link name="l{k}"/>' for k in range(2000)]
    joints = [joint(f"l{k}", f"l{k + 1}", '<origin xyz="0 0 0.001"/>') for k in range(1999)]
    asset = read(sample(tmp_path, robot(*reversed(links), *joints)))
    np.testing.assert_allclose(asset.body_poses["l1999"].translation, [0, 0, 1.999])


ANGLES = st.floats(-4, 4) | st.sampled_from([np.pi / 2, -np.pi / 2, 1.5707963, np.pi / 2 + 1e-11, np.pi, 0.0])


@examples(200)
@given(st.tuples(ANGLES, ANGLES, ANGLES))
def test_roll_pitch_and_yaw_are_written_without_a_loss(rpy: tuple[float, float, float]) -> None:
    pose = Pose.from_rpy([0, 0, 0], rpy)
    again = Pose.from_rpy([0, 0, 0], pose.to_rpy())
    np.testing.assert_allclose(again.rotation, pose.rotation, atol=1e-11)
