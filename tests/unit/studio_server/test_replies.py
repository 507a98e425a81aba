"""Every kind of reply as the page sends it: it writes what `Project.reply` writes, undo takes it back, and which way it
moves how sure an edit is."""

import json
import shutil
from pathlib import Path
from typing import Any

import pytest
from pydantic import TypeAdapter

from meshforge.batch import IN_PROCESS
from meshforge.common import ProjectError
from meshforge.language import Program
from meshforge.project import Project
from meshforge.signoff import Assessment, HullPlace, ReviewChoice, ReviewQuestion, ReviewReply, ReviewState, question_of
from meshforge.store import History
from meshforge.studio.edits import AnyEdit
from meshforge.studio.edits.base import make_edit
from meshforge.studio.edits.replies import ReplyToQuestion
from meshforge.studio.learning.results import view_assessment
from tests.unit.project.tables import FIRST, SECOND, THIRD, applied

LEG, OTHER_LEG = HullPlace(THIRD, "left_low"), HullPlace(SECOND, "left_low")
CRUMB = HullPlace(THIRD, "crumb")
LEG_OR_TOP = (ReviewChoice.of_label("leg"), ReviewChoice.of_label("top"))
JUDGE = tuple(ReviewChoice(one, one) for one in ("right", "wrong", "not-of-family", "not-solved"))
YES_OR_NO = (ReviewChoice("no", "no", select=("crumb",)), ReviewChoice("yes", "yes", select=("crumb", "top")))
READINGS = (ReviewChoice("a", "Is(crumb)", select=("crumb",)), ReviewChoice("b", "All", select=("crumb", "top")))
TURN = Program.parse("orient +Z: Is(leg) -> Is(top)\n").orient
TURNS = (ReviewChoice("no", "no"), ReviewChoice("yes", "yes", orient=TURN))
MISC_OR_LEG = (ReviewChoice.of_label("leg"), ReviewChoice.of_label("misc"))
ASKED: dict[str, ReviewQuestion] = {
    "group": ReviewQuestion("group", "?", 4.0, 1.2, THIRD, None, (LEG, OTHER_LEG), LEG_OR_TOP, "group-1"),
    "repair": ReviewQuestion("repair", "?", 3.0, 1.0, THIRD, 2, (CRUMB,), MISC_OR_LEG, "repair-1"),
    "candidate": ReviewQuestion("candidate", "?", 4.0, 1.0, THIRD, 1, (), READINGS, "reading-1"),
    "selection": ReviewQuestion(
        "selection", "?", 3.0, 1.0, FIRST, 1, (HullPlace(FIRST, "top"),), YES_OR_NO, "selection-1"
    ),
    "orientation": ReviewQuestion("orientation", "?", 3.0, 1.0, FIRST, choices=TURNS, id="orientation-1"),
    "result": ReviewQuestion("result", "?", 3.0, 1.0, THIRD, choices=JUDGE, id="result-1"),
}

REPLIES: dict[str, tuple[str, dict[str, Any], str]] = {
    "a group is one label": ("group", {"choice": "leg"}, "="),
    "one of a group is something else": (
        "group",
        {"choice": "leg", "exceptions": [{"asset": THIRD, "hull": "left_low", "label": "top"}]},
        "<",
    ),
    "a group is none of these": ("group", {}, "="),
    "a label is wrong": ("repair", {"choice": "leg"}, "<"),
    "a label is right": ("repair", {"choice": "misc"}, "="),
    "a reading": ("candidate", {"choice": "a"}, "="),
    "no reading": ("candidate", {}, "="),
    "on purpose": ("selection", {"choice": "no"}, "="),
    "by mistake": ("selection", {"choice": "yes"}, "<"),
    "not turned": ("orientation", {"choice": "no"}, "="),
    "turned": ("orientation", {"choice": "yes"}, "="),
    "right": ("result", {"choice": "right"}, ">"),
    "wrong": ("result", {"choice": "wrong"}, "<"),
    "other hulls": ("result", {"choice": "wrong", "selections": {"1": ["crumb", "top"]}}, ">"),
    "other labels": ("result", {"choice": "wrong", "labels": {"left_low": "top"}}, "<"),
    "not of this family": ("result", {"choice": "not-of-family"}, "gone"),
    "not solved": ("result", {"choice": "not-solved"}, "="),
    **{f"{kind} later": (kind, {"later": True}, "=") for kind in ASKED},
}


