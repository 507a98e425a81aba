"""The studio keeps what its learning process found as a review does, and signs off by it; never what is out of date."""

from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import pytest

from meshforge.batch import IN_PROCESS
from meshforge.common import relative_name
from meshforge.language import Delete
from meshforge.project import Project
from meshforge.signoff import Assessment, review_family
from meshforge.store import ANSWERS, AnswerEvent, AssessmentFile, ExclusionEvent, SnoozeEvent, VerdictEvent
from meshforge.studio.learning import process
from meshforge.studio.learning.queue import CancelFlag
from meshforge.studio.session.file_sync import FileSync
from meshforge.synthesis import Step
from tests.unit.project.tables import FIRST, SECOND, STEPS, THIRD, applied


def learn(project: Project, flag: CancelFlag, number: int = 1) -> None:
    assert process.learn(project.folder, flag.make_token("learn"), number).error is None


def assess(project: Project, flag: CancelFlag, number: int = 1) -> None:
    assert process.assess(project.folder, flag.make_token("assess"), number) is not None


def learn_and_assess(project: Project, flag: CancelFlag, number: int = 1) -> None:
    learn(project, flag, number)
    assess(project, flag, number)


THRESHOLD = 0.9


def judged(project: Project) -> Project:
    """The same with a bar that a person chose, and its second result accepted."""
    project.write_assessment(AssessmentFile(threshold=THRESHOLD, inputs_digest=""))
    project.set_verdict(SECOND, "accepted")
    return project


def assessed(folder: Path, flag: CancelFlag) -> Project:
    """A project whose second result a person accepted, as the studio assesses it."""
    project = judged(applied(folder))
    learn_and_assess(project, flag)
    return project


def signers_of(project: Project) -> dict[str, str]:
    return {asset: one.by for asset, one in project.sign_offs().items()}


def files_of(project: Project) -> list[bytes | None]:
    paths = (project.layout.assessment, project.layout.sign_offs)
    return [path.read_bytes() if path.exists() else None for path in paths]


def test_what_was_assessed_is_in_the_status_and_signs_off_what_is_written(tmp_path: Path, flag: CancelFlag) -> None:
    project = assessed(tmp_path, flag)
    assert signers_of(project) == {FIRST: "person", SECOND: "person", THIRD: "tool"}
    assert project.status().is_signed_off
    before = files_of(project)
    assess(project, flag)
    assert files_of(project) == before
    project.review(THRESHOLD, execution=IN_PROCESS)
    assert files_of(project) == before


def test_nothing_rests_unseen_on_a_demonstration_carried_to_parts_of_a_hull(tmp_path: Path, flag: CancelFlag) -> None:
    project = judged(applied(tmp_path))
    project.cut(FIRST, "crumb", (5.05, 5.05, 5.05), (0, 0, 1))
    list(project.apply(execution=IN_PROCESS))
    learn_and_assess(project, flag)
    assert signers_of(project) == {SECOND: "person"}
    carried = "crumb, which is demonstrated for rule 1, was split into crumb#0, crumb#1: "
    carried += "look whether all parts are meant"
    told = {asset.id: [doubt.text for doubt in asset.result_status.reasons] for asset in project.status().assets}
    assert carried in told[FIRST] and f"{FIRST}: {carried}" in told[THIRD]
    project.demonstrate(FIRST, project.steps(FIRST))
    learn_and_assess(project, flag, 2)
    assert {FIRST, THIRD} <= signers_of(project).keys(), "a person looked"


def test_what_changed_meanwhile_is_not_kept(tmp_path: Path, flag: CancelFlag, monkeypatch: pytest.MonkeyPatch) -> None:
    project = applied(tmp_path)
    learn(project, flag)

    def change_a_label(*given: Any) -> Assessment:
        project.set_labels(THIRD, {"crumb": "leg"})
        return review_family(*given)

    with monkeypatch.context() as meanwhile:
        meanwhile.setattr("meshforge.project.review.review_family", change_a_label)
        assess(project, flag)
    assert files_of(project) == [None, None]


