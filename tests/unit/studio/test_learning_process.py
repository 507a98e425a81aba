"""The process that learns: what it gives, that it stops when told to, and that its death is one message."""

from collections.abc import Iterator
from concurrent.futures import Future
from pathlib import Path

import pytest

from meshforge.common import MeshForgeError, ProgramError, StoppedError
from meshforge.language import Program, parse_extractor, select
from meshforge.project import Project, select_assets
from meshforge.samples import TABLES
from meshforge.studio.edits.program import TakeLearned
from meshforge.studio.learning import process
from meshforge.studio.learning.process import FamilyCache
from meshforge.studio.learning.queue import CancelFlag, LearningProcess, Superseded
from meshforge.studio.wire.program import OutcomeView
from meshforge.synthesis import Step
from tests.program_parts import parse_action
from tests.studio_project import demo_project
from tests.unit.studio.learning_calls import die, echo

BUNDLED = (TABLES / "tables.mf").read_text()
OTHER = "table_02.obj"


@pytest.fixture(scope="module")
def learner(project: Project) -> Iterator[LearningProcess]:
    made = LearningProcess(project.folder)
    yield made
    made.close()


@pytest.fixture
def own(tmp_path: Path) -> Project:
    return demo_project(tmp_path)


def learn(project: Project, flag: CancelFlag, number: int = 1) -> OutcomeView:
    """What the process does, in this one."""
    return process.learn(project.folder, flag.make_token("learn"), number)


def rules_of(text: str | None) -> list[str]:
    return [str(rule) for rule in Program.parse(text or "").rules]


def go_on() -> bool:
    return False


@pytest.mark.slow
def test_the_bundled_program_is_learned_and_kept(project: Project, learner: LearningProcess) -> None:
    outcome = learner.call("learn", process.learn, 7).result()
    assert (outcome.number, outcome.status, outcome.error) == (7, "found", None)
    assert rules_of(outcome.program) == rules_of(BUNDLED)
    assert outcome.rules[0].sentence == "The misc hulls are deleted."
    assert {rule.rule for rule in outcome.rules} == {reading.rule for reading in outcome.candidates}
    kept = project.program()
    assert kept
    assert str(kept) == outcome.program


@pytest.mark.slow
def test_reach_is_what_the_program_selects_on_every_asset(project: Project, learner: LearningProcess) -> None:
    rows = learner.call("reach", process.compute_reach, BUNDLED).result()
    assert [row.asset for row in rows] == list(project.assets())
    program = Program.parse(BUNDLED)
    templates = project.templates(program.templates)
    for row in rows:
        mesh = project.mesh(row.asset)
        run = program.run(mesh, templates)
        assert row.error is None
        for own, line in zip(row.rules, run.trace, strict=True):
            assert [mesh.hulls[k].name for k in own] == list(line.selected)


def test_reach_leads_made_hulls_back_to_what_they_were_made_of(project: Project, learner: LearningProcess) -> None:
    text = "Is(leg) => Each(Merge) as post\nIs(post) => Scale(all, 2) as post\nIs(post) => Delete\n"
    (row,) = (row for row in learner.call("reach", process.compute_reach, text).result() if row.asset == OTHER)
    legs = tuple(k for k, hull in enumerate(project.mesh(OTHER).hulls) if hull.label == "leg")
    assert row.rules == (legs, legs, legs)


def test_an_asset_on_which_the_program_fails_says_why(own: Project, flag: CancelFlag) -> None:
    own.set_labels(OTHER, {hull.name: None for hull in own.mesh(OTHER).hulls if hull.label == "leg"})
    rows = process.compute_reach(own.folder, flag.make_token("reach"), BUNDLED)
    (error,) = (row.error for row in rows if row.asset == OTHER)
    assert error and "the landmark Is(leg) selects nothing" in error


