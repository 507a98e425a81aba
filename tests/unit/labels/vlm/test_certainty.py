from __future__ import annotations

import itertools

import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.labels.vlm.answer import Chances, label_chances, read_answer
from meshforge.labels.vlm.transport import Reply, Token

WORDS = ("leg", "ledge", "panel", "Füße")


def tokens(*rows: tuple[str, float]) -> tuple[Token, ...]:
    return tuple(Token(text.encode(), chance) for text, chance in rows)


def told(rows: tuple[Token, ...], text: str | None = None) -> dict[int, Chances]:
    text = b"".join(row.text for row in rows).decode() if text is None else text
    answer = read_answer(text, (3,), WORDS, "unknown")
    return label_chances(Reply(text, tokens=rows), answer, WORDS, "unknown")


def test_a_label_has_the_product_of_its_tokens_and_others_share_the_rest() -> None:
    rows = tokens(('{"hulls": [{"number": 3, "label":', 1.0), (' "le', 0.8), ("g", 0.5), ('"}]}', 1.0))
    found = told(rows)[3]
    assert found["leg"] == pytest.approx(0.4)
    assert found["panel"] == found["ledge"] == pytest.approx(0.6 / 4)
    assert sum(found.values()) == pytest.approx(1)
    assert set(found) == {*WORDS, None}


def test_thoughts_before_the_answer_do_not_disturb() -> None:
    answer = '{"hulls": [{"number": 3, "label": "leg"}]}'
    rows = tokens(
        ("<think>3 is a leg</think>", 0.1),
        (answer.partition("leg")[0], 1.0),
        ("leg", 0.9),
        ('"}]}', 1.0),
    )
    assert told(rows, answer)[3]["leg"] == pytest.approx(0.9)


def test_labels_that_are_not_ascii_are_found_though_tokens_cut_their_characters() -> None:
    raw = '{"hulls": [{"number": 3, "label": "Füße"}]}'.encode()
    rows = tuple(Token(raw[k : k + 1], 0.99) for k in range(len(raw)))
    found = label_chances(
        Reply(raw.decode(), tokens=rows), read_answer(raw.decode(), (3,), WORDS, "unknown"), WORDS, "unknown"
    )
    assert found[3]["Füße"] == pytest.approx(0.99 ** len("Füße".encode()))


@pytest.mark.parametrize(
    ("text", "rows"),
    [
        ("{}", None),
        ('{"hulls": [{"number": 3, "label": "leg"}]}', tokens(("something else", 1.0))),
        ('{"3": "leg"}', tokens(('{"3": "leg"}', 1.0))),
        ('{"hulls": [{"number": 3, "label": "LEG"}]}', tokens(('{"hulls": [{"number": 3, "label": "LEG"}]}', 1.0))),
    ],
)
def test_where_the_chances_cannot_be_matched_none_are_told(text: str, rows: tuple[Token, ...] | None) -> None:
    answer = read_answer(text, (3,), WORDS, "unknown")
    assert label_chances(Reply(text, tokens=rows), answer, WORDS, "unknown") == {}


@given(
    label=st.sampled_from([*WORDS, "unknown"]),
    cuts=st.sets(st.integers(1, 60)),
    chance=st.floats(0, 1),
)
def test_chances_sum_up_to_one_however_the_tokens_are_cut(label: str, cuts: set[int], chance: float) -> None:
    raw = f'{{"hulls": [{{"number": 3, "label": "{label}"}}]}}'.encode()
    places = [0, *sorted(cut for cut in cuts if cut < len(raw)), len(raw)]
    pieces = [raw[a:b] for a, b in itertools.pairwise(places)]
    rows = tuple(Token(piece, chance) for piece in pieces)
    found = label_chances(
        Reply(raw.decode(), tokens=rows), read_answer(raw.decode(), (3,), WORDS, "unknown"), WORDS, "unknown"
    )
    assert sum(found[3].values()) == pytest.approx(1)
    assert all(0 <= value <= 1 for value in found[3].values())
