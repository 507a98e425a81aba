"""Families that simulated people sign off: time only goes on, each act has its price, and what is right is counted."""

from __future__ import annotations

import json
from dataclasses import asdict

import pytest

from benchmark.assets import family
from benchmark.signoff.before import Before, teach_before
from benchmark.signoff.conditions import ERRS
from benchmark.signoff.judge import Judge
from benchmark.signoff.point import right_at
from benchmark.signoff.queue import BROKEN, DONE, Review, sign_off
from benchmark.signoff.tool import Tool, program_of
from benchmark.study import FLAT, TRUE, Bench
from benchmark.study.condition import PROPAGATED
from benchmark.study.keystrokes import APPROVAL, GLANCE, STROKE, price_group
from benchmark.tasks import task
from meshforge.signoff import Assessment, AssetConfidence, HullPlace, ReviewChoice, ReviewQuestion, ReviewState
from meshforge.signoff.question import ASIDE, RIGHT, WRONG
from meshforge.synthesis import LearningOutcome
from tests.unit.benchmark.conftest import few

GROUP = 3


class FakeTool(Tool):
    """Asks for a demonstration, about one group of hulls, then about each result in turn."""

    def review(self, state: ReviewState, outcome: LearningOutcome | None) -> Assessment:
        open_ones = [n for n in state.meshes if n not in {*state.accepted, *state.aside, *state.demos}]
        sure = {name: AssetConfidence(name, 0.5 if name in open_ones else 0.99) for name in state.meshes}
        looked_at = frozenset(state.accepted)
        if program_of(outcome) is None and state.demos:
            return Assessment(sure, looked_at=looked_at, aside=state.aside)
        return Assessment(sure, looked_at=looked_at, aside=state.aside, question=self.ask(state, open_ones))

    def ask(self, state: ReviewState, open_ones: list[str]) -> ReviewQuestion | None:
        first = next(iter(state.meshes))
        hulls = state.meshes[first].hulls[:GROUP]
        if not state.demos:
            return ReviewQuestion(f"show {first}", "demonstrate", "", 1.0, 1.0, first)
        if any(hull.source != "user" for hull in hulls):
            labels = sorted({str(h.label) for mesh in state.meshes.values() for h in mesh.hulls})
            places = tuple(HullPlace(first, hull.name) for hull in hulls)
            choices = tuple(ReviewChoice(label, label) for label in labels)
            return ReviewQuestion("group", "group", "", 1.0, 1.0, first, hulls=places, choices=choices)
        if not open_ones:
            return None
        choices = tuple(map(ReviewChoice, (RIGHT, WRONG, ASIDE)))
        return ReviewQuestion(f"result {open_ones[0]}", "result", "", 1.0, 1.0, open_ones[0], choices=choices)


@pytest.fixture(scope="module")
def bench() -> Bench:
    return few("cup-easy")


@pytest.fixture(scope="module")
def small() -> Bench:
    one = task("cup-easy")
    return Bench(one, family(one.category, "coarse")[:4])


@pytest.mark.parametrize("condition", [TRUE, FLAT, PROPAGATED[1], ERRS])
def test_time_only_goes_on_and_the_same_seed_does_the_same(small: Bench, condition: object) -> None:
    one, other = (sign_off(small, condition, 1, FakeTool(condition)) for _ in range(2))  # type: ignore[arg-type]
    assert one == other == Review.of_json(json.loads(json.dumps(asdict(one))))
    seconds = [point.seconds for point in one.points]
    assert seconds == sorted(seconds)
    assert sum(one.seconds.values()) == pytest.approx(seconds[-1], abs=0.1)
    assert one.seconds.keys() == one.acts.keys()
    assert one.possible <= one.assets == len(small.samples)
    for point in one.points:
        assert point.signed_off + point.held <= one.assets
        assert point.sure + point.wrong <= point.signed_off


def test_each_question_is_paid_for_once(bench: Bench) -> None:
    review = sign_off(bench, TRUE, 1, FakeTool(TRUE))
    assert review.ended == DONE
    assert review.acts["group"] == 1
    first = next(iter(bench.samples.values()))
    labels = [hull.label for hull in first.mesh.hulls[:GROUP]]
    most = max(map(labels.count, labels))
    others = {label for label in labels if labels.count(label) < most}
    assert review.seconds["group"] == pytest.approx(price_group(GROUP, GROUP - most) + STROKE * len(others))
    looks = review.acts["result"]
    assert looks == len(bench.samples) - review.acts["demonstration"]
    assert review.seconds["result"] == pytest.approx(looks * (GLANCE + APPROVAL))
    assert review.points[-1].sure == review.points[-1].right == review.possible
    assert review.wrong == review.aside == []


def test_a_session_is_broken_off_at_the_cap(bench: Bench) -> None:
    review = sign_off(bench, TRUE, 1, FakeTool(TRUE), cap=30.0)
    assert review.ended == BROKEN
    assert review.points[-1].held
    assert sum(review.seconds.values()) < 60


def test_who_never_slips_signs_off_nothing_wrong_where_every_result_is_looked_at(small: Bench) -> None:
    review = sign_off(small, FLAT, 2, FakeTool(FLAT), cap=10_000.0)
    assert review.wrong == []
    assert review.points[-1].held == 0


def test_an_asset_that_the_reference_cannot_mend_is_never_right() -> None:
    one = task("cup-hard")
    judge = Judge(Bench(one, family(one.category, "coarse")[:5]))
    impossible = set(judge.bench.samples) - judge.possible
    assert judge.count_right(judge.bench.truth, judge.bench.task.program) == len(judge.possible)
    assert not any(judge.is_right(judge.bench.truth, judge.bench.task.program, name) for name in impossible)
    assert all(judge.looks_right(judge.bench.truth, judge.bench.task.program, name) for name in judge.possible)


def test_who_glances_at_all_and_mends_by_hand_has_all_right_but_for_slips(bench: Bench) -> None:
    before = teach_before(bench, TRUE, 1)
    assert Before.of_json(json.loads(json.dumps(asdict(before)))) == before
    assert before.brute.right == before.possible == before.reference
    assert before.brute.seconds >= round(before.points[-1].seconds + GLANCE * before.assets, 2)
    assert right_at(before.points, 0.0) == 0
    assert right_at(before.points, 1e9) == before.points[-1].right
