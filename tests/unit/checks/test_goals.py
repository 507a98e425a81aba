"""Goals: their texts, and what comes of them on scenes of boxes, whatever the size of these and the way they lie."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.checks.goals.base import Goal, GoalSubject, try_goal
from meshforge.checks.goals.registry import GOALS, parse_goal
from meshforge.checks.physics.scene import Failure
from meshforge.common import ProgramError
from meshforge.geometry import Aabb, Box, Pose, rotation_about
from meshforge.language import OptionArgument, Program, Share, parse_extractor
from meshforge.symbolic import Hull, Label, SymbolicMesh

TABLE = tomllib.loads(Path(__file__).with_name("goals.toml").read_text("utf-8"))
LABELS = ("top", "drawer", "handle", "door", "hinge", "frame")
UPRIGHT = "+Z: Is(leg) -> Is(top)"
Corners = Sequence[Sequence[float]]


@pytest.mark.parametrize("row", TABLE["text"], ids=lambda row: row["goal"])
def test_a_goal_is_read_and_printed_or_says_what_is_wrong_with_it(row: Mapping[str, str]) -> None:
    if "error" in row:
        with pytest.raises(ProgramError) as error:
            parse_goal(row["goal"], "goal", LABELS)
        assert row["error"] in error.value.message
        return
    found = parse_goal(row["goal"], "goal", LABELS)
    assert str(found) == row["printed"]
    assert parse_goal(str(found), "goal", LABELS) == found


EXTRACTORS = st.sampled_from(["All", "Is(top)", 'Is("no word")', "Geo(Is(top), +Z)", "Attach(All, Is(drawer))"]).map(
    parse_extractor
)
VALUES: Mapping[str, st.SearchStrategy[Any]] = {
    "_extractor": EXTRACTORS | st.builds(lambda a, b: a | b, EXTRACTORS, EXTRACTORS),
    "QUANTITY": st.floats(1e-6, 1e6),
    "DIRECTION": st.sampled_from(["+X", "-X", "+Y", "-Y", "+Z", "-Z"]),
}


@given(kind=st.sampled_from(sorted(GOALS.built_in)), data=st.data())
def test_every_goal_reads_back_from_its_text(kind: str, data: st.DataObject) -> None:
    values = dict[str, Any]()
    for name, argument in GOALS[kind].arguments().items():
        inner = argument.value if isinstance(argument, OptionArgument) else argument
        choice = VALUES[inner.symbol] if inner.symbol in VALUES else st.sampled_from(inner.choices)
        if inner.fits(Share(0.5)):
            choice |= st.integers(1, 300).map(lambda percent: Share(percent / 100))
        values[name] = data.draw(choice)
    made = GOALS[kind](**values)
    assert parse_goal(str(made)) == made


@dataclass(frozen=True)
class Scene:
    before: SymbolicMesh
    after: SymbolicMesh

    @staticmethod
    def of(row: Mapping[str, Any], scale: float, turn: float) -> Scene:
        before = list(hulls_of(row["hulls"], scale, turn))
        after = [hull for hull in before if hull.name not in row.get("gone", ())]
        after += hulls_of(row.get("new", {}), scale, turn)
        return Scene(SymbolicMesh(tuple(before)), SymbolicMesh(tuple(after)))


def hulls_of(rows: Mapping[str, Corners], scale: float, turn: float) -> Iterator[Hull]:
    pose = Pose(rotation_about(np.array([0.0, 0.0, 1.0]), turn), np.zeros(3))
    for name, (low, high) in rows.items():
        box = Box.of_bounds(Aabb(scale * np.array(low), scale * np.array(high)))
        yield Hull(name, "body", box.tessellate().move(pose), Label(name.split()[0], 1.0, "user"))


@pytest.mark.parametrize(("scale", "turn"), [(1.0, 0.0), (0.3, 0.0), (1.0, 0.5), (3.0, 2.0)])
@pytest.mark.parametrize(
    ("name", "goal"), [(name, goal) for name, scene in TABLE["scene"].items() for goal in scene["goals"]]
)
def test_what_comes_of_a_goal_on_a_scene(name: str, goal: str, scale: float, turn: float) -> None:
    has_length = any(word in goal for word in (" mm", " cm", "1 m"))
    if (has_length and scale != 1.0) or ("axis" in goal and turn) or (", +" in goal and turn):
        pytest.skip("it is about lengths, or directions")
    scene = Scene.of(TABLE["scene"][name], scale, turn)
    found = try_goal(parse_goal(goal), GoalSubject.of(scene.before, scene.after, Program()))
    wanted = TABLE["scene"][name]["goals"][goal]
    assert f"{found.outcome}: {found.why}".removesuffix(": ").startswith(wanted), found
    assert str(found.outcome) in ("passed", "untried") or found.why
    assert set(found.hulls) <= set(scene.before.index) | set(scene.after.index)


def test_a_goal_sees_the_asset_as_its_program_turns_it() -> None:
    scene = Scene.of(TABLE["scene"]["table"], 1.0, 0.0)
    tilt = Pose(rotation_about(np.array([1.0, 0.0, 0.0]), 0.4), np.zeros(3))
    leaning = scene.before.with_hulls(hull.move(tilt) for hull in scene.before.hulls)
    for program, wanted in ((Program(), "failed"), (Program.parse(f"orient {UPRIGHT}\n"), "passed")):
        subject = GoalSubject.of(leaning, leaning, program)
        assert try_goal(parse_goal("stands"), subject).outcome == wanted


def test_level_faces_correct_what_landmarks_say_is_up() -> None:
    legs = {"leg 8": [[-0.36, -0.2, 0.0], [-0.28, 0.2, 0.7]], "leg 9": [[0.32, -0.2, 0.0], [0.4, 0.2, 0.7]]}
    mesh = Scene.of(TABLE["scene"]["table_with_a_vase"] | {"new": legs}, 1.0, 0.0).after
    subject = GoalSubject.of(mesh, mesh, Program.parse(f"orient {UPRIGHT}\n"))
    leaning = replace(subject, by_landmarks=False)
    assert [try_goal(parse_goal("stands"), one).outcome for one in (leaning, subject)] == ["failed", "passed"]
    found = try_goal(parse_goal("supports(Is(top))"), subject)
    vase = next(hull for hull in subject.hulls if hull.name in found.hulls)
    assert found.objects[0].aabb.intersects(vase.aabb)


@pytest.mark.parametrize("scale", [0.001, 1000.0])
def test_an_asset_in_millimetres_is_said_and_nothing_is_tried(scale: float) -> None:
    scene = Scene.of(TABLE["scene"]["table"], scale, 0.0)
    found = try_goal(parse_goal("stands"), GoalSubject.of(scene.before, scene.after, Program()))
    assert found.outcome == "untried" and "m large" in found.why


def test_an_asset_without_hulls_or_without_labels_is_said() -> None:
    nothing = SymbolicMesh(())
    assert try_goal(parse_goal("stands"), GoalSubject.of(nothing, nothing, Program())).why == "it has no hulls"
    bare = Scene.of(TABLE["scene"]["table"], 1.0, 0.0).before
    bare = bare.with_labels(dict.fromkeys(bare.index))
    found = try_goal(parse_goal("supports(Is(top))"), GoalSubject.of(bare, bare, Program()))
    assert (found.outcome, found.why) == ("untried", "it has no labels, and Is(top) asks for some")


@dataclass(frozen=True, slots=True)
class Strange(Goal):
    """Fails in its own way."""

    def find_failure(self, subject: GoalSubject) -> Failure | None:
        raise ZeroDivisionError("nothing by nothing")


def test_a_goal_that_raises_is_broken_and_says_why() -> None:
    mesh = Scene.of(TABLE["scene"]["table"], 1.0, 0.0).before
    found = try_goal(Strange(), GoalSubject.of(mesh, mesh, Program()))
    assert (found.goal, found.outcome) == ("strange", "broken") and "nothing by nothing" in found.why
