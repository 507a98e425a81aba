from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from meshforge.geometry import Box, Pose, Shape
from meshforge.labels.vlm.mesh_asker import MeshAsker, VlmAnswers
from meshforge.labels.vlm.prompt import MODES, ModeName, PromptConfig, build_questions
from meshforge.symbolic import Hull, Label, SymbolicMesh
from tests.loopback import CUT, Asked, Server, labels_as_json, serving, status
from tests.unit.labels.vlm.asking import begin, client, key

__all__ = ["key"]
pytestmark = pytest.mark.usefixtures("key")
WORDS = ("top", "leg", "crumb")
SMALL = 256


def box(x: float, y: float, z: float, *half: float) -> Shape:
    return Box(Pose.of_translation([x, y, z]), np.array(half))


def mesh(**shapes: Shape) -> SymbolicMesh:
    return SymbolicMesh(tuple(Hull(name, "body", shape) for name, shape in shapes.items()))


def table(legs: int = 4) -> SymbolicMesh:
    """A top on legs in a row, and a crumb beside it."""
    feet = {f"leg{k}": box(0.3 * k, 0, 0.5, 0.05, 0.4, 0.5) for k in range(legs)}
    return mesh(top=box(0.15 * legs, 0, 1.05, 0.16 * legs, 0.5, 0.05), **feet, crumb=box(2, 2, 0.2, 0.2, 0.2, 0.2))


def truth(shown: SymbolicMesh) -> dict[int, str]:
    return {k: hull.name.rstrip("0123456789") for k, hull in enumerate(shown.hulls)}


def right(shown: SymbolicMesh) -> Callable[[Asked], str]:
    """A model that knows it all."""
    known = truth(shown)
    return lambda asked: labels_as_json({number: known[number] for number in asked.numbers})


@contextmanager
def labelling(
    answer: Callable[[Asked], str], mode: ModeName = "cheap", folder: Path | None = None, **how: Any
) -> Iterator[tuple[MeshAsker, Server]]:
    """A labeller with small pictures; how: fields of `Server` and of the settings, as they are called."""
    told = {name: how.pop(name) for name in ("fault", "schema", "delay") if name in how}
    examples = how.pop("examples", ())
    with serving(answer, **told) as server:
        one = client(server, folder, mode=mode, size=SMALL, **how)
        labeller = MeshAsker(one, PromptConfig(WORDS, one.endpoint.settings), examples)
        yield labeller, server
        labeller.close()
        one.close()


def names(said: VlmAnswers) -> dict[str, str]:
    return {hull: label.name for hull, label in said.labels.items()}


def true_names(shown: SymbolicMesh) -> dict[str, str]:
    return dict(zip(shown.index, truth(shown).values(), strict=True))


def test_a_right_model_labels_all_and_surer_with_more_looks_and_repeats() -> None:
    shown = table()
    sure: dict[str, float] = {}
    for mode, repeats in (("cheap", 1), ("balanced", 1), ("exact", 1), ("cheap", 5)):
        with labelling(right(shown), mode, repeats=repeats) as (labeller, server):  # type: ignore[arg-type]
            said = begin(labeller, shown).result()
        assert names(said) == true_names(shown)
        assert (said.open, said.failed) == ({}, ())
        assert {label.source for label in said.labels.values()} == {"vlm"}
        assert all(0.3 < label.confidence < 1 for label in said.labels.values())
        assert (
            len(said.asked) == len(server.answered) == repeats * {"cheap": 1, "balanced": 2}.get(mode, len(said.asked))
        )
        assert max(len(asked.numbers) for asked in server.answered) <= MODES[mode].hulls  # type: ignore[index]
        sure[f"{mode} {repeats}"] = min(label.confidence for label in said.labels.values())
    assert sure["cheap 1"] < sure["balanced 1"] <= sure["exact 1"]
    assert sure["cheap 1"] < sure["cheap 5"]


