import json
import pickle
from pathlib import Path

import pytest

from meshforge.batch import (
    IN_PROCESS,
    AssetOutcome,
    Failed,
    RuleEffect,
    RunSummary,
    Skipped,
    apply,
    describe_alarms,
    expand,
    make_jobs,
    read_stamp,
    to_json_line,
)
from meshforge.batch.outcome import Edited, Unchanged
from meshforge.batch.provenance import stamp_path
from meshforge.language import Program
from tests.unit.batch import families
from tests.unit.batch.families import write_tables

RULES = (RuleEffect(1, ("a", "b"), ("a~1",), "two pieces"), RuleEffect(2, ()))
OUTCOMES: list[tuple[str, AssetOutcome]] = [
    ("edited", Edited("x/t.urdf", "out/x/t.urdf", RULES, 5, 4, 1.23456)),
    ("unchanged", Unchanged("x/t.urdf", "out/x/t.urdf", RULES, 5, 5, 0.5)),
    ("skipped", Skipped("x/t.urdf", "out/x/t.urdf", RULES, 5, 4, 0.0)),
    ("failed", Failed("x/t.urdf", "x/t.urdf: no labels", 0.1)),
]


@pytest.mark.parametrize(("word", "outcome"), OUTCOMES)
def test_every_outcome_pickles_and_has_a_json_line_of_one_shape(word: str, outcome: AssetOutcome) -> None:
    again = pickle.loads(pickle.dumps(outcome))
    assert again == outcome
    line = json.loads(json.dumps(to_json_line(again)))
    assert list(line) == ["asset", "status", "out", "error", "rules", "hulls", "seconds"]
    assert line["status"] == outcome.status == word
    assert set(line["hulls"]) == {"before", "after"}


def test_the_json_line_of_an_edited_asset() -> None:
    assert to_json_line(OUTCOMES[0][1]) == {
        "asset": "x/t.urdf",
        "status": "edited",
        "out": "out/x/t.urdf",
        "error": None,
        "rules": [
            {"rule": 1, "selected": ["a", "b"], "made": ["a~1"], "note": "two pieces"},
            {"rule": 2, "selected": [], "made": [], "note": None},
        ],
        "hulls": {"before": 5, "after": 4},
        "seconds": 1.235,
    }


def test_the_first_results_that_stand_out_are_named_with_their_first_alarm() -> None:
    assert describe_alarms({"a.obj": ("no hull is left", "more")}) == "1 result stands out: a.obj (no hull is left)"
    told = describe_alarms({f"a{k}": ("x",) for k in range(7)})
    assert told == "7 results stand out: a0 (x), a1 (x), a2 (x), a3 (x), a4 (x) and 2 more"


PROGRAM = Program.parse("Is(legs) => Delete\nIs(top) => Merge as slab\nIs(slab) => Delete\n")


def summary_of(*outcomes: AssetOutcome) -> RunSummary:
    summary = RunSummary()
    for outcome in outcomes:
        summary.add(outcome)
    return summary


def ran(*labels: str) -> Edited:
    return Edited("t.obj", "out/t.obj", (), 2, 1, 0.1, labels=labels)


def test_a_label_that_no_asset_of_a_run_has_is_named_with_the_nearest() -> None:
    said = "the program asks for 'legs', a label that no asset has; did you mean 'leg'?"
    assert summary_of(ran("leg"), ran("top")).describe_absent_labels(PROGRAM) == [said]
    assert summary_of(ran("leg"), ran("top"), ran("legs")).describe_absent_labels(PROGRAM) == []


def test_nothing_is_said_of_labels_that_are_not_known() -> None:
    """Where no asset has any, or stamps of an earlier version do not say."""
    assert summary_of().describe_absent_labels(PROGRAM) == summary_of(ran()).describe_absent_labels(PROGRAM) == []
    old = Skipped("o.obj", "out/o.obj", (), 2, 1, 0.0)
    assert summary_of(ran("leg"), old, ran("top")).describe_absent_labels(PROGRAM) == []


def test_a_stamp_keeps_the_measures_and_one_without_them_is_read(tmp_path: Path) -> None:
    (table,) = write_tables(tmp_path / "assets", 1)

    def run() -> AssetOutcome:
        jobs = make_jobs(expand([table]))
        (outcome,) = apply(Program.parse(families.PROGRAM), jobs, tmp_path / "out", execution=IN_PROCESS)
        return outcome

    outcome = run()
    assert not isinstance(outcome, Failed) and outcome.measures
    stamp = read_stamp(tmp_path / "out", outcome.asset)
    assert stamp and stamp.measures == outcome.measures
    path = stamp_path(tmp_path / "out", outcome.asset)
    earlier = json.loads(path.read_text("utf-8"))
    del earlier["measures"]
    path.write_text(json.dumps(earlier), "utf-8")
    skipped = run()
    assert not isinstance(skipped, Failed) and skipped.measures is None
    assert summary_of(skipped).find_alarms() == {}
