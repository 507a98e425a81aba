import json
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from io import BytesIO
from pathlib import Path
from typing import Any
from unittest.mock import patch

import numpy as np
import pytest
from PIL import Image

from meshforge.geometry import Box, Pose, Shape
from meshforge.labels.vlm.answer import VlmAnswers, ask_questions
from meshforge.labels.vlm.prompt import MeshHulls, PromptConfig, build_questions, example_messages
from meshforge.rendering import draw_labeling_pictures
from meshforge.store import VlmSettings
from meshforge.symbolic import Hull, Label, SymbolicMesh
from tests.loopback import CUT, Asked, Server, labels_as_json, serving, status
from tests.unit.labels.vlm.asking import client, key

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


Ask = Callable[..., VlmAnswers]


@contextmanager
def labelling(
    answer: Callable[[Asked], str], words: tuple[str, ...] = WORDS, examples: tuple[SymbolicMesh, ...] = (), **how: Any
) -> Iterator[tuple[Ask, Server]]:
    """What asks about all hulls of a mesh, with small pictures; how: fields of `Server`, and of the settings."""
    told = {name: how.pop(name) for name in ("fault", "schema", "delay") if name in how}
    with serving(answer, **told) as server:
        one = client(server, size=SMALL, **how)
        config = PromptConfig(words, one.endpoint.settings)
        shown = tuple(m for mesh in examples for m in example_messages("known", mesh, config))
        config = replace(config, examples=shown)

        def ask(mesh: SymbolicMesh, name: str = "") -> VlmAnswers:
            return ask_questions(one, config, build_questions([MeshHulls(name, mesh, [*mesh.index])], config))

        yield ask, server
        one.close()


def names(said: VlmAnswers) -> dict[str, str]:
    return {hull: label.name for own in said.labels.values() for hull, label in own.items() if hull not in left(said)}


def left(said: VlmAnswers) -> dict[str, str]:
    return {hull: why for own in said.open.values() for hull, why in own.items()}


def true_names(shown: SymbolicMesh) -> dict[str, str]:
    return dict(zip(shown.index, truth(shown).values(), strict=True))


def test_what_is_out_of_the_vocabulary_missing_or_cut_off_is_left_open_with_the_reason() -> None:
    shown = table()
    lying = labels_as_json({0: "wheel", 1: "leg", 3: "leg", 4: "leg", 99: "leg"})
    with labelling(lambda asked: lying) as (ask, server):
        said = ask(shown)
        assert names(said) == {"leg0": "leg", "leg2": "leg", "leg3": "leg"}
        nothing = "the model said nothing usable of it"
        assert left(said) == {"top": "the model said wheel, which is no label", "leg1": nothing, "crumb": nothing}
        assert len(server.answered) == 1
    with labelling(right(shown), fault=lambda asked: None if asked.is_probe else CUT) as (ask, server):
        said = ask(shown)
        assert set(left(said).values()) == {"the answer was cut off: raise room in [vlm]"}
        assert names(said).items() < true_names(shown).items()
        assert names(said).keys() | left(said).keys() == shown.index.keys()


def test_a_vocabulary_with_the_word_unknown_has_another_word_for_not_knowing() -> None:
    def unsure(asked: Asked) -> str:
        return labels_as_json({n: ("unknown", "cannot tell")[n % 2] for n in asked.numbers})

    with labelling(unsure, ("unknown", "leg")) as (ask, server):
        said = ask(table())
        assert len(server.answered) == 1
    assert set(names(said).values()) == {"unknown"}
    assert set(left(said).values()) == {"the model does not know"}