def test_repeats_that_disagree_make_less_sure() -> None:
    shown = table()
    with labelling(right(shown), repeats=3) as (labeller, _):
        agreed = begin(labeller, shown).result()

    def torn(asked: Asked) -> str:
        known = truth(shown)
        others = {n: known[n] if "- top\n- leg" in asked.text else "leg" for n in asked.numbers}
        return labels_as_json(others)

    with labelling(torn, repeats=3) as (labeller, server):
        said = begin(labeller, shown).result()
        assert len({asked.raw for asked in server.answered}) == 3  # the order of the labels turns
    assert said.labels["top"].confidence < agreed.labels["top"].confidence
    assert said.labels["leg0"] == agreed.labels["leg0"]


def test_what_is_out_of_the_vocabulary_or_missing_is_asked_once_more() -> None:
    shown = table()

    def lying(asked: Asked) -> str:
        if asked.is_again:
            assert asked.numbers == (0, 2, 5)
            assert '("wheel" is no label)' in asked.text
            return labels_as_json({0: "top", 2: "leg", 5: "hub"})
        return labels_as_json({0: "wheel", 1: "leg", 3: "leg", 4: "leg", 99: "leg", 5: "wheel"})

    with labelling(lying) as (labeller, server):
        said = begin(labeller, shown).result()
        assert names(said) == {"top": "top", "leg0": "leg", "leg1": "leg", "leg2": "leg", "leg3": "leg"}
        assert said.open == {"crumb": "the model said hub, which is no label"}
        assert len(server.answered) == len(said.asked) == 2
        again = server.answered[1]
        assert [message["role"] for message in again.body["messages"]] == ["system", "user", "assistant", "user"]


@pytest.mark.parametrize(
    ("nonsense", "why"),
    [
        ("", "the model said nothing usable of it"),
        ("I am only a language model.", "the model said nothing usable of it"),
        (
            '{"hulls": [{"number": 0, "label": "leg"}, {"number": 0, "label": "top"}]}',
            "the model said nothing usable of it",
        ),
    ],
)
def test_a_model_that_says_nothing_usable_is_asked_twice_and_leaves_all_open(nonsense: str, why: str) -> None:
    shown = table()
    with labelling(lambda asked: nonsense) as (labeller, server):
        said = begin(labeller, shown).result()
        assert said.labels == {}
        assert said.open == dict.fromkeys(shown.index, why)
        assert len(server.answered) == 2


def test_an_answer_that_is_cut_off_is_used_as_far_as_it_goes_and_has_more_room_the_next_time() -> None:
    shown = table()
    with labelling(right(shown), fault=lambda asked: None if asked.is_probe or asked.is_again else CUT) as (
        labeller,
        server,
    ):
        said = begin(labeller, shown).result()
        assert names(said) == true_names(shown)
        first, second = server.answered
        assert second.body["max_tokens"] == 2 * first.body["max_tokens"]
        assert 0 < len(second.numbers) < len(first.numbers)
    with labelling(right(shown), fault=lambda asked: None if asked.is_probe else CUT) as (labeller, server):
        said = begin(labeller, shown).result()
        assert set(said.open.values()) == {"the answer was cut off"}
        assert said.labels.keys() | said.open.keys() == shown.index.keys()


def test_unknown_is_taken_for_an_answer() -> None:
    shown = table()

    def unsure(asked: Asked) -> str:
        return labels_as_json({n: "unknown" if n == 5 else truth(shown)[n] for n in asked.numbers})

    with labelling(unsure) as (labeller, server):
        said = begin(labeller, shown).result()
        assert said.open == {"crumb": "the model does not know"}
        assert len(server.answered) == 1


def test_a_vocabulary_with_the_word_unknown_has_another_word_for_not_knowing() -> None:
    shown = table()
    words = ("unknown", "leg")
    with serving(lambda asked: labels_as_json({n: ("unknown", "cannot tell")[n % 2] for n in asked.numbers})) as server:
        one = client(server, mode="cheap", size=SMALL)
        labeller = MeshAsker(one, PromptConfig(words, one.endpoint.settings))
        said = begin(labeller, shown).result()
        labeller.close()
    assert set(names(said).values()) == {"unknown"}
    assert set(said.open.values()) == {"the model does not know"}


