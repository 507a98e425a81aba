"""Results that stand out before they are written: made in memory, they are measured as `apply` would measure them."""

from pathlib import Path
from typing import Any

import pytest

from meshforge.batch import IN_PROCESS
from meshforge.language import Action, Delete, Each, Program, Replace
from meshforge.project import Project
from meshforge.project.family_state import measure_results
from meshforge.project.review import review_project
from meshforge.project.sign_offs import find_inputs
from meshforge.signoff import THRESHOLD, EditMeasures, describe_outliers, measure_edit
from meshforge.signoff.assessment import STANDS_OUT
from meshforge.symbolic import SymbolicMesh
from tests.unit.project.microwaves import NAMES, show_microwaves
from tests.unit.project.racks import BLOCK, PLAIN, shown_racks

TURNED = "labels top, leg, rail\norient +Z: Is(leg) -> Is(top)\n\nIs(leg) => Each(Merge)\n"


@pytest.fixture
def racks(tmp_path: Path) -> Project:
    project = shown_racks(tmp_path)
    project.synthesize()
    return project


def find_all(project: Project, meshes: dict[str, SymbolicMesh] | None = None) -> dict[str, tuple[str, ...]]:
    program = project.program()
    assert program
    meshes = meshes or dict(project.meshes_by_id())
    return describe_outliers(measure_results(project, program, meshes, find_inputs(project, IN_PROCESS)))


def test_a_solid_block_stands_out_before_it_is_written_as_it_does_after(racks: Project) -> None:
    found = find_all(racks)
    assert found.keys() == {BLOCK}
    assert found[BLOCK][0] == "nearly one solid block: 100% of the free space is filled"
    list(racks.apply(execution=IN_PROCESS))
    assert find_all(racks) == found


def test_an_edit_by_hand_counts_before_it_is_written_as_it_does_after(racks: Project) -> None:
    made = racks.program().run(racks.mesh(BLOCK), {}).mesh  # type: ignore[union-attr]
    racks.correct(BLOCK, [hull.name for hull in made.hulls], Delete())
    found = find_all(racks)
    assert found[BLOCK][0] == "no hull is left"
    list(racks.apply(execution=IN_PROCESS))
    assert find_all(racks) == found


def test_an_asset_on_which_the_program_cannot_run_has_no_result(racks: Project) -> None:
    racks.accept(Program.parse(TURNED))
    assert find_all(racks).keys() == {BLOCK}
    racks.set_labels(BLOCK, {"top": "rail"})  # now it cannot be turned
    assert find_all(racks) == {}


@pytest.mark.parametrize(
    ("action", "label", "why"),
    [
        (Replace("cylinder", "native", "X"), "plate", "disc sticks out of the asset by"),
        (Each(Replace("capsule", "tight")), "handle", "and door shrinks from 0.0141 m to 0 m"),
    ],
)
def test_a_primitive_that_sticks_out_or_in_stands_out(tmp_path: Path, action: Action, label: str, why: str) -> None:
    project = show_microwaves(tmp_path, {label: action})
    found = find_all(project)
    assert [*found] == NAMES and any(why in text for text in found[NAMES[0]])
    list(project.apply(execution=IN_PROCESS))
    assert find_all(project) == found
    standing = review_project(project, execution=IN_PROCESS).assessment.assets[NAMES[4]]
    assert standing.confidence <= STANDS_OUT and [one.text for one in standing.reasons if one.kind == "alarm"]
    project.set_verdict(NAMES[2], "accepted")  # a person looked at one
    freed = review_project(project, execution=IN_PROCESS).assessment.assets[NAMES[4]]
    assert not [one for one in freed.reasons if one.kind == "alarm"]


def test_discs_that_lie_flat_and_bars_that_keep_their_gap_do_not_stand_out(tmp_path: Path) -> None:
    bars = Each(Replace("capsule", "tight", clear=True))
    project = show_microwaves(tmp_path, {"plate": Replace("cylinder", "native"), "handle": bars})
    program = project.program()
    assert program and [rule.action for rule in program.rules] == [Replace("cylinder", "native"), bars]
    assert find_all(project) == {}
    made = program.run(project.mesh(NAMES[4]), {})
    assert made.trace[1].made == () and "bar_a stays: the gap between it and bar_b would shrink" in str(
        made.trace[1].note
    )


@pytest.fixture
def measured(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """How many hulls each result has that was measured, filled as that goes on."""
    measured = list[int]()

    def count(before: SymbolicMesh, after: SymbolicMesh, **more: Any) -> EditMeasures:
        measured.append(len(after.hulls))
        return measure_edit(before, after, **more)

    monkeypatch.setattr("meshforge.project.family_state.measure_edit", count)
    return measured


def test_what_is_written_is_read_from_its_stamp_the_rest_measured_once(racks: Project, measured: list[int]) -> None:
    list(racks.apply([PLAIN[0], BLOCK], execution=IN_PROCESS))
    meshes = dict(racks.meshes_by_id())
    found = find_all(racks, meshes)
    assert len(measured) == len(meshes) - 2
    assert find_all(racks, meshes) == found and len(measured) == len(meshes) - 2


def test_what_stands_out_is_held_before_anybody_looked_at_a_result_and_the_rest_is_signed_off(racks: Project) -> None:
    found = racks.review(0.9, execution=IN_PROCESS).assessment
    assert found.need_review == (BLOCK,)
    assert found.assets[BLOCK].reasons[0].kind == "alarm"
    assert found.assets[PLAIN[2]].confidence >= THRESHOLD, "its labels are clear, and there is one reading"
    assert found.question is not None and (found.question.kind, found.question.asset) == ("result", BLOCK)


def test_a_second_review_measures_what_changed_since_the_first(racks: Project, measured: list[int]) -> None:
    before = racks.review(execution=IN_PROCESS).assessment
    assert len(measured) == 6
    assert racks.review(execution=IN_PROCESS).assessment.assets[BLOCK] == before.assets[BLOCK]
    assert len(measured) == 6
    racks.set_labels(PLAIN[4], {"rail": "rail"})
    racks.review(execution=IN_PROCESS)
    assert len(measured) == 7