def test_where_it_cannot_be_kept_it_is_shown(tmp_path: Path, flag: CancelFlag, monkeypatch: pytest.MonkeyPatch) -> None:
    def fill_up(*_: object) -> bool:
        raise OSError(28, "No space left on device")

    project = applied(tmp_path)
    learn(project, flag)
    monkeypatch.setattr("meshforge.project.FamilyAssessment.keep", fill_up)
    assess(project, flag)
    assert files_of(project) == [None, None]


def test_what_changed_since_it_was_learned_is_not_kept(tmp_path: Path, flag: CancelFlag) -> None:
    project = applied(tmp_path)
    learn(project, flag)
    project.set_labels(THIRD, {"crumb": "leg"})
    assess(project, flag)
    assert files_of(project) == [None, None]
    learn_and_assess(project, flag, 2)
    assert None not in files_of(project)


def test_where_it_looks_at_some_assets_only_what_a_review_found_stays(
    tmp_path: Path, flag: CancelFlag, monkeypatch: pytest.MonkeyPatch
) -> None:
    project = applied(tmp_path)
    project.review(0.9, execution=IN_PROCESS)
    before = files_of(project)
    monkeypatch.setattr("meshforge.project.learn.MOST_ASSETS", 2)
    learn_and_assess(project, flag)
    assert files_of(project) == before


def test_while_nothing_fits_sign_offs_stay_as_they_are(tmp_path: Path, flag: CancelFlag) -> None:
    project = applied(tmp_path)
    project.review(execution=IN_PROCESS)
    before = files_of(project)
    for asset, hull in ((FIRST, "top"), (SECOND, "crumb")):
        project.demonstrate(asset, [Step(1, {hull}, Delete())])
    learn_and_assess(project, flag)
    assert files_of(project) == before


def test_what_a_person_takes_back_is_not_signed_off_and_the_threshold_stays(tmp_path: Path, flag: CancelFlag) -> None:
    project = applied(tmp_path)
    project.set_verdict(THIRD, "accepted")
    project.review(0.9999, execution=IN_PROCESS)
    assert signers_of(project)[THIRD] == "person"
    project.set_verdict(THIRD, None)
    learn_and_assess(project, flag)
    kept = project.assessment()
    assert kept and kept.threshold == 0.9999 and not kept.assets[THIRD].passes(kept.threshold)
    assert THIRD not in signers_of(project)


def test_a_persons_sign_off_is_void_and_not_lost_when_the_program_changes(tmp_path: Path, flag: CancelFlag) -> None:
    project = applied(tmp_path)
    project.set_verdict(THIRD, "accepted")
    project.review(0.9999, execution=IN_PROCESS)
    for asset in (FIRST, SECOND):
        project.demonstrate(asset, STEPS[:1])
    learn_and_assess(project, flag)
    assert signers_of(project)[THIRD] == "person"
    assert next(one for one in project.status().assets if one.id == THIRD).result_status.void == ("program", ANSWERS)


def test_what_was_said_is_learned_from_what_is_snoozed_is_asked_anew_sign_offs_are_neither(tmp_path: Path) -> None:
    project = applied(tmp_path)
    done = list[str]()
    learning = SimpleNamespace(assess=lambda: done.append("assess"), restart=lambda: done.append("learn"))
    pages = SimpleNamespace(announce_assets=lambda *_: None)
    queue = SimpleNamespace(add=lambda *_, **__: None)
    sync = FileSync(cast(Any, project), cast(Any, pages), cast(Any, learning), cast(Any, queue))
    project.review(execution=IN_PROCESS)
    assert project.layout.sign_offs.exists()
    for path in (project.layout.sign_offs, project.layout.assessment):
        sync.update([relative_name(path, project.folder)])
    assert done == []
    for event, follows in (
        (SnoozeEvent(question="group-1"), "assess"),
        (VerdictEvent(asset=THIRD, verdict="wrong"), "learn"),
        (ExclusionEvent(asset=THIRD, reason="not solved"), "learn"),
        (AnswerEvent(rule=1, asset=THIRD, select=("crumb",)), "learn"),
    ):
        project.add_events(event)
        sync.update(["events.jsonl"])
        assert done.pop() == follows and not done
