from __future__ import annotations

import json
from pathlib import Path

from meshforge.batch import IN_PROCESS, AssetOutcome, Failed, RunSummary, apply, expand, make_jobs, read_stamp
from meshforge.batch.provenance import stamp_path
from meshforge.language import Program
from tests.unit.batch.families import PROGRAM, write_tables


def run(folder: Path, text: str = PROGRAM) -> list[AssetOutcome]:
    return list(
        apply(Program.parse(text), make_jobs(expand([folder / "assets"])), folder / "out", execution=IN_PROCESS)
    )


def summary_of(outcomes: list[AssetOutcome]) -> RunSummary:
    summary = RunSummary()
    for outcome in outcomes:
        summary.add(outcome)
    return summary


def test_a_stamp_keeps_the_measures_and_one_without_them_is_read(tmp_path: Path) -> None:
    write_tables(tmp_path / "assets", 1)
    [outcome] = run(tmp_path)
    assert not isinstance(outcome, Failed) and outcome.measures
    stamp = read_stamp(tmp_path / "out", outcome.asset)
    assert stamp and stamp.measures == outcome.measures
    path = stamp_path(tmp_path / "out", outcome.asset)
    earlier = json.loads(path.read_text("utf-8"))
    del earlier["measures"]
    path.write_text(json.dumps(earlier), "utf-8")
    [skipped] = run(tmp_path)
    assert not isinstance(skipped, Failed) and skipped.measures is None
    assert summary_of([skipped]).find_alarms() == {}
