"""`meshforge goal`: goals tried on a family and kept with the project."""

import json
from pathlib import Path
from typing import Any

import pytest

from meshforge import batch
from meshforge.checks.goals.base import Goal, GoalResult, GoalSubject, try_goal
from meshforge.project import Project
from tests.unit.cli.in_process import Run
from tests.unit.project.tables import learned

CARRIES = "supports(Is(top))"


@pytest.fixture
def project(run: Run, tmp_path: Path) -> Project:
    return learned(tmp_path)


def test_a_goal_is_tried_before_and_after_the_program_and_kept_under_a_name(run: Run, project: Project) -> None:
    said = run("goal", "tables", CARRIES)
    assert (said.code, said.out) == (0, f"{CARRIES}: 3 of 3 assets, 3 before\n")
    assert run("goal", "tables", CARRIES, "--add", "top").out == f"top: {CARRIES}: 3 of 3 assets, 3 before\n"
    assert '[goals]\ntop = "supports(Is(top))"' in (project.folder / "meshforge.toml").read_text()
    assert run("goal", "tables").out == run("goal", "tables", "top").out == f"top: {CARRIES}: 3 of 3 assets, 3 before\n"
    assert run("goal", "tables", "--remove", "top").code == 0
    assert run("goal", "tables").err.startswith("error: tables: the project has no goals\n")
    assert run("goal", "tables", "--remove", "top").code == 2


def test_what_fails_is_named_with_a_picture_and_exits_with_1(run: Run, project: Project, tmp_path: Path) -> None:
    said = run("goal", "tables", "graspable(Is(top), width = 1 mm)", "--pictures", "shown")
    assert said.code == 1
    assert "0 of 3 assets, 0 before" in said.out and "failed on table0/model.obj, as before: part 1: it is" in said.out
    assert len(list(Path("shown").rglob("*.png"))) == 3
    found = json.loads(run("goal", "tables", "graspable(Is(top), width = 1 mm)", "--json").out)
    rows = [row for one in found for row in one["goals"]]
    assert [row["now"] for row in rows] == ["failed"] * 3 and Path(rows[0]["picture"]).exists()


def test_what_is_untried_is_no_failure_unless_everywhere_or_asked_for(run: Run, project: Project) -> None:
    project.set_labels("table0/model.obj", {"top": "misc"})
    said = run("goal", "tables", CARRIES)
    assert said.code == 0 and "2 of 2 assets, 2 before, 1 not tried" in said.out
    assert "not tried on 1 asset: Is(top) selects nothing here" in said.out
    assert run("goal", "tables", CARRIES, "--strict").code == 1
    assert run("goal", "tables", "swings(Is(top))").code == 1


def test_nothing_is_tried_twice_without_a_change(run: Run, project: Project, monkeypatch: pytest.MonkeyPatch) -> None:
    first = run("goal", "tables", CARRIES, "--workers", "1").out
    tried = list[str]()

    def note(goal: Goal, subject: GoalSubject) -> GoalResult:
        tried.append(str(goal))
        return try_goal(goal, subject)

    def outcomes(again: bool = False) -> set[str]:
        found = project.try_goals({"top": CARRIES}, again=again, execution=batch.IN_PROCESS)
        return {one.after["top"].outcome for one in found}

    monkeypatch.setattr("meshforge.batch.goals.try_goal", note)
    assert outcomes() == {"passed"} and not tried
    project.set_labels("table0/model.obj", {"top": "top", "crumb": None})
    assert outcomes() == {"passed"} and tried == [CARRIES] * 2  # before and after, of one asset
    list(project.apply(execution=batch.IN_PROCESS))
    assert outcomes() == {"passed"} and tried == [CARRIES] * 2  # what is written is what was edited in memory
    assert outcomes(again=True) == {"passed"} and tried == [CARRIES] * 8
    assert run("goal", "tables", CARRIES).out == first


@pytest.mark.parametrize(
    ("words", "wanted"),
    [
        (("grasp(Is(top))",), "goal:1:1: unknown goal `grasp`"),
        (("supports(Is(topp))",), "goal:1:13: unknown label 'topp'"),
        (("--add", "top"), "--add needs a goal"),
        (("stands", "--remove", "top"), "--remove goes alone"),
        (("--remove", "top"), "there is no goal 'top'"),
        (("supports(Is(topp))", "--add", "top"), "top:1:13: unknown label 'topp'"),
    ],
)
def test_what_cannot_be_is_said_in_one_message(run: Run, project: Project, words: tuple[str, ...], wanted: str) -> None:
    said = run("goal", "tables", *words)
    assert said.code == 2 and wanted in said.err and not said.out
    assert "[goals]" not in (project.folder / "meshforge.toml").read_text()


def test_a_goal_that_was_broken_by_hand_is_named_with_its_place(run: Run, project: Project) -> None:
    settings = project.folder / "meshforge.toml"
    settings.write_text(settings.read_text() + '\n[goals]\ntop = "supports(Is(top)"\n')
    said = run("goal", "tables")
    assert said.code == 2 and "[goals] top:1:17: expected" in said.err


