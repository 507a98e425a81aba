"""Replies to a review's questions: typed, read from a file, and what they contradict."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from meshforge.cli.review_answers import find_contradictions, parse_reply, read_replies
from meshforge.cli.review_text import format_prompt, format_question, format_reply_help, letter_of
from meshforge.common import UsageError
from meshforge.geometry import Box, Pose
from meshforge.language import Program
from meshforge.signoff import HullPlace, ReviewChoice, ReviewQuestion, ReviewReply, ReviewState
from meshforge.symbolic import Hull, Label, SymbolicMesh

LEFT, RIGHT = HullPlace("a.obj", "left"), HullPlace("b.obj", "right")
GROUP = ReviewQuestion(
    "group-1", "group", "All legs?", 4.0, 1.0, "a.obj", None, (LEFT, RIGHT), (ReviewChoice("leg", "leg"),)
)
READING = ReviewQuestion(
    "reading-1",
    "reading",
    "What does rule 1 mean on a.obj?",
    4.0,
    1.0,
    "a.obj",
    1,
    (),
    (ReviewChoice("Is(leg)", select=("left",)), ReviewChoice("All", select=())),
)
DEMONSTRATE = ReviewQuestion("demonstrate-1", "demonstrate", "Show the edit on a.obj.", 20.0, 1.0, "a.obj")


@pytest.mark.parametrize(
    ("line", "reply"),
    [
        ("", ReviewReply("group-1", 0)),
        ("1", ReviewReply("group-1", 0)),
        ("n", ReviewReply("group-1", None)),
        ("l", ReviewReply("group-1", later=True)),
        ("1 b=panel", ReviewReply("group-1", 0, {RIGHT: "panel"})),
        ("a=panel, b=door", ReviewReply("group-1", 0, {LEFT: "panel", RIGHT: "door"})),
    ],
)
def test_a_line_is_a_reply(line: str, reply: ReviewReply) -> None:
    assert parse_reply(line, GROUP) == reply


@pytest.mark.parametrize(
    ("line", "choice", "later"),
    [("", 0, False), ("y", 0, False), ("1", 0, False), ("n", 1, False), ("2", 1, False), ("l", None, True)],
)
def test_whether_to_split_a_hull_is_a_yes_or_no(line: str, choice: int | None, later: bool) -> None:
    choices = (ReviewChoice("split so: wall (98%), handle (93%)"), ReviewChoice("no, it is one part"))
    span = ReviewQuestion("span-1", "span", "split so?", 3.0, 0.9, "a.obj", None, (LEFT,), choices)
    assert parse_reply(line, span) == ReviewReply("span-1", choice, later=later)
    assert format_prompt(span).startswith("y split so, n it is one part, l later")


@pytest.mark.parametrize("line", ["2", "0", "maybe", "1 c=panel", "1 a=", "1 a"])
def test_a_line_that_is_no_reply_is_one_clear_message(line: str) -> None:
    with pytest.raises(UsageError, match=r"is no reply|there is no choice"):
        parse_reply(line, GROUP)


def test_replies_are_read_from_a_file(tmp_path: Path) -> None:
    path = tmp_path / "said.json"
    rows = [
        {"id": "group-1", "choice": 0, "exceptions": {"b.obj#right": "panel"}},
        {"id": "x", "choice": None},
        {"id": "y", "later": True},
    ]
    path.write_text(json.dumps(rows))
    assert read_replies(path) == [
        ReviewReply("group-1", 0, {RIGHT: "panel"}),
        ReviewReply("x", None),
        ReviewReply("y", later=True),
    ]


@pytest.mark.parametrize(
    ("row", "problem"),
    [
        ({"choice": 0}, "reply 2 has no id"),
        ("a", "reply 2 has no id"),
        ({"id": "a", "choice": True}, "reply 2: the choice True is no number from 0"),
        ({"id": "a", "choice": "x"}, "reply 2: the choice 'x' is no number from 0"),
        ({"id": "a", "later": "yes"}, "reply 2: 'yes' for later is not true or false"),
        ({"id": "a", "pick": 1}, "reply 2 has a field 'pick', which is none of a reply"),
        ({"id": "a", "exceptions": ["b"]}, "reply 2: its exceptions are no labels by ASSET#HULL"),
        ({"id": "a", "exceptions": {"b": "c"}}, "reply 2: the exception 'b' is no label of an ASSET#HULL"),
        ({"id": "a", "exceptions": {"b#c": 1}}, "reply 2: the exception 'b#c' is no label of an ASSET#HULL"),
    ],
)
def test_an_entry_of_another_form_is_named_with_what_is_wrong(tmp_path: Path, row: object, problem: str) -> None:
    path = tmp_path / "said.json"
    path.write_text(json.dumps([{"id": "x"}, row]))
    with pytest.raises(UsageError) as raised:
        read_replies(path)
    assert (raised.value.where, raised.value.problem) == (str(path), problem)


@pytest.mark.parametrize(("text", "problem"), [("{", "this is no JSON"), ("{}", "this is no list"), ("3", "no list")])
def test_a_file_of_another_form_is_refused(tmp_path: Path, text: str, problem: str) -> None:
    path = tmp_path / "said.json"
    path.write_text(text)
    with pytest.raises(UsageError, match=problem):
        read_replies(path)


def state_of(label: Label) -> ReviewState:
    shape = Box(Pose.identity(), np.ones(3))
    meshes = {place.asset: SymbolicMesh((Hull(place.hull, "body", shape, label),)) for place in (LEFT, RIGHT)}
    return ReviewState(meshes, Program())


def test_what_a_person_said_before_is_told_and_the_last_word_counts() -> None:
    told = list(find_contradictions(state_of(Label("panel")), GROUP, ReviewReply("group-1", 0, {RIGHT: "panel"})))
    assert told == ["left of a.obj was called panel by a person before, and is leg now: the last word counts"]
    assert not list(find_contradictions(state_of(Label("panel", 0.5, "vlm")), GROUP, ReviewReply("group-1", 0)))
    assert not list(find_contradictions(state_of(Label("panel")), GROUP, ReviewReply("group-1", later=True)))


def test_a_group_lists_its_hulls_by_letter() -> None:
    assert format_question(GROUP, [Path("group.png")]).splitlines() == [
        "All legs?  [group-1, about 4 s]",
        "  1 leg",
        "  hulls:",
        "    a left of a.obj",
        "    b right of b.obj",
        "  picture: group.png",
    ]
    assert format_prompt(GROUP) == (
        "1 (what is something else after it: 1 b=LABEL), n for none, l later, q stop; Enter: 1: "
    )
    assert [letter_of(place) for place in (0, 25, 26, 51, 52)] == ["a", "z", "aa", "az", "ba"]


def test_each_reading_has_a_picture_of_its_own() -> None:
    assert format_question(READING, [Path("1.png"), Path("2.png")]).splitlines()[1:] == [
        "  1 Is(leg): 1 hull, left",
        "    picture: 1.png",
        "  2 All: 0 hulls",
        "    picture: 2.png",
    ]


def test_a_demonstration_is_asked_for_with_its_command() -> None:
    assert format_prompt(DEMONSTRATE) == "l later, q stop: "
    assert format_reply_help(DEMONSTRATE, "tables") == (
        "Show it: meshforge demonstrate tables a.obj 'HULLS => ACTION' ..."
    )
    with pytest.raises(UsageError, match="there is no choice 1"):
        parse_reply("", DEMONSTRATE)
