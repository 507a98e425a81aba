"""Families that simulated people sign off: time only goes on, each act has its price, and what is right is counted."""

import json
from dataclasses import asdict, replace

import pytest

from benchmark.assets import family
from benchmark.signoff.client import Client, FamilyStatus
from benchmark.signoff.conditions import ERRS
from benchmark.signoff.judge import Judge, run_on_desk
from benchmark.signoff.queue import DONE, Review, sign_off
from benchmark.signoff.reviewer import Reviewer
from benchmark.study import FLAT, TRUE, Bench
from benchmark.study.condition import PROPAGATED
from benchmark.study.keystrokes import APPROVAL, GLANCE, STROKE, price_group
from benchmark.tasks import task
from meshforge.signoff import HullPlace, ReviewChoice, ReviewQuestion
from meshforge.signoff.review import JUDGE_CHOICES

GROUP = 3


class FakeClient(Client):
    """Asks for a demonstration, about one group of hulls, then about each result in turn."""

    def review(self) -> FamilyStatus:
        status = super().review()
        known = {*self.project.feedback().verdicts, *self.project.demonstration_ids()}
        held = [name for name in self.project.assets() if name not in known]
        signed = [name for name in self.project.assets() if name in known]
        if not status.has_program and self.project.demonstration_ids():
            return replace(status, question=None, signed_off=[], held=list(self.project.assets()))
        return replace(status, question=self.ask(held), signed_off=signed, held=held)

    def ask(self, held: list[str]) -> ReviewQuestion | None:
        meshes = self.read_meshes()
        first = next(iter(meshes))
        hulls = meshes[first].hulls[:GROUP]
        if not self.project.demonstration_ids():
            return ReviewQuestion("demonstrate", "", 1.0, 1.0, first, id=f"show {first}")
        if any(hull.source != "user" for hull in hulls):
            labels = sorted({str(h.label) for mesh in meshes.values() for h in mesh.hulls})
            places = tuple(HullPlace(first, hull.name) for hull in hulls)
            choices = tuple(map(ReviewChoice.of_label, labels))
            return ReviewQuestion("group", "", 1.0, 1.0, first, hulls=places, choices=choices, id="group")
        if not held:
            return None
        return ReviewQuestion("result", "", 1.0, 1.0, held[0], choices=JUDGE_CHOICES, id=f"result {held[0]}")


@pytest.fixture(scope="module")
def bench() -> Bench:
    one = task("cup-easy")
    return Bench(one, family(one.category, "coarse")[:4])


@pytest.mark.parametrize("condition", [TRUE, PROPAGATED[1], FLAT, pytest.param(ERRS, marks=pytest.mark.long)])
def test_time_only_goes_on_and_the_same_seed_does_the_same(bench: Bench, condition: object) -> None:
    one, other = (sign_off(bench, condition, 1, FakeClient) for _ in range(2))  # type: ignore[arg-type]
    assert one == other == Review.of_json(json.loads(json.dumps(asdict(one))))
    seconds = [point.seconds for point in one.points]
    assert seconds == sorted(seconds)
    assert sum(one.seconds.values()) == pytest.approx(seconds[-1], abs=0.1)
    assert one.seconds.keys() == one.by_keys.keys() == one.acts.keys()
    assert 0 < sum(one.by_keys.values()) < sum(one.seconds.values())
    assert one.possible <= one.assets == len(bench.samples)
    for point in one.points:
        assert point.signed_off + point.held <= one.assets
        assert point.sure + point.wrong <= point.signed_off


def test_each_question_is_paid_for_once(bench: Bench) -> None:
    review = sign_off(bench, TRUE, 1, FakeClient)
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


def test_an_asset_that_the_reference_cannot_mend_is_never_right() -> None:
    one = task("cup-hard")
    judge = Judge(Bench(one, family(one.category, "coarse")[:5]))
    impossible, truth, reference = set(judge.bench.samples) - judge.possible, judge.bench.truth, one.program
    assert judge.count_right(truth, reference) == len(judge.possible)
    assert not any(judge.is_right(name, run_on_desk(truth, reference, name)) for name in impossible)
    assert all(judge.looks_right(name, run_on_desk(truth, reference, name)) for name in judge.possible)


def test_each_exception_of_a_group_is_named_and_paid_for(bench: Bench) -> None:
    reviewer, (name, sample) = Reviewer(bench, 1, TRUE), next(iter(bench.samples.items()))
    labels = list(dict.fromkeys(str(hull.label) for hull in sample.mesh.hulls))
    alike = [hull.name for hull in sample.mesh.hulls if hull.label == labels[0]]
    other = next(hull.name for hull in sample.mesh.hulls if hull.label == labels[1])
    hulls = tuple(HullPlace(name, hull) for hull in (*alike, other))
    question = ReviewQuestion("group", "", 1.0, 1.0, name, None, hulls, (ReviewChoice.of_label(labels[0]),), "group")
    reply = reviewer.reply(question, bench.truth, None, None)
    assert (reply.choice, reply.exceptions) == (labels[0], {HullPlace(name, other): labels[1]})
    assert reviewer.ledger.total == pytest.approx(price_group(len(hulls), 1) + STROKE)
