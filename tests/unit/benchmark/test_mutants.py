"""Programs that are nearly the reference, and that the criteria tell their edits from the reference's."""

import pytest

from benchmark.evaluation import mutation
from benchmark.tasks import Task, tasks
from benchmark.tasks.mutants import ACTIONS, EXTRACTORS, judge_mutants, mutants
from meshforge.language import size_of

TASKS = tasks()


@pytest.mark.parametrize("one", TASKS, ids=lambda one: one.name)
def test_every_rule_is_changed_in_every_way(one: Task) -> None:
    found = mutants(one)
    assert len({mutant.name for mutant in found}) == len(found)
    assert len({str(mutant.program) for mutant in found}) == len(found)
    assert all(mutant.program != one.program for mutant in found)
    for number, rule in enumerate(one.program.rules, 1):
        mine = [mutant for mutant in found if mutant.rule == number]
        wrong = [mutant for mutant in mine if len(mutant.program.rules) == len(one.program.rules)]
        others = [mutant.program.rules[number - 1].extractor for mutant in wrong]
        others = [extractor for extractor in others if extractor != rule.extractor]
        assert len(mine) in (len(ACTIONS) + EXTRACTORS, len(ACTIONS) + EXTRACTORS + 1)
        assert {size_of(extractor) for extractor in others} == {size_of(rule.extractor)}
        assert len(others) == EXTRACTORS
    assert [str(mutant.program) for mutant in mutants(one)] == [str(mutant.program) for mutant in found]


@pytest.mark.parametrize("one", TASKS, ids=lambda one: one.name)
def test_nothing_passes_that_deletes_all(one: Task) -> None:
    everything = mutants(one)[0]
    assert everything.name == "All => Delete"
    for sample in one.samples(calibration=True)[:2]:
        assert one.failure(sample, one.run(everything.program, sample.mesh))


@pytest.mark.parametrize(
    "name",
    ["lamp-easy", *(pytest.param(f"{name}-medium", marks=pytest.mark.long) for name in ("cup", "dispenser", "knife"))],
)
def test_the_criterion_tells_the_mutants_of_a_task(name: str) -> None:
    rows = judge_mutants(name, calibration=True)
    assert sum(bool(row["differs"]) for row in rows) > len(rows) / 2
    worst = max(rows, key=mutation.share)
    assert mutation.share(worst) <= mutation.MOST, worst
