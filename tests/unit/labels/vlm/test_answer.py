from __future__ import annotations

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.labels.vlm.answer import HullAnswer, read_answer

WORDS = ("leg", "table top", "drawer_front", "Füße")
RIGHT = '{"hulls": [{"number": 0, "label": "leg"}, {"number": 2, "label": "table top"}]}'
ANSWERS = {0: "leg", 2: "table top"}


def read(text: str, asked: tuple[int, ...] = (0, 2)) -> HullAnswer:
    return read_answer(text, asked, (*WORDS, "unknown"))


@pytest.mark.parametrize(
    "text",
    [
        RIGHT,
        f"Here you are:\n```json\n{RIGHT}\n```\nTell me if you need more!",
        f"```\n{RIGHT}```",
        f'<think>It might be {{"hulls": [{{"number": 0, "label": "drawer_front"}}]}}, no.</think>{RIGHT}',
        f"Piece {{0}} stands on the floor [see picture 2], so: {RIGHT}",
        json.dumps(json.loads(RIGHT)["hulls"]),
        '{"0": "leg", "2": "table top"}',
        '{"hulls": {"0": "leg", "#2": "table top"}}',
        '{"hulls": [{"number": "0", "label": "Leg"}, {"number": 2.0, "label": "Table_Top."}]}',
        '{"hulls": [{"number": 0, "label": "leg", "why": "it is long"}, {"number": 2, "label": "table-top"}]}',
        '{"hulls": [{"label": "leg", "number": 0}, {"label": "table top", "number": 2}, {"number": 7, "label": "x"}]}',
        '[{"number": 0, "label": "leg"}, {"number": 0, "label": "leg"}, {"number": 2, "label": "table top"}]',
        '{"hulls": [{"number": 0, "label": "leg"}, {"number": 2, "label": "table top"}, {"number": 3, "la',
        '{"answer": {"hulls": []}} {"hulls": [{"number": 0, "label": "leg"}, {"number": 2, "label": "table top"}]',
    ],
)
def test_all_that_says_the_same_is_read_the_same(text: str) -> None:
    assert read(text) == HullAnswer(ANSWERS, (), ())


@pytest.mark.parametrize(
    ("text", "said", "odd", "left"),
    [
        ("", {}, (), (0, 2)),
        ("I cannot see any numbers.", {}, (), (0, 2)),
        ('{"hulls": []}', {}, (), (0, 2)),
        ('{"hulls": [{"number": 0, "label": "wheel"}, {"number": 2, "label": "leg"}]}', {2: "leg"}, ("wheel",), (0,)),
        ('{"hulls": [{"0": "leg"}, {"2": "leg"}, {"0": "table top"}]}', {2: "leg"}, (), (0,)),
        (
            '{"hulls": [{"number": 0, "label": "unknown"}, {"number": 2, "label": "Unknown"}]}',
            {0: "unknown", 2: "unknown"},
            (),
            (),
        ),
        ('{"hulls": [{"number": 0, "label": null}, {"number": true, "label": "leg"}]}', {}, (), (0, 2)),
        ('{"hulls": [{"number": 1, "label": "wheel"}, {"number": 0, "label": "leg"}]}', {0: "leg"}, (), (2,)),
        ('{"hulls": [{"number": 1e999, "label": "leg"}, {"number": NaN, "label": "leg"}]}', {}, (), (0, 2)),
        ("[" * 100_000, {}, (), (0, 2)),
        ('{"hulls": "leg"}', {}, (), (0, 2)),
    ],
)
def test_what_is_not_said_clearly_is_left_open(text: str, said: object, odd: object, left: object) -> None:
    assert read(text) == HullAnswer(said, odd, left)  # type: ignore[arg-type]


def test_words_that_are_no_labels_are_told() -> None:
    assert read('{"0": "wheel", "2": "hub"}').problem == "the model said wheel, hub, which is no label"
    assert read("").problem == "the model said nothing usable of it"
    assert read(RIGHT).problem == ""


@given(text=st.text(alphabet=st.sampled_from('{}[]":, 02leg\\nunkwhs'), max_size=60) | st.text(max_size=60))
def test_whatever_is_said_each_number_is_said_of_or_left_open(text: str) -> None:
    answer = read(text)
    assert set(answer.labels).isdisjoint(answer.open)
    assert set(answer.labels) | set(answer.open) == {0, 2}
    assert all(label in (*WORDS, "unknown") for label in answer.labels.values())


@given(
    said=st.dictionaries(st.integers(0, 30), st.sampled_from(WORDS), min_size=1),
    before=st.text(alphabet="abc .\n`", max_size=20),
    after=st.text(alphabet="abc .\n`", max_size=20),
)
def test_an_answer_is_found_in_any_chatter(said: dict[int, str], before: str, after: str) -> None:
    rows = [{"number": number, "label": label} for number, label in said.items()]
    answer = read(before + json.dumps({"hulls": rows}) + after, tuple(said))
    assert answer.labels == said


@given(said=st.dictionaries(st.integers(0, 30), st.sampled_from(WORDS), min_size=1), share=st.floats(0, 1))
def test_a_cut_answer_never_says_another_label(said: dict[int, str], share: float) -> None:
    text = json.dumps({"hulls": [{"number": number, "label": label} for number, label in said.items()]})
    answer = read(text[: int(share * len(text))], tuple(said))
    assert answer.labels.items() <= said.items()
