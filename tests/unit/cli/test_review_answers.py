"""Replies to a review's questions: typed, read from a file, and what they contradict."""

import json
from pathlib import Path

import pytest

from meshforge.cli.review_answers import (
    ScriptReply,
    format_prompt,
    format_question,
    format_reply_help,
    letter_of,
    parse_reply,
    read_replies,
)
from meshforge.common import UsageError
from meshforge.signoff import HullPlace, ReviewChoice, ReviewQuestion, ReviewReply
from meshforge.signoff.question import EXCLUDE, WRONG

LEFT, RIGHT = HullPlace("a.obj", "left"), HullPlace("b.obj", "right")
LEG = ReviewChoice.of_label("leg")
GROUP = ReviewQuestion("group", "All legs?", 4.0, 1.0, "a.obj", None, (LEFT, RIGHT), (LEG,), "group-1")
READINGS = (ReviewChoice("a", "Is(leg)", select=("left",)), ReviewChoice("b", "All", select=()))
READING = ReviewQuestion(
    "candidate", "What does rule 1 mean on a.obj?", 4.0, 1.0, "a.obj", 1, (), READINGS, "reading-1"
)
VERDICTS = tuple(ReviewChoice(one, one) for one in ("right", WRONG, *EXCLUDE))
RESULT = ReviewQuestion("result", "Is the result of a.obj right?", 4.0, 1.0, "a.obj", choices=VERDICTS, id="result-1")
DEMONSTRATE = ReviewQuestion("demonstrate", "Show the edit on a.obj.", 20.0, 1.0, "a.obj", id="demonstrate-1")


@pytest.mark.parametrize(
    ("line", "reply"),
    [
        ("", ReviewReply("group-1", "leg")),
        ("1", ReviewReply("group-1", "leg")),
        ("leg", ReviewReply("group-1", "leg")),
        ("n", ReviewReply("group-1", None)),
        ("l", ReviewReply("group-1", later=True)),
        ("1 b=panel", ReviewReply("group-1", "leg", {RIGHT: "panel"})),
        ("a=panel, b=door", ReviewReply("group-1", "leg", {LEFT: "panel", RIGHT: "door"})),
    ],
)
def test_a_line_is_a_reply(line: str, reply: ReviewReply) -> None:
    assert parse_reply(line, GROUP) == reply


@pytest.mark.parametrize(
    ("line", "reply"),
    [
        ("", ReviewReply("result-1", "right")),
        ("2", ReviewReply("result-1", WRONG)),
        ("not-solved", ReviewReply("result-1", "not-solved")),
        (
            "2 1:left,right 2: left=leg",
            ReviewReply(
                "result-1", WRONG, selections={1: frozenset({"left", "right"}), 2: frozenset()}, labels={"left": "leg"}
            ),
        ),
    ],
)
def test_what_is_right_is_typed_after_wrong(line: str, reply: ReviewReply) -> None:
    assert parse_reply(line, RESULT) == reply
    assert "(what is right after it: 2 RULE:HULL,HULL HULL=LABEL)" in format_prompt(RESULT)


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
        {"id": "z", "choice": "wrong", "selections": {"2": ["left"]}, "labels": {"left": "leg"}},
    ]
    path.write_text(json.dumps(rows))
    assert read_replies(path) == (
        ScriptReply(id="group-1", choice=0, exceptions={f"{RIGHT.asset}#{RIGHT.hull}": "panel"}),
        ScriptReply(id="x"),
        ScriptReply(id="y", later=True),
        ScriptReply(id="z", choice=WRONG, selections={"2": frozenset({"left"})}, labels={"left": "leg"}),
    )
    group, *_, wrong = read_replies(path)
    assert group.to_reply(GROUP) == ReviewReply("group-1", "leg", {RIGHT: "panel"})
    expected = ReviewReply("z", WRONG, selections={2: frozenset({"left"})}, labels={"left": "leg"})
    assert wrong.to_reply(READING) == expected


def test_a_choice_is_an_id_or_a_number_from_0() -> None:
    assert ScriptReply(id="reading-1", choice=1).to_reply(READING) == ReviewReply("reading-1", "b")
    assert ScriptReply(id="reading-1", choice="b").to_reply(READING) == ReviewReply("reading-1", "b")
    assert ScriptReply(id="reading-1").to_reply(READING) == ReviewReply("reading-1", None)
    with pytest.raises(UsageError, match="question reading-1 has 2 choices"):
        ScriptReply(id="reading-1", choice=2).to_reply(READING)


@pytest.mark.parametrize(
    ("row", "problem"),
    [
        ({"choice": 0}, "the field [1].id is missing"),
        ("a", 'the field [1]: expected an object {...}, found "a"'),
        ({"id": "a", "choice": True}, "the field [1].choice: expected the id of a choice, a number from 0, or null"),
        ({"id": "a", "choice": ["x"]}, "the field [1].choice: expected the id of a choice, a number from 0, or null"),
        ({"id": "a", "selections": {"a": []}}, 'the field [1].selections.a.[key]: "a" does not fit'),
        ({"id": "a", "selections": {"1": "b"}}, 'the field [1].selections.1: expected a list [...], found "b"'),
        ({"id": "a", "labels": {"b": 1}}, "the field [1].labels.b: expected a text, found 1"),
        ({"id": "a", "later": "yes"}, 'the field [1].later: expected true or false, found "yes"'),
        ({"id": "a", "pick": 1}, "there is no such field as [1].pick"),
        ({"id": "a", "exceptions": ["b"]}, 'the field [1].exceptions: expected an object {...}, found ["b"]'),
        ({"id": "a", "exceptions": {"b": "c"}}, 'the field [1].exceptions.b.[key]: "b" does not fit'),
        ({"id": "a", "exceptions": {"b#c": 1}}, "the field [1].exceptions.b#c: expected a text, found 1"),
    ],
)
def test_an_entry_of_another_form_is_named_with_what_is_wrong(tmp_path: Path, row: object, problem: str) -> None:
    path = tmp_path / "said.json"
    path.write_text(json.dumps([{"id": "x"}, row]))
    with pytest.raises(UsageError) as raised:
        read_replies(path)
    assert (raised.value.where, raised.value.problem) == (str(path), problem)


@pytest.mark.parametrize(
    ("data", "problem"),
    [(b"{", "this is no JSON"), (b"{}", "expected a list"), (b"3", "expected a list"), (b"\xff", "this is no JSON")],
)
def test_a_file_of_another_form_is_refused(tmp_path: Path, data: bytes, problem: str) -> None:
    path = tmp_path / "said.json"
    path.write_bytes(data)
    with pytest.raises(UsageError, match=problem):
        read_replies(path)


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


def test_a_demonstration_is_asked_for_with_its_command() -> None:
    assert format_prompt(DEMONSTRATE) == "l later, q stop: "
    assert format_reply_help(DEMONSTRATE, "tables") == (
        "Show it: meshforge demonstrate tables a.obj 'HULLS => ACTION' ..."
    )
    assert parse_reply("", DEMONSTRATE) == ReviewReply("demonstrate-1", later=True)
