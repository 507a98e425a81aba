"""A reply whose command was killed is taken by the same command again, which then exits as if it had not been."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest

from meshforge.batch import IN_PROCESS
from meshforge.project import Project
from tests.unit.batch.families import tree
from tests.unit.cli.in_process import Run
from tests.unit.deaths import deaths, needs_fork
from tests.unit.project.replying import CASES, MAKERS, STRICT, find_question, look, reply_by_method

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
