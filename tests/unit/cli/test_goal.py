"""`meshforge goal`: goals tried on a family and kept with the project."""

import json
from pathlib import Path

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


def test_nothing_is_tried_twice_until_something_changes(
    run: Run, project: Project, monkeypatch: pytest.MonkeyPatch
) -> None:
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
