import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.labels.vlm.answer import read_answer

WORDS = ("leg", "table top", "drawer_front", "Füße")
RIGHT = '{"hulls": {"0": "leg", "2": "table top"}}'
NOTHING = "the model said nothing usable of it"


def read(text: str, asked: tuple[int, ...] = (0, 2)) -> tuple[dict[int, str], dict[int, str]]:
    return read_answer(text, asked, (*WORDS, "unknown"))


@pytest.mark.parametrize(
    "text",
    [
        RIGHT,
        f"Here you are:\n```json\n{RIGHT}\n```\nTell me if you need more!",
        f'<think>It might be {{"hulls": {{"0": "drawer_front"}}}}, no.</think>{RIGHT}',
        f"Piece {{0}} stands on the floor [see picture 2], so: {RIGHT}",
        '{"0": "leg", "2": "table top"}',
        '{"hulls": {"0": "Leg", "#2": "Table_Top."}}',
        '{"hulls": {"2": "table-top", "0": "leg", "7": "x"}}',
        '{"hulls": {"0": "leg", "0": "leg", "2": "table top", "3": "la',
        '{"answer": {"hulls": {}}} {"hulls": {"0": "leg", "2": "table top"}}',
    ],
)
def test_all_that_says_the_same_is_read_the_same(text: str) -> None:
    assert read(text) == ({0: "leg", 2: "table top"}, {})


@pytest.mark.parametrize(
    ("text", "said", "left"),
    [
        ("", {}, {0: NOTHING, 2: NOTHING}),
        ("I cannot see any numbers.", {}, {0: NOTHING, 2: NOTHING}),
        ('{"hulls": {"0": "wheel", "2": "leg"}}', {2: "leg"}, {0: "the model said wheel, which is no label"}),
        (
            '{"hulls": {"0": "leg", "2": "leg", "0": "table top"}}',
            {2: "leg"},
            {0: "the model said leg, table top, which is no label"},
        ),
        ('{"hulls": {"0": "unknown", "2": "Unknown"}}', {0: "unknown", 2: "unknown"}, {}),
        ('{"hulls": {"0": null, "2": 7}}', {}, {0: NOTHING, 2: NOTHING}),
        ('{"hulls": {"1": "wheel", "0": "leg"}}', {0: "leg"}, {2: NOTHING}),
        ("[" * 100_000, {}, {0: NOTHING, 2: NOTHING}),
    ],
)
def test_what_is_not_said_clearly_is_left_open(text: str, said: object, left: object) -> None:
    assert read(text) == (said, left)


@given(text=st.text(alphabet=st.sampled_from('{}[]":, 02leg\\nunkwhs'), max_size=60) | st.text(max_size=60))
def test_whatever_is_said_each_number_is_said_of_or_left_open(text: str) -> None:
    labels, left = read(text)
    assert sorted([*labels, *left]) == [0, 2]
    assert all(label in (*WORDS, "unknown") for label in labels.values())


@given(
    said=st.dictionaries(st.integers(0, 30), st.sampled_from(WORDS), min_size=1),
    around=st.text(alphabet="abc .\n`", max_size=20),
    is_ascii=st.booleans(),
    share=st.floats(0, 1),
)
def test_an_answer_is_found_in_any_chatter_and_cut_it_never_says_another_label(
    said: dict[int, str], around: str, is_ascii: bool, share: float
) -> None:
    text = around + json.dumps({"hulls": said}, ensure_ascii=is_ascii) + around
    assert read(text, tuple(said)) == (said, {})
    assert read(text[: int(share * len(text))], tuple(said))[0].items() <= said.items()