@pytest.fixture(scope="module")
def begun(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a project that has outputs."""
    folder = tmp_path_factory.mktemp("begun")
    applied(folder)
    return folder


def copied(begun: Path, to: Path) -> Project:
    """A project of its own."""
    return Project.open(shutil.copytree(begun, to) / "tables")


def view(question: ReviewQuestion, project: Project) -> dict[str, Any]:
    """A question as a page is asked it."""
    meshes = {asset: project.mesh(asset) for asset in project.assets()}
    state = ReviewState(meshes, project.program() or pytest.fail())
    asked = view_assessment(Assessment({}, questions=(question,)), state).question
    assert asked
    return asked.model_dump(mode="json")


def edit_of(question: ReviewQuestion, project: Project, said: dict[str, Any]) -> ReplyToQuestion:
    text = json.dumps({"kind": "reply", "question": view(question, project), **said})
    edit: ReplyToQuestion = TypeAdapter[Any](AnyEdit).validate_json(text)
    return edit


def reply_of(question: ReviewQuestion, said: dict[str, Any]) -> ReviewReply:
    return ReviewReply(
        question.id,
        said.get("choice"),
        {HullPlace(one["asset"], one["hull"]): one["label"] for one in said.get("exceptions", ())},
        {int(rule): frozenset(hulls) for rule, hulls in said.get("selections", {}).items()},
        said.get("labels", {}),
        said.get("later", False),
    )


def probability(project: Project) -> float | None:
    found = project.review(execution=IN_PROCESS).assessment.assets.get(THIRD)
    return found.probability if found else None


def kept(project: Project) -> dict[str, bytes]:
    """What a person said and set, as it is on disk."""
    names = ("events.jsonl", "meshforge.toml", "labels", "demonstrations", "prepared")
    paths = [file for name in names for file in (project.folder / name, *(project.folder / name).rglob("*"))]
    return {str(path.relative_to(project.folder)): path.read_bytes() for path in paths if path.is_file()}


@pytest.mark.parametrize("kind", ASKED)
def test_a_question_is_the_same_after_the_page_has_seen_it(begun: Path, kind: str) -> None:
    project = Project.open(begun / "tables")
    assert question_of(view(ASKED[kind], project)) == ASKED[kind]


@pytest.mark.parametrize("name", REPLIES)
def test_a_reply_of_the_page_writes_what_a_reply_of_the_project_writes(begun: Path, tmp_path: Path, name: str) -> None:
    kind, said, moves = REPLIES[name]
    page, twin = copied(begun, tmp_path / "page"), copied(begun, tmp_path / "twin")
    before, was = kept(page), probability(page)
    twin.reply(ASKED[kind], reply_of(ASKED[kind], said))
    history = History.open(page.folder)
    assert make_edit(history, page, edit_of(ASKED[kind], page, said))
    assert kept(page) == kept(twin) != before
    now = probability(page)
    if was is None or now is None:
        assert moves == "gone"
    else:
        assert ("=" if abs(now - was) < 1e-3 else "<" if now < was else ">") == moves, (was, now)
    assert history.undo() and kept(page) == before


def test_a_reply_that_does_not_fit_writes_nothing(begun: Path, tmp_path: Path) -> None:
    project = copied(begun, tmp_path / "page")
    before = kept(project)
    for said in (
        {"choice": "splendid"},
        {"choice": "right", "labels": {"left_low": "top"}},
        {"choice": "wrong", "selections": {"9": []}},
    ):
        with pytest.raises(ProjectError):
            make_edit(History.open(project.folder), project, edit_of(ASKED["result"], project, said))
        assert kept(project) == before
