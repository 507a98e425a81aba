"""Simulated demonstrators: the same seed does the same, what they say is true, noisy labels are as noisy as said."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

from benchmark.assets import CATEGORIES, samples
from benchmark.study import CONDITIONS, FULL, NOISY, Bench, Session, teach_task
from benchmark.study.instances import instance, mend
from benchmark.study.keystrokes import model_seconds
from benchmark.study.labels import ACCURACY, FEW, MOST, noisy, wrong
from benchmark.study.person import Person
from benchmark.study.propagation import begin_by_hand, label_by_hand
from benchmark.tasks import task
from meshforge.language import Is
from tests.unit.benchmark.conftest import few

EASY = task("cup-easy")


@pytest.fixture(scope="module")
def bench() -> Bench:
    return few("cup-medium")


def without_times(session: Session) -> Session:
    return replace(session, rounds=[replace(row, seconds={}) for row in session.rounds])


@pytest.mark.parametrize("condition", [FULL, NOISY, CONDITIONS["noisy labels, errs in 5%"]])
def test_a_session_is_the_same_every_time_and_survives_json(bench: Bench, condition: object) -> None:
    one, other = (teach_task(bench, condition, 0) for _ in range(2))  # type: ignore[arg-type]
    assert without_times(one) == without_times(other)
    assert Session.of_json(json.loads(json.dumps(one.to_json()))) == one
    assert one.k == len(one.shown) + one.answers
    assert one.judged == len(bench.samples) - len(set(one.shown))


CARRIED = CONDITIONS["propagated labels, 3 labelled"]


def test_labels_that_are_carried_over_leave_what_was_labelled_by_hand_and_judge_the_rest(bench: Bench) -> None:
    one, other = (teach_task(bench, CARRIED, 0) for _ in range(2))
    assert without_times(one) == without_times(other)
    begun, by_hand, given = begin_by_hand(bench, 3)
    assert len(by_hand) == 3
    assert sum(len(bench.samples[name].mesh.hulls) for name in by_hand) >= given > 0
    assert one.judged == len(bench.samples) - len(by_hand | set(one.shown))
    assert one.typed >= given
    name = one.shown[0]
    desk, wrong = label_by_hand(begun, name)
    for known in (*by_hand, name):
        true = bench.truth.meshes[known]
        assert [hull.label for hull in desk.meshes[known].hulls] == [hull.label for hull in true.hulls]
    assert wrong == sum(
        a.label != b.label for a, b in zip(begun.meshes[name].hulls, bench.truth.meshes[name].hulls, strict=True)
    )
    carried = [h for n, mesh in desk.meshes.items() if n not in by_hand | {name} for h in mesh.hulls]
    assert {hull.source for hull in carried} == {"propagated"}


def test_with_true_labels_nobody_confirms_anything_wrong_and_accepts_only_what_looks_right(bench: Bench) -> None:
    session = teach_task(bench, FULL, 1)
    assert session.confirmed == 0
    assert session.f1 == pytest.approx(1.0) or not session.right
    assert session.right == (session.rounds[-1].differs == 0)


def test_a_right_program_fails_only_where_the_reference_does(bench: Bench) -> None:
    session = teach_task(bench, FULL, 1)
    assert session.right
    program = bench.task.program
    rest = set(bench.samples) - set(session.shown)
    failing = {name for name in rest if bench.failure(name, bench.truth.edit(program, name))}
    assert set(session.failures) == failing


def test_edits_that_select_the_same_are_judged_apart_where_they_differ(bench: Bench) -> None:
    name, sample = next((name, row) for name, row in bench.samples.items() if any(bench.truth.reference[name] or ()))
    edited = bench.truth.edit(bench.task.program, name)
    idle = replace(edited, mesh=sample.mesh, named=frozenset())
    fresh = [bench.task.failure(sample, edit) for edit in (edited, idle)]
    assert fresh[0] != fresh[1]
    assert [bench.failure(name, edit) for edit in (edited, idle, edited)] == [*fresh, fresh[0]]


def test_no_failure_is_seen_in_what_is_right_by_the_eye_or_what_the_reference_gets_wrong_too(bench: Bench) -> None:
    desk, one = bench.desk("noisy", 5), bench.task.program
    person, names = Person(desk, 5, NOISY), list(bench.samples)
    assert person.sees(desk, one, names) is None
    other = replace(one, rules=(one.rules[0], replace(one.rules[1], extractor=Is("handle"))))
    unlike = 0
    for name in names:
        done, wanted, true = desk.select(other, name), desk.reference[name], bench.truth.reference[name]
        seen = person.sees(desk, other, [name])
        if done is None or wanted is None or true is None:
            continue
        wrong = [place for place, row in enumerate(zip(done, wanted, true, strict=True)) if row[0] not in row[1:]]
        unlike += sum(a == eye != b for a, b, eye in zip(done, wanted, true, strict=True))
        if not wrong:
            assert seen is None
            continue
        assert seen
        assert max(seen[1]) == wrong[0] + 1
        assert {place - 1 for place in seen[1]} == {k for k in range(wrong[0]) if done[k] != true[k]} | {wrong[0]}
    assert unlike, "some result is right though the reference selects something else, as a label is wrong"


def test_without_questions_nothing_is_answered(bench: Bench) -> None:
    assert teach_task(bench, CONDITIONS["true labels, no questions"], 2).answers == 0


def test_the_noisy_labeller_is_as_noisy_as_it_says() -> None:
    rows = [sample for category in CATEGORIES for sample in samples(category, calibration=True)]
    errors = [wrong(row.mesh, noisy(row.mesh, (5, k))) for k, row in enumerate(rows)]
    hulls = [len(row.mesh.hulls) for row in rows]
    assert 1 - sum(errors) / sum(hulls) == pytest.approx(ACCURACY, abs=0.02)
    assert all(error <= MOST for error, count in zip(errors, hulls, strict=True) if count <= FEW)


def test_wrong_labels_come_together() -> None:
    """More often than drawn blindly, a wrong hull touches another wrong one."""
    rows = [sample.mesh for sample in samples("table", calibration=True)]
    rng = np.random.default_rng(0)
    together = blindly = 0
    for k, mesh in enumerate(rows):
        labelled = noisy(mesh, (9, k))
        places = [i for i, (a, b) in enumerate(zip(mesh.hulls, labelled.hulls, strict=True)) if a.label != b.label]
        drawn = rng.permutation(len(mesh.hulls))[: len(places)].tolist()
        together += sum(bool(mesh.neighbours(i) & set(places)) for i in places)
        blindly += sum(bool(mesh.neighbours(i) & set(drawn)) for i in drawn)
    assert together > blindly


def test_a_persons_time_is_modelled_from_what_was_done(bench: Bench) -> None:
    session = teach_task(bench, FULL, 0)
    spent = model_seconds(session, len(bench.task.program.rules))
    assert spent["answering"] == pytest.approx(session.answers * 4.0)
    assert spent["demonstrating"] > 0
    assert model_seconds(Session("cup-medium", "", 0), 2) == dict.fromkeys(spent, 0.0)


def test_an_instance_of_the_repair_study_is_a_near_miss() -> None:
    found = instance("cup-medium")
    if found is None:
        pytest.skip("no draw of this task is a near miss")
    without, inspected, repaired = (
        mend(found, way) for way in ("no correction", "all labels inspected (Standard PBE)", "ABI")
    )
    assert inspected.right
    assert inspected.demonstrations == 2
    assert inspected.inspected == sum(len(found.desk.meshes[name].hulls) for name in found.pool[:2])
    assert without.confirmed == inspected.confirmed == 0
    assert without.demonstrations > 2 or not without.right
    assert repaired.inspected == 0
