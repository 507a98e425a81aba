from __future__ import annotations

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from meshforge.labels.vlm.answer import LabelVote, clearness, decide_label

WORDS = ("leg", "panel", "drawer")
VOTES = st.lists(st.builds(LabelVote, st.sampled_from([*WORDS, None]), st.floats(0.01, 1)), min_size=1, max_size=8)


def test_votes_that_agree_make_a_label_surer() -> None:
    found = [decide_label([LabelVote("leg", 1.0)] * count, WORDS) for count in (1, 2, 5)]
    assert found == [("leg", 0.7143), ("leg", 0.8333), ("leg", 0.9259)]
    assert decide_label([LabelVote("leg", 1.0), LabelVote("leg", 1.0), LabelVote("panel", 1.0)], WORDS) == (
        "leg",
        0.5882,
    )


def test_a_hull_that_was_hardly_seen_is_unsure() -> None:
    found = decide_label([LabelVote("leg", clearness(30, 1024))], WORDS)
    assert found and found[0] == "leg" and found[1] < 0.25
    assert clearness(30, 512) == clearness(120, 1024)
    assert clearness(0, 1024) == 0
    assert clearness(300, 1024) == 0.5


def test_where_unknown_has_most_there_is_no_label() -> None:
    assert decide_label([LabelVote(None, 1.0), LabelVote("leg", 0.9)], WORDS) is None
    assert decide_label([LabelVote(None, 0.9), LabelVote("leg", 1.0)], WORDS) == ("leg", 0.4348)
    assert decide_label([], WORDS) is None


def test_chances_count_more_than_the_word() -> None:
    sure = LabelVote("leg", 1.0, {"leg": 0.95, "panel": 0.05})
    torn = LabelVote("leg", 1.0, {"leg": 0.5, "panel": 0.45, None: 0.05})
    assert decide_label([sure], WORDS) == ("leg", 0.8636)
    assert decide_label([torn], WORDS) == ("leg", 0.4545)
    assert decide_label([torn, LabelVote("panel", 1.0, {"panel": 0.9, "leg": 0.1})], WORDS) == ("panel", 0.6429)


@given(votes=VOTES)
def test_the_order_of_votes_does_not_matter_and_confidence_is_a_share(votes: list[LabelVote]) -> None:
    found = decide_label(votes, WORDS)
    back = decide_label(votes[::-1], WORDS)
    if found is None or back is None:
        assert found == back or abs(sum(v.weight for v in votes if v.label is None)) > 0
        return
    assert 0 < found[1] < 1
    assert found[1] == pytest.approx(back[1], abs=2e-4)


@given(votes=VOTES, weight=st.floats(0.01, 1))
def test_one_more_vote_for_the_winner_never_makes_it_less_sure(votes: list[LabelVote], weight: float) -> None:
    found = decide_label(votes, WORDS)
    assume(found is not None)
    assert found is not None
    more = decide_label([*votes, LabelVote(found[0], weight)], WORDS)
    assert more is not None
    assert more[0] == found[0]
    assert more[1] >= found[1] - 1e-4