def test_apply_tries_the_goals_of_a_project_and_exits_with_1_where_one_fails(run: Run, project: Project) -> None:
    project.set_goal("top", CARRIES)
    done = run("apply", "tables", "--accept-outliers")
    assert done.code == 0 and f"top: {CARRIES}: 3 of 3 assets, 3 before" in done.out
    project.set_goal("grip", "graspable(Is(top), width = 1 mm)")
    done = run("apply", "tables", "--accept-outliers", "--json")
    lines = [json.loads(line) for line in done.out.splitlines()]
    assert done.code == 1
    assert [[row["now"] for row in line["goals"]] for line in lines] == [["passed", "failed"]] * 3
    assert run("apply", "tables", "--dry-run", "--accept-outliers").code == 0
    run("label", "tables", "--rename", "top=plate")
    assert project.settings.goals["top"] == "supports(Is(plate))"


THICK = "graspable(Is(top), width = 0.001)"


@pytest.fixture
def signed_off(run: Run, project: Project) -> Project:
    assert run("review", "tables").code == run("apply", "tables").code == 0
    assert run("status", "tables", "--signed-off").code == 0
    project.set_goal("grip", THICK)
    return project


def answer(run: Run, project: Project, **reply: object) -> None:
    (Path("replies.json")).write_text(json.dumps([{"id": ask(run)["id"], **reply}]))
    run("review", "tables", "--answers", "replies.json")


def ask(run: Run) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(run("review", "tables", "--json").out)["question"]
    return found


def standing(run: Run) -> dict[str, tuple[str, str | None]]:
    rows = json.loads(run("status", "tables", "--json").out)["assets"]
    return {row["asset"][:6]: (row["sign_off"], row["signed_by"]) for row in rows}


def test_a_goal_that_fails_takes_sign_offs_back_until_a_person_answers(run: Run, signed_off: Project) -> None:
    said = run("status", "tables", "--signed-off")
    assert said.code == 1 and "goal grip was not tried (meshforge apply): table0/model.obj, table1" in said.out
    assert "Next: Try the goals, which were not tried on 3 assets" in said.out
    said = run("apply", "tables", "--report", "report.html")
    page = Path("report.html").read_text()
    assert page.count("<figcaption>goal grip fails: part 1") == page.count("data:image/png") == 3
    assert said.code == 1 and "table2/model.obj is no longer signed off: goal grip fails: part 1: it is" in said.err
    by_person, held = ("signed off", "person"), ("needs review", None)
    assert standing(run) == {"table0": by_person, "table1": by_person, "table2": held}
    assert run("status", "tables", "--signed-off").code == 1
    for left in (2, 1, 0):
        question = ask(run)
        assert question["goals"] == [THICK] and len(question["pictures"]) == 2
        assert all(Path(picture).exists() for picture in question["pictures"])
        answer(run, signed_off, choice="right")
        failing = json.loads(run("review", "tables", "--json").out)["goals"]
        assert len(failing) == left
    assert standing(run) == dict.fromkeys(("table0", "table1", "table2"), by_person)
    assert run("status", "tables", "--signed-off").code == run("apply", "tables").code == 0
    run("label", "tables", "--rename", "top=plate")
    run("apply", "tables")
    assert run("status", "tables", "--signed-off").code == 0  # what was accepted follows the name
    signed_off.set_goal("grip", "graspable(Is(plate), width = 0.002)")  # which nobody has accepted
    assert run("apply", "tables").code == run("status", "tables", "--signed-off").code == 1


@pytest.mark.parametrize(
    ("reply", "left", "state"),
    [
        ({"choice": "wrong"}, 2, "needs review"),
        ({"choice": "not-solved"}, 2, "excluded"),
        ({"choice": "not-of-family"}, 2, None),
        ({"later": True}, 3, "signed off"),
    ],
)
def test_a_reply_to_a_goal_that_fails_is_done(
    run: Run, signed_off: Project, reply: dict[str, object], left: int, state: str | None
) -> None:
    run("apply", "tables")
    asset = ask(run)["asset"]
    answer(run, signed_off, **reply)
    found = run("review", "tables", "--json")
    assert found.code == 1 and len(json.loads(found.out)["goals"]) == left
    assert standing(run).get(asset[:6], (None,))[0] == state


def test_a_reply_is_about_all_goals_that_fail_so_that_none_is_asked_about_again(run: Run, signed_off: Project) -> None:
    run("apply", "tables")
    asset = ask(run)["asset"]
    answer(run, signed_off, choice="right")
    signed_off.set_goal("pinch", "graspable(Is(top), width = 0.002)")
    run("apply", "tables")
    while (question := ask(run))["asset"] != asset:
        answer(run, signed_off, choice="right")
    assert question["goals"] == [THICK, "graspable(Is(top), width = 0.002)"] and THICK not in question["text"]
    answer(run, signed_off, choice="right")
    rows = json.loads(run("status", "tables", "--json").out)["assets"]
    (row,) = [row for row in rows if row["asset"] == asset]
    assert [goal["accepted"] for goal in row["goals"]] == [True, True]


def test_goals_that_hold_leave_sign_offs_as_they_are(run: Run, signed_off: Project) -> None:
    before = standing(run)
    signed_off.set_goal("grip", CARRIES)
    assert run("apply", "tables").code == run("status", "tables", "--signed-off").code == 0
    assert standing(run) == before


def test_a_demonstrated_asset_that_fails_a_goal_is_named_before_learning(run: Run, signed_off: Project) -> None:
    said = run("synthesize", "tables")
    assert said.code == 0 and "table0/model.obj as it was demonstrated fails goal grip: part 1" in said.err
    signed_off.set_goal("grip", CARRIES)
    assert "fails goal" not in run("synthesize", "tables").err
