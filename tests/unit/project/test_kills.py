"""A change to a project that is killed has happened whole, or not at all. A reply whose command was killed is taken by
the same command again, which then exits as if it had not been."""

import json
import shutil
import threading
from collections.abc import Callable, Iterable
from functools import partial
from pathlib import Path

import pytest

from meshforge.batch import IN_PROCESS
from meshforge.language import Delete, Merge, Program
from meshforge.project import Project, demonstrations
from meshforge.synthesis import Answer, LabelFix, Step
from tests.unit.batch.families import tree
from tests.unit.cli.in_process import Run
from tests.unit.deaths import deaths, needs_fork
from tests.unit.project.replying import CASES, MAKERS, STRICT, find_question, look, reply_by_method
from tests.unit.project.tables import FIRST, SECOND, THIRD, applied

REPAIR = LabelFix(FIRST, "crumb", "misc", "leg")
CHANGES: dict[str, Callable[[Project], object]] = {
    "vocabulary": lambda p: p.set_vocabulary(["top", "leg", "misc", "more"]),
    "labels": lambda p: p.set_labels(FIRST, {"crumb": "leg"}),
    "demonstration": lambda p: p.demonstrate(FIRST, [Step(1, {"crumb"}, Delete())]),
    "correction": lambda p: p.correct(FIRST, ["top"], Delete()),
    "answer": lambda p: p.add_answer(Answer(1, THIRD, ["crumb"])),
    "refused repair": lambda p: demonstrations.reject(p, REPAIR),
    "review": lambda p: p.set_verdict(FIRST, "accepted"),
    "program": lambda p: p.accept(Program.parse("labels top\nAll => Merge\n")),
}
FIRST_WRITTEN = {"program": {"program.previous.mf"}, "correction": {"events.jsonl"}}
"""What is written before the change itself: the program that was, and that a result was wrong."""


def kept(project: Project) -> dict[str, bytes]:
    """The files of a project, drafts of killed writers aside."""
    return {name: data for name, data in tree(project.folder).items() if not name.endswith(".tmp")}


@needs_fork
@pytest.mark.parametrize("name", CHANGES)
def test_a_killed_change_has_happened_or_not(tmp_path: Path, name: str) -> None:
    project = applied(tmp_path)
    before = kept(project)
    died = 0
    for renames in deaths(lambda: CHANGES[name](project)):
        died += 1
        after = kept(project)
        changed = {path for path in before | after if before.get(path) != after.get(path)}
        assert changed <= FIRST_WRITTEN.get(name, set()) if renames else not changed
    assert died
    assert kept(project) != before


@needs_fork
def test_a_killed_repair_can_be_done_again_and_taken_back(tmp_path: Path) -> None:
    project = applied(tmp_path)
    before = project.labels(FIRST).labels["crumb"]
    for _ in deaths(lambda: project.confirm(REPAIR)):
        assert project.labels(FIRST).labels["crumb"] == before
    assert project.labels(FIRST).labels["crumb"].source == "repair"
    for _ in deaths(lambda: project.take_back("table0/model.obj#crumb=leg")):
        assert project.feedback().answers_and_fixes
    assert project.labels(FIRST).labels["crumb"] == before
    assert not project.feedback().answers_and_fixes


def run_at_one_time(works: Iterable[Callable[[], object]]) -> None:
    threads = [threading.Thread(target=work) for work in works]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()


def test_what_several_write_at_one_time_is_all_kept(tmp_path: Path) -> None:
    project = applied(tmp_path)
    given = [Answer(rule, asset, None) for rule in (1, 2) for asset in project.assets()]
    run_at_one_time([partial(Project.open(project.folder).add_answer, one) for one in given])
    assert [line.answer for line in project.feedback().answers.values()] == given
    names = [hull.name for hull in project.mesh(FIRST).hulls]
    run_at_one_time([partial(Project.open(project.folder).set_labels, FIRST, {name: "leg"}) for name in names])
    assert {hull.name: hull.label for hull in project.mesh(FIRST).hulls} == dict.fromkeys(names, "leg")
    run_at_one_time([partial(project.correct, SECOND, ["top"], Merge())] * 3)
    assert len(project.manual_edits(SECOND)) == 3


SAME = ("labels/", "demonstrations/", "meshforge.toml", "program.mf", "edited/")
SURE = ("--min-confidence", str(STRICT), "--answers", "said.json")


def outcome(project: Project) -> object:
    """All that a reply can change, but for how often it was said."""
    found = project.review(STRICT, execution=IN_PROCESS)
    files = {name: data for name, data in tree(project.folder).items() if name.startswith(SAME)}
    outputs = {name: data for name, data in files.items() if "/.meshforge" not in name and not name.endswith(".tmp")}
    return found.assessment.assets, found.assessment.need_review, found.assessment.excluded, outputs


@needs_fork
@pytest.mark.slow
@pytest.mark.parametrize(
    "name",
    [
        "right",
        "wrong, other labels",
        "a group is something else",
        *(pytest.param(name, marks=pytest.mark.long) for name in ("wrong, other hulls", "not solved", "a slip")),
    ],
)
def test_a_reply_whose_command_was_killed_is_taken_again(run: Run, tmp_path: Path, name: str) -> None:
    case = CASES[name]
    project = MAKERS[case.family](tmp_path)
    question = find_question(look(project), case.kind, case.asset)
    Path("said.json").write_text(json.dumps([{"id": question.id, **case.reply}]))
    shutil.copytree(project.folder, "before")
    code = run("review", "racks", *SURE).code
    expected = outcome(project)

    def restore() -> None:
        shutil.rmtree(project.folder)
        shutil.copytree("before", project.folder)

    restore()
    for _ in deaths(lambda: reply_by_method(project, question, case.reply), costly=True):
        told = run("review", "racks", *SURE)
        assert (told.code, "is not asked any more" in told.err) == (code, False)
        if case.kind != "group":  # of which the labels of some assets may be written, and those of others not
            assert outcome(project) == expected
        restore()
    told = run("review", "racks", *SURE)
    assert (told.code, "is not asked any more" in told.err) == (code, False)
    assert outcome(project) == expected
