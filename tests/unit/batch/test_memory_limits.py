"""What one asset may take, what a run has before it, and what it came to."""

import sys
from pathlib import Path

import numpy as np
import pytest

from meshforge.batch import ExecutionOptions, Failed, RunSummary, apply, describe_jobs, expand, make_jobs, run_isolated
from meshforge.batch.outcome import MOST_SHOWN, Unchanged
from meshforge.batch.workers import MIB
from meshforge.language import Program
from tests.unit.batch.families import PROGRAM, write_tables

only_linux = pytest.mark.skipif(sys.platform != "linux", reason="only Linux bounds the memory of a process")


def filled(mebibytes: int) -> int | str:
    """The size of an array that was really there, or that there was no room for it."""
    try:
        return int(np.ones(mebibytes * MIB, np.uint8).sum()) // MIB
    except MemoryError:
        return "no room"


@pytest.mark.slow
@only_linux
def test_a_monster_has_no_room_and_the_others_have() -> None:
    assert list(run_isolated(filled, [10, 900, 20], ExecutionOptions(1, None, 500 * MIB))) == [10, "no room", 20]
    assert list(run_isolated(filled, [900], ExecutionOptions(1, None))) == [900]


@only_linux
def test_an_asset_without_room_fails_alone(tmp_path: Path) -> None:
    write_tables(tmp_path / "assets", 2)
    big = tmp_path / "assets/big.obj"
    big.write_text("".join(f"v {k} 0 0\n" for k in range(2_000_000)) + "f 1 2 3\n")
    outcomes = list(
        apply(
            Program.parse(PROGRAM),
            make_jobs(expand([tmp_path / "assets"])),
            tmp_path / "out",
            execution=ExecutionOptions(1, memory=100 * MIB),
        )
    )
    assert [outcome.status for outcome in outcomes] == ["failed", "edited", "edited"]
    assert isinstance(outcomes[0], Failed)
    assert "big.obj: there is not enough memory for it\n  More for one asset: --memory" in outcomes[0].error


def test_jobs_are_described_by_kind_size_and_labels(tmp_path: Path) -> None:
    write_tables(tmp_path / "assets", 3)
    (tmp_path / "assets/table0/model.labels.json").unlink()
    assert describe_jobs(make_jobs(expand([tmp_path / "assets"]))) == "3 assets (3 OBJ), 2 with labels"


def test_a_summary_counts_all_and_keeps_few() -> None:
    summary = RunSummary()
    for k in range(1000):
        summary.add(Failed(f"bad{k}", "no", 0.0) if k % 10 == 0 else Unchanged(f"a{k}", "o", (), 2, 1, 0.0))
    assert (summary.total, summary.counts["failed"], summary.before, summary.after) == (1000, 100, 1800, 900)
    assert len(summary.outcomes_to_show) == MOST_SHOWN
    assert all(isinstance(outcome, Failed) for outcome in summary.outcomes_to_show[:100])
    told = str(summary).splitlines()
    assert told[0] == "1,000 assets: 100 failed, 900 unchanged; hulls 1,800 -> 900"
    assert told[1].startswith("failed: bad0, bad10,") and told[1].endswith(" and 80 more")
    assert str(RunSummary()) == "0 assets: nothing to do; hulls 0 -> 0"