def test_an_extractor_is_generalised_as_the_rule_meets_the_assets(project: Project, learner: LearningProcess) -> None:
    found = learner.call("generalise", process.generalise, "Geo(All, +Z)", 3, BUNDLED).result().assets
    assert list(found) == list(project.assets())
    program, extractor = Program.parse(BUNDLED), parse_extractor("Geo(All, +Z)")
    before = Program(program.labels, program.orient, program.rules[:2])
    for asset, own in found.items():
        mesh, met = project.mesh(asset), project.mesh_before_rule(asset, 3, program)
        made = {n: s for line in before.run(mesh).trace for n, s in zip(line.made, line.sources, strict=True)}
        names = [name for k in select(extractor, met) for name in made.get(met.hulls[k].name, (met.hulls[k].name,))]
        assert own == tuple(sorted(mesh.index[name] for name in names))


def test_of_a_very_large_family_only_what_is_looked_at_while_learning_is_held_in_memory(
    project: Project, flag: CancelFlag, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("meshforge.project.learn.MOST_ASSETS", 4)
    rows = process.compute_reach(project.folder, flag.make_token("reach"), BUNDLED)
    found = process.generalise(project.folder, flag.make_token("generalise"), "Is(leg)", 1, None)
    assert len(project.assets()) > len(rows) >= 4
    assert [row.asset for row in rows] == list(found.assets) == list(select_assets(project))


def test_a_wrong_extractor_is_one_clear_error(learner: LearningProcess) -> None:
    with pytest.raises(ProgramError, match="expected a label"):
        learner.call("generalise", process.generalise, "Is(", 1, None).result()


@pytest.mark.slow
def test_a_changed_label_and_a_new_demonstration_are_noticed(own: Project, flag: CancelFlag) -> None:
    learn(own, flag)
    own.set_labels("table_03.obj", {"convex_00": "leg"})
    outcome = learn(own, flag, 2)
    assert (outcome.status, outcome.repairs) == ("repair", 1)
    own.set_labels("table_03.obj", {"convex_00": "panel"})
    for asset in ("table_03.obj", "table_08.obj"):
        own.demonstrate(asset, own.steps(asset)[:1])
    assert rules_of(learn(own, flag, 3).program) == rules_of(BUNDLED)[:1]


@pytest.mark.slow
def test_a_program_written_by_hand_stays_until_the_learned_one_is_taken(own: Project, flag: CancelFlag) -> None:
    own.accept(Program.parse("Is(leg) => Delete\n"))
    outcome = learn(own, flag)
    assert rules_of(outcome.program) == rules_of(BUNDLED)
    assert own.layout.program.read_text() != outcome.program
    TakeLearned().apply(own)
    learn(own, flag, 2)
    assert own.layout.program.read_text() == outcome.program


def test_a_run_that_cannot_be_has_its_message(tmp_path: Path, flag: CancelFlag) -> None:
    project = demo_project(tmp_path, demonstrated=False)
    outcome = learn(project, flag)
    assert outcome.status == "error" and "nothing is demonstrated yet" in (outcome.error or "")
    project.demonstrate(OTHER, [Step(1, {"convex_00"}, parse_action("Delete")), Step(2, set(), parse_action("Merge"))])
    assert "rule 2 selects no hull" in (learn(project, flag, 2).error or "")


@pytest.mark.slow
def test_an_interrupted_run_comes_to_its_end_and_of_many_calls_only_the_last_is_done(own: Project) -> None:
    learner = LearningProcess(own.folder)
    try:
        interrupted = learner.call("learn", process.learn, 1)
        learner.cancel("learn")
        assert interrupted.result().status == "timeout"
        outcomes = [learner.call("learn", process.learn, number) for number in range(20)]
        reaches = [learner.call("reach", process.compute_reach, BUNDLED) for _ in range(20)]
        assert outcomes[-1].result().status == "found"
        assert reaches[-1].result()
        for outcome in outcomes[1:-1]:  # one that began as an earlier one ended is cancelled while it runs
            assert isinstance(outcome.exception(), Superseded) or outcome.result().status == "timeout"
        assert outcomes[0].result().status == "timeout"
        assert all(isinstance(reach.exception(), Superseded) for reach in reaches[:-1])
    finally:
        learner.close()


@pytest.fixture
def line(tmp_path: Path) -> Iterator[LearningProcess]:
    made = LearningProcess(tmp_path)
    yield made
    made.close()


def test_the_death_of_the_process_is_one_message_and_the_next_call_has_a_new_one(line: LearningProcess) -> None:
    died: Future[int] = line.call("learn", die)
    waiting: Future[int] = line.call("reach", echo, 4)
    error = died.exception()
    assert isinstance(error, MeshForgeError) and "died" in str(error)
    assert waiting.result() == 4
    assert line.call("learn", echo, 5).result() == 5


def test_a_cancel_flag_stops_calls_of_its_kind_that_were_made_before(flag: CancelFlag) -> None:
    outcome, reach = flag.make_token("learn"), flag.make_token("reach")
    assert not outcome.stop()
    flag.cancel("learn")
    assert outcome.stop() and not reach.stop() and not flag.make_token("learn").stop()


def test_the_shelf_reads_again_only_what_changed(tmp_path: Path) -> None:
    project, shelf = demo_project(tmp_path), FamilyCache()
    before = dict(shelf.read_meshes(project, project.assets(), go_on))
    project.set_labels(OTHER, {"convex_00": "misc"})
    project.cut("table_03.obj", "convex_00", before["table_03.obj"].hulls[0].shape.centroid.tolist(), (1, 0, 0))
    project.path("table_04.obj").write_text("nonsense\n")
    after = dict(shelf.read_meshes(project, project.assets(), go_on))
    assert after["table_01.obj"] is before["table_01.obj"]
    assert after[OTHER].hull_of("convex_00").label == "misc"
    assert after[OTHER].hulls[1].shape is before[OTHER].hulls[1].shape
    assert len(after["table_03.obj"].hulls) == len(before["table_03.obj"].hulls) + 1
    assert set(before) - set(after) == {"table_04.obj"}
    with pytest.raises(StoppedError):
        list(shelf.read_meshes(project, project.assets(), lambda: True))


@pytest.mark.slow
def test_a_question_tells_what_each_choice_reads(own: Project, flag: CancelFlag) -> None:
    own.demonstrate("table_03.obj", [])
    outcome = learn(own, flag)
    assert outcome.status == "ambiguous"
    found, program = process.assess(own.folder, flag.make_token("assess"), 1), Program.parse(outcome.program or "")
    asked = found and found.question
    assert asked and asked.kind == "candidate" and asked.rule
    met = own.mesh_before_rule(asked.asset, asked.rule, program)
    for choice in asked.choices:
        chosen = select(parse_extractor(choice.text), met)
        assert [met.hulls[k].name for k in sorted(chosen)] == list(choice.select or ())
        assert choice.sentence
    assert {choice.text for choice in asked.choices} <= {reading.extractor for reading in outcome.candidates}


@pytest.mark.slow
def test_a_rule_that_no_extractor_fits_says_what_came_nearest(own: Project, flag: CancelFlag) -> None:
    own.demonstrate("table_08.obj", [])
    odd = {"convex_00", "convex_07", "convex_12", "convex_24", "convex_31"}
    own.demonstrate("table_03.obj", [Step(1, odd, parse_action("Delete"))])
    outcome = learn(own, flag)
    assert (outcome.status, outcome.program) == ("none", None)
    assert outcome.why
    assert outcome.nearest
    mesh = own.mesh_before_rule("table_03.obj", 1, Program(orient=own.orientation))
    chosen = {mesh.hulls[k].name for k in select(parse_extractor(outcome.nearest.extractor), mesh)}
    assert (chosen - odd, odd - chosen) == (set(outcome.nearest.extra), set(outcome.nearest.missing))