def test_dense_meshes_are_asked_about_in_groups_of_few_marks() -> None:
    shown = table(legs=30)
    with labelling(right(shown), "balanced") as (labeller, server):
        said = begin(labeller, shown).result()
        assert names(said) == true_names(shown)
        assert max(len(asked.numbers) for asked in server.answered) <= MODES["balanced"].hulls
        assert {n for asked in server.answered for n in asked.numbers} == set(range(32))
        assert all(len(asked.pictures) <= 6 for asked in server.answered)


@pytest.mark.slow
def test_the_groups_do_not_change_when_some_hulls_have_a_label_by_then() -> None:
    shown = table(legs=30)
    with labelling(right(shown), "balanced") as (labeller, _):
        all_of_it = {look.question.digests: look for look in build_questions(shown, [*shown.index], labeller.config)}
        some = list(build_questions(shown, ["top", "leg29"], labeller.config))
        assert 0 < len(some) < len(all_of_it)
        assert all(look == all_of_it[look.question.digests] for look in some)
        assert not list(build_questions(shown, [], labeller.config))


@pytest.mark.slow
def test_the_answers_come_out_the_same_however_many_are_under_way(tmp_path: Path) -> None:
    shown = [table(legs) for legs in (2, 3, 9)]

    def by_numbers(asked: Asked) -> str:
        return labels_as_json({n: WORDS[(n + len(asked.pictures)) % 3] for n in asked.numbers})

    outcomes = []
    for concurrency in (1, 8):
        with labelling(by_numbers, "exact", concurrency=concurrency, delay=0.005) as (labeller, _):
            pending = [begin(labeller, one) for one in shown]
            outcomes.append([one.result().labels for one in reversed(pending)])
    assert outcomes[0] == outcomes[1]


@pytest.mark.slow
def test_a_question_without_answer_leaves_its_hulls_open_and_the_others_are_labelled() -> None:
    shown = table(legs=60)

    def fault(asked: Asked) -> Any:
        return status(500, "out of order") if 1 in asked.numbers and not asked.is_probe else None

    with labelling(right(shown), retries=1, fault=fault) as (labeller, _):
        said = begin(labeller, shown).result()
        assert said.labels.keys() | said.open.keys() == shown.index.keys()
        assert set(said.open.values()) == {"the question got no answer"}
        assert 0 < len(said.labels) < 62
        (complaint,) = said.failed
        assert "no answer after 2 attempts, the last: 500: out of order" in complaint


def test_examples_are_shown_with_their_answers() -> None:
    shown = table()
    known: Mapping[str, Label] = {name: Label(label) for name, label in true_names(shown).items() if name != "leg0"}
    example = shown.with_labels(known)
    with labelling(right(table(legs=5)), examples=[example]) as (labeller, server):
        begin(labeller, table(legs=5)).result()
        messages = server.answered[0].body["messages"]
        assert [message["role"] for message in messages] == ["system", "user", "assistant", "user"]
        assert messages[2]["content"] == labels_as_json({0: "top", 2: "leg", 3: "leg", 4: "leg", 5: "crumb"})
        assert "belong to: 0, 2, 3, 4, 5?" in server.answered[0].text
        assert server.answered[0].numbers == tuple(range(7))


def test_names_are_told_only_when_that_is_wanted() -> None:
    shown = table()
    for told in (False, True):
        with labelling(right(shown), names=told) as (labeller, server):
            begin(labeller, shown, name="tables/oak.obj").result()
            (asked,) = server.answered
            assert ("oak" in asked.text) == told
            assert ("leg3" in asked.text) == told


def test_the_words_of_a_question_are_as_agreed() -> None:
    manner: dict[str, Any] = {"about": "tables of a café.", "descriptions": {"crumb": "lies  about\nuselessly."}}
    shown = table()
    with labelling(right(shown), **manner) as (labeller, server):
        begin(labeller, shown).result()
        text = server.answered[0].text
        form = server.answered[0].schema
    assert text + "\n" == (Path(__file__).parent / "question.txt").read_text(encoding="utf-8")
    assert form is not None
    assert form["properties"]["hulls"]["items"]["properties"]["label"]["enum"] == [*WORDS, "unknown"]
