"""`meshforge synthesize`: what is printed where, how it is stopped, and what `review` does of its answers. What
learning results in as text: the assets to look at are one list."""

import json
import os
import re
import signal
from dataclasses import replace
from pathlib import Path
from typing import Any, get_args, get_type_hints

import pytest

from meshforge import synthesis
from meshforge.cli.synthesize import LearningContext, format_remarks, synthesize
from meshforge.cli.terminal import catch_interrupt
from meshforge.language import Delete, Program
from meshforge.project import Project
from meshforge.synthesis import LAYERS, Answer, Found, Step
from meshforge.synthesis.options import STRATEGIES
from tests.unit.cli.in_process import Run
from tests.unit.project.shelves import OTHER, PLAIN, SHELVED, ambiguous, mislabelled, racks

LABELS = "labels board, leg, knob\n\n"


def timeless(text: str) -> str:
    return re.sub(r"\d+\.\d\d s", "TIME", text)


def answers(*entries: object) -> str:
    Path("given.json").write_text(json.dumps(entries))
    return "given.json"


def test_a_rule_that_is_open_is_named_with_the_way_to_answer(run: Run, tmp_path: Path) -> None:
    ambiguous(tmp_path)
    told = run("synthesize", "racks")
    assert told.code == 0
    assert told.out == f"{LABELS}Is(board) => Delete\n"
    assert (
        timeless(told.err)
        == """
learned in TIME, kept as racks/program.mf
ambiguous: it is open what rule 1 does on rack2.obj
Next: meshforge review racks
"""
    )


def test_a_dry_run_keeps_nothing(run: Run, tmp_path: Path) -> None:
    project = ambiguous(tmp_path)
    told = run("synthesize", "racks", "--dry-run")
    assert told.out == f"{LABELS}Is(board) => Delete\n"
    assert timeless(told.err).splitlines()[1] == "learned in TIME"
    assert "Next" not in told.err and project.program() is None


def test_answers_are_listed_and_taken_back(run: Run, tmp_path: Path) -> None:
    project = ambiguous(tmp_path)
    project.add_answer(Answer(1, "rack2.obj", None, [["top"]]))
    listed = run("review", "racks", "--list-answers")
    assert listed.out == "1:rack2.obj  neither of the choices\n"
    assert listed.err == "To take one back: meshforge review racks --forget 1:rack2.obj\n"
    assert run("review", "racks", "--forget", "1:rack2.obj").out == "taken back: 1:rack2.obj\n"
    assert run("review", "racks", "--list-answers").err == "nothing was answered, repaired or refused yet\n"


def test_repairs_are_proposed_with_the_program_they_lead_to(run: Run, tmp_path: Path) -> None:
    project = mislabelled(tmp_path)
    told = run("synthesize", "racks")
    assert (told.code, told.err) == (1, "")
    lines = told.out.splitlines()
    assert lines[:2] == ["no program yet: 1 label may be wrong", "  knob of rack0.obj: leg -> knob  (99 % sure)"]
    assert "Is(knob) selects what was shown" in lines[2]
    assert lines[3:] == ["With that, the program is:", "  Is(knob) => Delete", "Next: meshforge review racks"]
    assert project.mesh(PLAIN).hull_of("knob").label == "leg"


def test_repairs_are_accepted_listed_and_taken_back(run: Run, tmp_path: Path) -> None:
    project = mislabelled(tmp_path)
    reply_to_repair(run, 0)
    told = run("synthesize", "racks")
    assert (told.code, told.out) == (0, f"{LABELS}Is(knob) => Delete\n")
    assert (
        timeless(told.err)
        == """
learned in TIME with 1 repaired label, kept as racks/program.mf
all believable readings of the rules agree on your 7 assets
Next: meshforge apply racks
"""
    )
    assert run("review", "racks", "--list-answers").out == "rack0.obj#knob=knob  repaired, was leg\n"
    assert run("review", "racks", "--list-answers", "--json").json["confirmed"][0]["from"] == "leg"
    assert run("review", "racks", "--forget", "rack0.obj#knob=knob").out == "taken back: rack0.obj#knob=knob\n"
    assert project.mesh(PLAIN).hull_of("knob").label == "leg"


def test_repairs_are_rejected_until_all_is_forgotten(run: Run, tmp_path: Path) -> None:
    mislabelled(tmp_path)
    reply_to_repair(run, 1)
    assert run("synthesize", "racks", "--json").json["repairs"] == []
    assert run("review", "racks", "--list-answers").out == "rack0.obj#knob=knob  refused, stays leg\n"
    assert run("review", "racks", "--forget", "all").out == "taken back: 1 answer or repair\n"
    assert run("synthesize", "racks", "--json").json["status"] == "repair"
    assert run("synthesize", "racks", "--json", "--no-repair").json["status"] != "repair"


def reply_to_repair(run: Run, choice: int) -> None:
    question = run("review", "racks", "--json").json["question"]
    assert question["kind"] == "repair", question
    run("review", "racks", "--answers", answers({"id": question["id"], "choice": choice}))


def test_an_answer_that_no_longer_fits_is_named_with_the_way_to_drop_it(run: Run, tmp_path: Path) -> None:
    ambiguous(tmp_path).add_answer(Answer(1, "rack6.obj", ["top"]))
    (tmp_path / "assets" / "rack6.obj").unlink()
    told = run("synthesize", "racks")
    assert told.code == 0
    assert told.err.splitlines()[1:3] == [
        "the answer 1:rack6.obj no longer fits what is there, and is left out",
        "  to take it back: meshforge review racks --forget 1:rack6.obj",
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


def test_the_first_interrupt_ends_the_search_with_its_find(
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


def test_a_search_without_time_says_how_to_get_more(run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
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


ABOUT = LearningContext(Path("p"), assets=9, in_use=9, readable=9)
FOUND = Found(
    rules=(), candidates=(), tried=(), seconds={}, program=Program(), unambiguous=False, overruled=("f.obj", "a.obj")
)


@pytest.mark.parametrize("unambiguous", [False, True])
def test_accepted_results_that_are_not_kept_are_named(unambiguous: bool) -> None:
    lines = format_remarks(replace(FOUND, unambiguous=unambiguous), ABOUT).splitlines()
    assert ("all believable readings of the rules agree on your 9 assets" in lines) == unambiguous
    why = "its result was accepted, which no program keeps that does what is demonstrated"
    assert lines[-3:] == [f"f.obj: {why}", f"a.obj: {why}", "Next: meshforge apply p"]
