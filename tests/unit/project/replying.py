"""Racks whose results a person judges: every kind of reply, and what it should do to probabilities."""

import json
import shutil
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import pytest

from meshforge.batch import IN_PROCESS
from meshforge.cli.review_answers import read_replies
from meshforge.language import Each, Merge
from meshforge.project import Project, ProjectReview
from meshforge.signoff import ReviewQuestion
from meshforge.signoff.question import QuestionKind
from meshforge.synthesis import Step
from tests.unit.project.racks import LEGS, PLAIN, shown_racks
from tests.unit.project.shelves import PLAIN as MISLABELLED
from tests.unit.project.shelves import SHELVED, ambiguous, mislabelled
from tests.unit.project.turned_racks import racks_on_their_side

SHOWN, ALSO, ASKED, OTHER, LAST = PLAIN
THREE = sorted(LEGS)[:3]
LYING = "rack5.obj"
Direction = Literal["up", "down", "same", "any"]
STRICT = 0.9999
"""A threshold that no result reaches before a person saw it, so that each can be asked about."""


def forgetful(folder: Path) -> Project:
    """One rack is shown, of which a leg is left out."""
    project = shown_racks(folder)
    project.demonstrate(ALSO, ())
    project.demonstrate(SHOWN, [Step(1, LEGS - {"left_low"}, Each(Merge()))])
    return project


def undemonstrated(folder: Path) -> Project:
    project = shown_racks(folder)
    for asset in project.demonstration_ids():
        project.demonstrate(asset, ())
    return project


MAKERS: Mapping[str, Callable[[Path], Project]] = {
    "undemonstrated": undemonstrated,
    "lying": racks_on_their_side,
    "plain": shown_racks,
    "slip": forgetful,
    "ambiguous": ambiguous,
    "mislabelled": mislabelled,
}


def copy(source: Path, folder: Path, monkeypatch: pytest.MonkeyPatch) -> Project:
    shutil.copytree(source, folder, dirs_exist_ok=True)
    monkeypatch.chdir(folder)
    beside = folder / "project"  # of those whose assets lie beside it
    return Project.open(beside if beside.exists() else folder / "racks")


def look(project: Project) -> ProjectReview:
    return project.review(STRICT, execution=IN_PROCESS)


def review_once(temporary: pytest.TempPathFactory) -> Callable[[str], Path]:
    """Gives the folder of a family that was reviewed once, made where it is first asked for."""
    folders = dict[str, Path]()

    def make(name: str) -> Path:
        if name not in folders:
            folders[name] = temporary.mktemp(name)
            look(MAKERS[name](folders[name]))
        return folders[name]

    return make


def write(project: Project, *assets: str) -> None:
    list(project.apply(assets or None, execution=IN_PROCESS))


def find_question(found: ProjectReview, kind: QuestionKind, asset: str) -> ReviewQuestion:
    return next(one for one in found.assessment.questions if (one.kind, one.asset) == (kind, asset))


def probabilities(found: ProjectReview) -> dict[str, float]:
    return {name: one.confidence for name, one in found.assessment.assets.items()}


def say(project: Project, choice: str, asset: str = ASKED, **more: Any) -> ProjectReview:
    """Reply to the question whether a result is right."""
    reply_by_method(project, find_question(look(project), "result", asset), {"choice": choice, **more})
    return look(project)


def reply_by_method(project: Project, question: ReviewQuestion, fields: Mapping[str, Any]) -> None:
    path = project.folder.parent / "said.json"
    path.write_text(json.dumps([{"id": question.id, **fields}]))
    (reply,) = read_replies(path)
    project.reply(question, reply.to_reply(question))


@dataclass(frozen=True)
class Case:
    """A reply. others: where probabilities go of assets that nobody has seen; own: that of the asset asked about."""

    kind: QuestionKind
    asset: str
    reply: Mapping[str, Any]
    others: Direction
    own: Direction
    family: str = "plain"


CASES = {
    "right": Case("result", ASKED, {"choice": "right"}, "up", "up"),
    "wrong": Case("result", ASKED, {"choice": "wrong"}, "down", "down"),
    "wrong, other hulls": Case("result", ASKED, {"choice": "wrong", "selections": {"1": THREE}}, "down", "up"),
    "wrong, other labels": Case("result", ASKED, {"choice": "wrong", "labels": {"rail": "leg"}}, "down", "down"),
    "not of this family": Case("result", ASKED, {"choice": "not-of-family"}, "any", "any"),
    "not solved": Case("result", ASKED, {"choice": "not-solved"}, "same", "same"),
    "later": Case("result", ASKED, {"later": True}, "same", "same"),
    "a group is what it is called": Case("group", ASKED, {"choice": "rail"}, "any", "up"),
    "a group is something else": Case("group", ASKED, {"choice": "leg"}, "down", "down"),
    "one of a group is something else": Case(
        "group", ASKED, {"choice": "rail", "exceptions": {f"{LAST}#rail": "leg"}}, "any", "up"
    ),
    "the reading that stands out": Case("candidate", SHELVED, {"choice": "a"}, "any", "any", "ambiguous"),
    "another reading": Case("candidate", SHELVED, {"choice": "b"}, "any", "up", "ambiguous"),
    "none of the readings": Case("candidate", SHELVED, {"choice": None}, "any", "any", "ambiguous"),
    "a label is repaired": Case("repair", MISLABELLED, {"choice": "knob"}, "up", "up", "mislabelled"),
    "a label is right": Case("repair", MISLABELLED, {"choice": "leg"}, "any", "any", "mislabelled"),
    "a slip": Case("selection", SHOWN, {"choice": "yes"}, "up", "any", "slip"),
    "turned": Case("orientation", LYING, {"choice": "yes"}, "any", "up", "lying"),
    "not turned": Case("orientation", LYING, {"choice": "no"}, "same", "same", "lying"),
    "no demonstration": Case("demonstrate", SHOWN, {"later": True}, "same", "same", "undemonstrated"),
    "no slip": Case("selection", SHOWN, {"choice": "no"}, "up", "any", "slip"),
}
