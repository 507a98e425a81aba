"""`meshforge synthesize` for scripts: answers, repairs, what is printed where, and how it is stopped."""

from __future__ import annotations

import json
import os
import re
import signal
from dataclasses import replace
from pathlib import Path
from typing import Any, get_args, get_type_hints

import pytest

from meshforge import synthesis
from meshforge.cli.synthesize import synthesize
from meshforge.cli.terminal import catch_interrupt
from meshforge.language import Delete
from meshforge.project import Project
from meshforge.synthesis import LAYERS, Step
from meshforge.synthesis.options import STRATEGIES
from tests.unit.cli.in_process import Run, runner
from tests.unit.project.shelves import OTHER, PLAIN, SHELVED, ambiguous, mislabelled, racks

LABELS = "labels board, leg, knob\n\n"


@pytest.fixture
def run(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path) -> Run:
    monkeypatch.chdir(tmp_path)
    return runner(monkeypatch, capsys)


def timeless(text: str) -> str:
    """A text without seconds."""
    return re.sub(r"\d+\.\d\d s", "TIME", text)


def answers(*entries: object) -> str:
    Path("given.json").write_text(json.dumps(entries))
    return "given.json"


def test_a_question_is_printed_with_the_ways_to_answer_it(run: Run, tmp_path: Path) -> None:
    ambiguous(tmp_path)
    told = run("synthesize", "racks")
    assert told.code == 0
    assert told.out == f"{LABELS}Is(board) => Delete\n"
    ahead = run("synthesize", "racks", "--json").json["demonstrate_next"]["asset"]
    assert (
        timeless(told.err).replace(ahead, "AHEAD")
        == """
learned in TIME, kept as racks/program.mf
ambiguous: it is open what rule 1 does on rack2.obj
Look first at:
  AHEAD: demonstrate it to be more certain: believable readings of the rules differ there
  meshforge demonstrate racks AHEAD 'HULLS => ACTION' ...
Next: meshforge apply racks

What should rule 1 take on rack2.obj?
  1  2 hulls: top, shelf
  2  1 hull: top
  3  1 hull: shelf
Answer it in a terminal: meshforge synthesize racks
  or in a script: meshforge synthesize racks --answers FILE, where FILE holds [{"question": "1:rack2.obj", "choice": 1}]
  (null in place of 1: neither)
"""
    )


def test_answers_come_from_a_file_by_the_choice(run: Run, tmp_path: Path) -> None:
    ambiguous(tmp_path)
    told = run("synthesize", "racks", "--answers", answers({"question": "1:rack2.obj", "choice": 2}))
    assert (told.code, told.out) == (0, f"{LABELS}Geo(Is(board), +Z) => Delete\n")
    assert (
        timeless(told.err)
        == """
learned in TIME with 1 answer, kept as racks/program.mf
all believable readings of the rules agree on your 30 assets
Next: meshforge apply racks
"""
    )
    again = run("synthesize", "racks", "--json", "--answers", "given.json")
    assert again.code == 0 and again.json["settled"]


def test_answers_come_from_a_file_by_the_selection(run: Run, tmp_path: Path) -> None:
    ambiguous(tmp_path)
    told = run("synthesize", "racks", "--answers", answers({"rule": 1, "asset": "rack3.obj", "select": ["top"]}))
    assert told.out == f"{LABELS}Geo(Is(board), +Z) => Delete\n"
    assert run("synthesize", "racks", "--json").json["status"] == "found"


def test_neither_is_an_answer_too(run: Run, tmp_path: Path) -> None:
    ambiguous(tmp_path)
    told = run("synthesize", "racks", "--json", "--answers", answers({"question": "1:rack2.obj", "choice": None}))
    assert told.json["question"]["id"] == "1:rack3.obj"
    assert run("synthesize", "racks", "--list-answers").out == "1:rack2.obj  neither of the choices\n"


def test_a_dry_run_keeps_nothing(run: Run, tmp_path: Path) -> None:
    project = ambiguous(tmp_path)
    told = run("synthesize", "racks", "--dry-run", "--answers", answers({"question": "1:rack2.obj", "choice": 2}))
    assert told.out == f"{LABELS}Geo(Is(board), +Z) => Delete\n"
    assert timeless(told.err).splitlines()[1:] == [
        "learned in TIME with 1 answer",
        "all believable readings of the rules agree on your 30 assets",
    ]
    assert project.program() is None and not project.feedback().answers_and_fixes


