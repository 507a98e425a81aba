"""The one function that chooses what is sensible to do next, for the commands and the studio."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from meshforge.labels import LabelOffers
from meshforge.project import (
    AssetStatus,
    FamilyState,
    LastRun,
    NextStep,
    OpenQuestion,
    PropagationState,
    choose_next_step,
)
from meshforge.signoff import ResultStatus
from meshforge.symbolic import Label


def asset(name: str = "a", labels: str = "hh", **more: Any) -> AssetStatus:
    """An asset with a hull for each letter: h for a label by hand, m for one of a machine, u for an unsure one, - for
    none."""
    kinds = {"h": Label("leg", 1.0, "user"), "m": Label("leg", 0.9, "vlm"), "u": Label("leg", 0.1, "vlm"), "-": None}
    given = tuple(kinds[letter] for letter in labels)
    names = tuple(f"h{k}" for k in range(len(labels)))
    row = AssetStatus(name, len(labels), sum(map(bool, given)), names=names, labels=given)
    return replace(row, **more)


BARE, BEGUN, LABELLED = asset(labels="--"), asset(labels="h-"), asset()
SHOWN = replace(LABELLED, demonstrated=True)
DONE = replace(SHOWN, output="edited")
SURE = replace(DONE, result_status=ResultStatus(0.99, state="sure"))


def suggest_last(assets: Sequence[str]) -> str | None:
    return assets[-1] if len(assets) > 1 else None


def choose(*assets: AssetStatus, **more: Any) -> NextStep:
    state = FamilyState(Path("p"), assets, ("leg",), suggest_first=suggest_last)
    return choose_next_step(replace(state, **more))


FOUND = {"has_program": True, "last_run": LastRun("found")}


def test_the_steps_follow_one_another() -> None:
    assert choose(asset(labels="", sources=1)).kind == "decompose"
    assert choose(BARE, vocabulary=()).kind == "demonstrate"
    assert choose(BARE).kind == choose(BEGUN).kind == "label"
    assert choose(LABELLED).kind == "demonstrate"
    assert choose(SHOWN).kind == "learn"
    assert choose(SHOWN, **FOUND).kind == "apply"
    assert choose(DONE, **FOUND).kind == "review"
    assert choose(SURE, **FOUND).kind == "export"


def test_labels_that_are_there_already_are_taken_first() -> None:
    files, names = LabelOffers(files=("a", "b")), LabelOffers(names={"a": {"h": "leg"}})
    step = choose(BARE, replace(BARE, id="b"), vocabulary=(), find_offers=lambda: files)
    assert step.text == "Labels files lie beside 2 assets: label all hulls."
    assert (step.kind, step.command) == ("label-all", "meshforge label p")
    step = choose(BARE, find_offers=lambda: names)
    assert step.text == "The names of 1 hull contain a label: label all hulls."
    assert choose(SHOWN, find_offers=lambda: files).kind == "learn"
    assert choose(BARE, find_offers=lambda: files, has_program=True).kind == "apply", "it asks for no labels"
    assert choose(BARE, find_offers=lambda: files, has_program=True, asks_labels=True).kind == "label-all"


def test_the_step_names_the_asset_to_go_to() -> None:
    assert choose(BARE, replace(BEGUN, id="b")).asset == "b"
    step = choose(SHOWN, has_program=True, last_run=LastRun("repair", repairs=2))
    assert (step.kind, step.text) == ("answer", "2 labels may be wrong: answer the question.")
    wrong = replace(DONE, id="d", review="wrong")
    assert choose(DONE, wrong, **FOUND).asset == "d"
    assert choose(DONE, **FOUND).asset == "a"


def test_a_run_without_a_program_leads_to_what_came_nearest() -> None:
    step = choose(SHOWN, last_run=LastRun("none", nearest=(2, "b")))
    assert (step.kind, step.asset) == ("learn", "b")
    assert step.text == "No selection fits rule 2 yet: see what comes nearest."
    texts = {choose(SHOWN, last_run=LastRun(status)).text for status in ("none", "timeout", "error")}
    assert len(texts) == 3


def test_a_program_that_cannot_be_applied_is_fixed_before_anything_else_is_done_with_it() -> None:
    step = choose(SHOWN, problem="no template knob.obj\n  more", has_program=True, outdated=True)
    assert (step.kind, step.text) == ("fix-program", "The program cannot be applied: no template knob.obj")
    assert choose(BARE, problem="does not parse").kind == "fix-program"


def test_labels_are_propagated_from_an_asset_that_people_or_files_labelled_as_a_whole() -> None:
    whole = asset("w")
    step = choose(BARE, whole)
    assert (step.kind, step.text) == ("label-all", "a has no label: label all hulls.")
    assert choose(BARE, replace(BARE, id="b"), whole).text.startswith("2 assets have no label")
    assert choose(BARE, replace(BEGUN, id="b")).kind == "label", "none is whole"
    assert choose(BARE, asset("w", "hm")).kind == "label", "a machine labelled it"


def test_hulls_without_a_label_are_labelled_before_anything_is_demonstrated() -> None:
    most, rest = asset("c1", "h" * 30 + "-" * 70), asset("c2", "h" * 11 + "-" * 25)
    step = choose(most, rest)
    assert (step.kind, step.asset) == ("label", "c2")
    assert step.text == "95 of 136 hulls have no label: label those of c2."
    assert step.command == "meshforge label p c2 'h11=LABEL'"
    assert choose(most, rest, asset("w")).text == "95 of 138 hulls have no label: label all hulls."
    assert choose(most, rest, asset("w"), propagation=PropagationState(0)).asset == "c2", "propagation left them"
    assert choose(most, replace(rest, demonstrated=True)).kind == "learn", "who went on is let go on"
    assert choose(BEGUN).text == "1 of 2 hulls has no label: label those of a."


def test_the_sentence_stays_while_it_is_being_learned_what_is_next_and_nothing_is_applied_meanwhile() -> None:
    asked = choose(*rows(0.1, 0.4), question=OpenQuestion("other", "b"), **FOUND)
    busy = {"is_judged": False, **FOUND}
    assert choose(SHOWN, **busy).text == "The program is being learned."
    assert choose(*rows(0.1, 0.4), shown=asked, **busy) == asked
    for stale in (choose(SHOWN, **FOUND), choose(*rows(0.99, 0.98), **FOUND)):
        assert (stale.kind, choose(SHOWN, shown=stale, **busy).kind) in (("apply", "learn"), ("export", "learn"))
    assert choose(SHOWN, problem="no template", shown=asked, **busy).kind == "fix-program"


def test_what_is_being_done_is_said_in_place_of_what_to_do() -> None:
    bare = asset(labels="", sources=1)
    step = choose(bare, running={"decompose": "Decomposing 1 asset"})
    assert (step.kind, step.text) == ("decompose", "Decomposing 1 asset")
    assert choose(bare, running={"apply": "Applying"}) == choose(bare)


def test_after_the_first_rule_the_demonstration_goes_on_until_something_else_is_done() -> None:
    b, c = replace(LABELLED, id="b"), replace(LABELLED, id="c")
    asked = OpenQuestion("other", "b")
    more = {"has_replies": False, "question": asked, **FOUND}
    step = choose(SHOWN, b, c, **more)
    assert step.text == "Show the next step on a, or see what the program does on b."
    assert (step.kind, step.asset) == ("demonstrate", "b")
    assert choose(SHOWN, b, c, **more | {"has_replies": True}).kind == "answer"
    assert choose(SHOWN, replace(b, demonstrated=True), c, **more).kind == "answer"
    assert choose(DONE, b, **more).kind == "answer", "the program was applied"
    sure = ResultStatus(0.99, state="sure")
    assert choose(SHOWN, replace(b, result_status=sure), **more | {"question": None}).kind == "apply", (
        "all others are sure"
    )


def test_unsure_labels_are_checked_unless_something_else_is_less_work() -> None:
    whole, doubtful = asset("w"), asset("d", "muuum")
    step = choose(whole, doubtful)
    assert (step.kind, step.asset, step.text) == ("check-labels", "d", "3 labels are unsure: look at them, first on d.")
    assert choose(whole, doubtful, propagation=PropagationState(0, "d")).text == step.text, "to label it is more work"
    nearly = asset("n", "hhhhm")
    step = choose(whole, doubtful, nearly, propagation=PropagationState(0, "n"))
    assert (step.asset, step.text) == ("n", "3 labels are unsure: label n next.")
    step = choose(whole, doubtful, propagation=PropagationState(3))
    assert step.text == "3 labels of yours not used yet: label all hulls."
    assert choose(whole, doubtful, propagation=PropagationState(2)).kind == "check-labels"


def rows(*probabilities: float) -> list[AssetStatus]:
    return [
        replace(SURE, id=name, result_status=ResultStatus(p, state="sure" if p >= 0.95 else "needs review"))
        for name, p in zip("abcd", probabilities, strict=False)
    ]


@pytest.mark.parametrize(
    ("assets", "question", "step"),
    [
        (
            rows(0.99, 0.4),
            OpenQuestion("other", "b"),
            ("answer", "1 of 2 results needs review: answer the question.", "b"),
        ),
        (
            rows(0.1, 0.4),
            OpenQuestion("result", "b"),
            ("review", "2 of 2 results need review: look at one result, b.", "b"),
        ),
        (rows(0.6, 0.4, 0.99), None, ("review", "2 of 3 results need review: look at them, first b.", "b")),
        (rows(0.99, 0.98), None, ("export", "2 results signed off: check and export.", None)),
    ],
)
def test_nothing_is_exported_before_all_is_signed_off(
    assets: list[AssetStatus], question: OpenQuestion | None, step: tuple[str, str, str | None]
) -> None:
    found = choose(*assets, question=question, **FOUND)
    assert (found.kind, found.text, found.asset) == step


def test_what_is_asked_comes_before_results_are_written_and_what_is_flagged_before_the_end() -> None:
    asked = OpenQuestion("other", "a", " about rule 1 on a, or apply the program as it is")
    step = choose(SHOWN, question=asked, **FOUND)
    assert (
        step.text == "1 of 1 result needs review: answer the question about rule 1 on a, or apply the program as it is."
    )
    assert choose(SHOWN, **FOUND).text == "Apply the program: a is not up to date."
    flagged = replace(SURE, id="f", flags=("h1 is gone",))
    assert (choose(SURE, flagged, **FOUND).kind, choose(SURE, flagged, **FOUND).asset) == ("correct", "f")