def test_no_picture_has_more_than_twelve_colours_and_one_question_all_hulls() -> None:
    shown = table(legs=30)
    with labelling(right(shown)) as (ask, server):
        said = ask(shown)
        assert names(said) == true_names(shown) and not said.open and not said.failed
        assert {(label.source, label.confidence) for label in said.labels[""].values()} == {("vlm", 0.71)}
        (asked,) = server.answered
        assert asked.numbers == tuple(range(32))
    with patch("meshforge.labels.vlm.prompt.draw_labeling_pictures", wraps=draw_labeling_pictures) as drawn:
        build_questions([MeshHulls("", shown, [*shown.index])], PromptConfig(WORDS, VlmSettings(size=SMALL)))
    assert [len(call.kwargs["hulls"]) for call in drawn.call_args_list] == [10, 11, 11]


def test_hulls_of_several_meshes_have_numbers_of_their_own_and_the_object_stands_beside() -> None:
    meshes = [MeshHulls(name, table(), ["leg1", "crumb"]) for name in ("a", "b", "c")]
    (one,) = build_questions(meshes, PromptConfig(WORDS, VlmSettings(size=SMALL)))
    assert one.hulls == dict(enumerate((name, hull) for name in "abc" for hull in ("leg1", "crumb")))
    assert "This is object 2.\nPicture:" in one.question.text
    assert "2: size 4 x 30 x 91, at 16, 19, 45; touches 1 without number\n3: size" in one.question.text
    sizes = [Image.open(BytesIO(picture)).size for picture in one.question.pictures]
    assert sum(width > 2 * SMALL for width, _ in sizes) == 3 and sizes.count((SMALL, SMALL)) == len(sizes) - 3


@pytest.mark.slow
def test_a_question_without_answer_leaves_its_hulls_open_and_the_others_are_labelled() -> None:
    shown = table(legs=130)

    def fault(asked: Asked) -> Any:
        return status(500, "out of order") if 65 in asked.numbers and not asked.is_probe else None

    with labelling(right(shown), retries=1, fault=fault) as (ask, _):
        said = ask(shown)
        assert names(said).keys() | left(said).keys() == shown.index.keys()
        assert set(left(said).values()) == {"the question got no answer"}
        assert 0 < len(names(said)) < 132
        (complaint,) = said.failed
        assert "no answer: 500: out of order" in complaint


def test_examples_are_shown_with_their_answers() -> None:
    shown = table()
    known: Mapping[str, Label] = {name: Label(label) for name, label in true_names(shown).items() if name != "leg0"}
    with labelling(right(table(legs=5)), examples=(shown.with_labels(known),)) as (ask, server):
        ask(table(legs=5))
        messages = server.answered[0].body["messages"]
        assert [message["role"] for message in messages] == ["system", "user", "assistant", "user"]
        rows = json.loads(messages[2]["content"])
        assert rows["parts"] == ["top", "leg", "crumb"]
        assert rows["hulls"] == {"0": "top", "2": "leg", "3": "leg", "4": "leg", "5": "crumb"}
        assert "belong to: 0, 2, 3, 4, 5?" in server.answered[0].text
        assert server.answered[0].numbers == tuple(range(7))


def test_names_are_told_only_when_that_is_wanted() -> None:
    shown = table()
    for told in (False, True):
        with labelling(right(shown), names=told) as (ask, server):
            ask(shown, "tables/oak.obj")
            (asked,) = server.answered
            assert ("oak" in asked.text) == told
            assert ("leg3" in asked.text) == told


def test_the_words_of_a_question_are_as_agreed() -> None:
    manner: dict[str, Any] = {"about": "tables of a café.", "descriptions": {"crumb": "lies  about\nuselessly."}}
    shown = table()
    with labelling(right(shown), **manner) as (ask, server):
        ask(shown)
        text = server.answered[0].text
        form = server.answered[0].schema
    assert text + "\n" == (Path(__file__).parent / "question.txt").read_text(encoding="utf-8")
    assert form is not None
    assert [*form["properties"]] == ["object", "parts", "hulls"]
    assert form["properties"]["hulls"]["required"] == [str(number) for number in range(6)]
    assert form["$defs"]["label"]["enum"] == [*WORDS, "unknown"]