@pytest.mark.parametrize(
    ("entries", "problem"),
    [
        ([{"question": "1:rack3.obj", "choice": 1}], "the question 1:rack3.obj did not come up"),
        ([{"question": "1:rack2.obj", "choice": 4}], "1:rack2.obj has 3 choices, there is no choice 4"),
        ([{"question": "1:rack2.obj", "choice": 0}], "answer 1: the choice 0 is no number from 1"),
        ([{"question": "rack2.obj", "choice": 1}], "answer 1: 'rack2.obj' is no question"),
        ([{"question": "1:rack99.obj", "choice": 1}], "there is no asset 'rack99.obj'"),
        ([{"rule": 2, "asset": "rack2.obj", "select": []}], "there is no rule 2 to answer for"),
        ([{"rule": 1, "asset": "rack2.obj"}], "answer 1: it has no field 'select'"),
        ([{"rule": "1", "asset": "rack2.obj", "select": []}], "answer 1: the field 'rule' cannot be '1'"),
        ([{"question": "1:rack2.obj", "choice": "a"}], "answer 1: the field 'choice' cannot be 'a'"),
        ([{"question": "1:rack2.obj", "choice": 1, "by": 2}], "answer 1: it has a field 'by', which is none of"),
        ([7], "answer 1: it is no object"),
        ([{"rule": 1, "asset": "rack2.obj", "select": [3]}], "answer 1: its hulls are not all names"),
        ("no list", "this is no list of answers"),
    ],
)
def test_an_answer_that_cannot_be_is_named(run: Run, tmp_path: Path, entries: Any, problem: str) -> None:
    ambiguous(tmp_path)
    Path("given.json").write_text(json.dumps(entries))
    told = run("synthesize", "racks", "--answers", "given.json")
    assert told.code == 2
    assert problem in told.err.rpartition("error: ")[2]


def test_repairs_are_proposed_with_the_program_they_lead_to(run: Run, tmp_path: Path) -> None:
    project = mislabelled(tmp_path)
    told = run("synthesize", "racks")
    assert (told.code, told.err) == (1, "")
    lines = told.out.splitlines()
    assert lines[:2] == ["no program yet: 1 label may be wrong", "  knob of rack0.obj: leg -> knob  (99 % sure)"]
    assert "Is(knob) selects what was shown" in lines[2]
    assert lines[3:] == [
        "With that, the program is:",
        "  Is(knob) => Delete",
        "To look at each: meshforge synthesize racks in a terminal; "
        "to repair all: meshforge synthesize racks --accept-repairs",
        "To keep the labels as they are: meshforge synthesize racks --reject-repairs",
    ]
    assert project.mesh(PLAIN).hull_of("knob").label == "leg"


def test_repairs_are_accepted_listed_and_taken_back(run: Run, tmp_path: Path) -> None:
    project = mislabelled(tmp_path)
    told = run("synthesize", "racks", "--accept-repairs")
    assert (told.code, told.out) == (0, f"{LABELS}Is(knob) => Delete\n")
    assert (
        timeless(told.err)
        == """repaired: knob of rack0.obj: leg -> knob

learned in TIME with 1 repaired label, kept as racks/program.mf
all believable readings of the rules agree on your 7 assets
Next: meshforge apply racks
"""
    )
    listed = run("synthesize", "racks", "--list-answers")
    assert listed.out == "rack0.obj#knob=knob  repaired, was leg\n"
    assert listed.err == "To take one back: meshforge synthesize racks --forget 'rack0.obj#knob=knob'\n"
    assert run("synthesize", "racks", "--list-answers", "--json").json["confirmed"][0]["from"] == "leg"
    assert run("synthesize", "racks", "--forget", "rack0.obj#knob=knob").out == "taken back: rack0.obj#knob=knob\n"
    assert project.mesh(PLAIN).hull_of("knob").label == "leg"
    assert run("synthesize", "racks", "--list-answers").err == "nothing was answered, repaired or refused yet\n"


def test_repairs_are_rejected_until_all_is_forgotten(run: Run, tmp_path: Path) -> None:
    project = mislabelled(tmp_path)
    assert "left as it is: knob of rack0.obj: leg -> knob" in run("synthesize", "racks", "--reject-repairs").err
    assert run("synthesize", "racks", "--json").json["repairs"] == []
    assert run("synthesize", "racks", "--list-answers").out == "rack0.obj#knob=knob  refused, stays leg\n"
    assert run("synthesize", "racks", "--forget", "all").out == "taken back: 1 answer or repair\n"
    assert run("synthesize", "racks", "--json").json["status"] == "repair"
    assert run("synthesize", "racks", "--json", "--no-repair").json["status"] != "repair"
    assert project.mesh(PLAIN).hull_of("knob").label == "leg"


def test_repairs_are_either_accepted_or_rejected(run: Run, tmp_path: Path) -> None:
    mislabelled(tmp_path)
    told = run("synthesize", "racks", "--accept-repairs", "--reject-repairs")
    assert (told.code, told.err) == (2, "error: --accept-repairs and --reject-repairs exclude each other\n")


def test_an_answer_that_no_longer_fits_is_named_with_the_way_to_drop_it(run: Run, tmp_path: Path) -> None:
    ambiguous(tmp_path)
    run("synthesize", "racks", "--answers", answers({"rule": 1, "asset": "rack6.obj", "select": ["top"]}))
    (tmp_path / "assets" / "rack6.obj").unlink()
    told = run("synthesize", "racks")
    assert told.code == 0
    assert told.err.splitlines()[1:3] == [
        "the answer 1:rack6.obj no longer fits what is there, and is left out",
        "  to take it back: meshforge synthesize racks --forget 1:rack6.obj",
    ]


def test_no_program_says_what_would_help(run: Run, tmp_path: Path) -> None:
    project = racks(tmp_path, 3)
    project.demonstrate(PLAIN, [Step(1, {"knob"}, Delete()), Step(2, {"left", "right"}, Delete())])
    project.demonstrate(OTHER, [Step(1, {"knob"}, Delete()), Step(2, {"left"}, Delete())])
    told = run("synthesize", "racks", "--no-repair", "--layers", "S")
    assert told.code == 1
    lines = told.out.splitlines()
    assert lines[0].startswith("no program found: ")
    assert lines[1:4] == [
        "  learned: Is(knob) => Delete",
        "nearest for rule 2: Is(leg); on rack1.obj it",
        "  selects too much: right",
    ]
    assert any(line.startswith("- ") for line in lines[4:])


def test_another_orientation_is_suggested_as_one_writes_it(run: Run, tmp_path: Path) -> None:
    project = _turned(tmp_path)
    told = run("synthesize", "racks", "--layers", "S+G", "--no-repair")
    assert told.code == 1
    line = next(line for line in told.out.splitlines() if "meshforge.toml" in line)
    text = line.partition("write: ")[2]
    toml = project.folder / "meshforge.toml"
    toml.write_text(re.sub(r"(?m)^orient = .*$", lambda _: text, toml.read_text()))
    assert run("synthesize", "racks", "--layers", "S+G").code == 0


def _turned(folder: Path) -> Project:
    """Racks of which one stands the other way round, and demonstrations of their right legs."""
    project = racks(folder, 3)
    path = folder / "assets" / OTHER
    rows = [line.split() for line in path.read_text().splitlines()]
    turned = [["v", str(-float(row[1])), str(-float(row[2])), row[3]] if row[0] == "v" else row for row in rows]
    path.write_text("\n".join(" ".join(row) for row in turned) + "\n")
    for asset in (PLAIN, OTHER, SHELVED):
        project.demonstrate(asset, [Step(1, {"right"}, Delete())])
    return project


def test_the_first_interrupt_stops_the_search_and_tells_what_was_found(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    mislabelled(tmp_path)
    learn = synthesis.synthesize

    def interrupted(*demos: Any, **options: Any) -> Any:
        os.kill(os.getpid(), signal.SIGINT)
        return learn(*demos, **options)

    monkeypatch.setattr(synthesis, "synthesize", interrupted)
    told = run("synthesize", "racks")
    assert told.code == 1
    assert told.out.startswith("stopped while rule 1 was searched for\n")
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_the_second_interrupt_ends_the_program() -> None:
    with pytest.raises(KeyboardInterrupt), catch_interrupt() as stop:
        os.kill(os.getpid(), signal.SIGINT)
        assert stop()
        os.kill(os.getpid(), signal.SIGINT)
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_a_search_without_time_tells_how_to_give_it_more(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    mislabelled(tmp_path)
    learn = synthesis.synthesize

    def stopped(*given: Any, **more: Any) -> Any:
        return learn(*given, **more | {"options": replace(more["options"], stop=lambda: True)})

    monkeypatch.setattr(synthesis, "synthesize", stopped)
    told = run("synthesize", "racks", "--budget", "0.1")
    assert told.code == 1
    assert told.out.startswith("the time ran out while rule 1 was searched for; --budget SECONDS gives more\n")


def test_the_options_are_those_of_the_search() -> None:
    hints = get_type_hints(synthesize)
    assert get_args(hints["layers"]) == LAYERS and get_args(hints["strategy"]) == STRATEGIES
