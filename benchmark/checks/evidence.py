"""By how much a goal that holds speaks for its edit, fitted on families to calibrate on; and which results goals clear
or hold on others. `python -m benchmark.checks.evidence` writes the weights where they belong."""

from __future__ import annotations

import json
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import minimize

from benchmark.checks.goals import GOALS
from benchmark.journal import run_units
from benchmark.report import Cell, Goal, Result, Table, Tell
from benchmark.signoff.client import Client, FamilyStatus
from benchmark.signoff.judge import Judge
from benchmark.signoff.queue import sign_off
from benchmark.study import CONDITIONS, FLAT, open_bench
from benchmark.study.condition import PROPAGATED
from benchmark.study.project import name_by_files
from meshforge.batch import IN_PROCESS
from meshforge.common import write_atomically
from meshforge.geometry import Floats
from meshforge.project import Project
from meshforge.signoff import GoalStatus, ResultStatus, assessment

_LABELS = (FLAT, PROPAGATED[2])
_SEED, _LOOKS = 0, (1, 4)  # the looks with a program of which rows are kept
_KINDS = ("failed", "passed")  # outcomes before the edit, of goals that hold after it
_MOST, _STRAY = 5.0, 1e-3
Row = dict[str, Any]


def measure(tell: Tell, quick: bool) -> Result:
    """Fit the weights on calibration families, and see what goals do on the others."""
    names = [name for name in _list_tasks() if not quick or name == "table-hard"]
    fitted_on, reported = (list(_observe_all(names, calibrates, tell)) for calibrates in (True, False))
    weights = fit_weights(fitted_on)
    shipped = [assessment.read_calibration().goals[kind] for kind in _KINDS]
    rows = list(_count_all(reported))
    return Result(
        "evidence",
        "Goals as evidence",
        (Table("Results that nobody had looked at, on families that nothing was fitted on", _COLUMNS, tuple(rows)),),
        (Goal("weights that ship less those fitted, nats", "at most", 0.05, float(np.abs(weights - shipped).max())),),
        (
            f"Fitted on {len(fitted_on)} results of calibration families: a goal that holds, and failed before the "
            f"edit, speaks for it by {weights[0]:.2f} nats, one that held before, too, by {weights[1]:.2f}. No weight "
            "is below zero, and a goal that fails holds a result whatever else speaks for it.",
            "*Held*: less sure than the threshold without goals. People as in sign-offs; the first look at which there "
            "is a program, and the fourth. Goals and criteria ask like things of other places, see above.",
        ),
        (*({"set": "calibration", **row} for row in fitted_on), *({"set": "reported", **row} for row in reported)),
    )


def _list_tasks() -> list[str]:
    """Tasks of generated families whose program, or files, say what is up."""
    return [name for name, goals in GOALS.items() if not name.startswith("real") and "orient" not in goals]


def _observe_all(names: Sequence[str], calibrates: bool, tell: Tell) -> Iterator[Row]:
    units = [(name, one.name, calibrates) for name in names for one in _LABELS]
    for found in run_units("evidence", observe, units, tell):
        yield from found


def observe(name: str, condition: str, calibrates: bool) -> list[Row]:
    """What goals say of each result that nobody had looked at, at some looks of one session."""
    one, rows = CONDITIONS[condition], list[Row]()
    bench = open_bench(name, one.setting(_SEED), calibrates)
    with suppress(_EnoughError):
        sign_off(bench, one, _SEED, partial(_Observer, name, Judge(name_by_files(bench)), rows))
    return rows


class _EnoughError(Exception):
    """All looks that count were taken."""


class _Observer(Client):
    def __init__(self, name: str, judge: Judge, rows: list[Row], project: Project) -> None:
        super().__init__(project)
        self._task, self._judge, self._rows, self._looks = name, judge, rows, 0

    def review(self) -> FamilyStatus:
        status = super().review()
        self._looks += status.has_program
        if status.has_program and self._looks in _LOOKS:
            self._rows += self._list_rows()
        if self._looks >= max(_LOOKS):
            raise _EnoughError
        return status

    def _list_rows(self) -> Iterator[Row]:
        assert self.found
        state, goals = self.found.state, GOALS[self._task]
        some = [name for name in state.meshes if name in self._judge.possible and name not in state.reviewed_assets]
        for one in self.project.try_goals(goals, only=some, execution=IN_PROCESS) if some else ():
            if not one.error:
                outcomes = [(one.before[site].outcome, result.outcome) for site, result in one.after.items()]
                share = self.found.assessment.without_goals[one.asset].confidence
                is_right = self._judge.is_right(one.asset, self.read_output(one.asset))
                yield {"task": self._task, "look": self._looks, "share": share, "goals": outcomes, "right": is_right}


def fit_weights(rows: Sequence[Row]) -> Floats:
    """Weights (2,) [nats] of goals that hold after an edit and failed, or held, before it; by maximum likelihood on
    results that no goal holds, none below zero."""
    open_rows = [row for row in rows if not _fails(row)]
    counts = np.array(
        [[Counter(b for b, a in row["goals"] if a == "passed")[kind] for kind in _KINDS] for row in open_rows]
    )
    shares = np.clip([row["share"] for row in open_rows], 1e-3, 1 - 1e-3)
    right = np.array([row["right"] for row in open_rows], dtype=float)

    def lose(weights: Floats) -> float:
        odds = np.log(shares / (1 - shares)) + counts @ weights
        return float(np.mean(np.logaddexp(0, odds) - right * odds) + _STRAY * weights @ weights)

    found = minimize(lose, np.zeros(2), bounds=[(0.0, _MOST)] * 2, method="L-BFGS-B")
    return np.round(found.x, 2)


def _fails(row: Row) -> bool:
    return any(after in ("failed", "broken") for _, after in row["goals"])


_COLUMNS = (
    "task",
    "results",
    "right, %",
    "held",
    "cleared by goals",
    "of these wrong",
    "taken back by goals",
    "of these right",
)


def _count_all(rows: Sequence[Row]) -> Iterator[tuple[Cell, ...]]:
    names = dict.fromkeys(row["task"] for row in rows)
    yield from (_count(name, [row for row in rows if row["task"] == name]) for name in names)
    yield _count("all", rows)


def _count(name: str, rows: Sequence[Row]) -> tuple[Cell, ...]:
    threshold = assessment.THRESHOLD
    held = [row for row in rows if row["share"] < threshold]
    cleared = [row for row in held if _weigh(row) >= threshold]
    back = [row for row in rows if row["share"] >= threshold and _weigh(row) < threshold]
    share = 100 * sum(row["right"] for row in rows) / max(len(rows), 1)
    wrong, right = sum(not row["right"] for row in cleared), sum(row["right"] for row in back)
    return name, len(rows), share, len(held), len(cleared), wrong, len(back), right


def _weigh(row: Row) -> float:
    """The probability with what goals say, as the product has it."""
    goals = [GoalStatus("", "", after, before=before) for before, after in row["goals"]]
    return ResultStatus(row["share"]).with_goals(goals).confidence


def write_weights(tell: Tell) -> None:
    """Fit the weights, and write them where they ship."""
    weights = fit_weights(list(_observe_all(_list_tasks(), True, tell)))
    path = Path(assessment.__file__).parent / assessment.WEIGHTS_FILE
    data = json.loads(path.read_text("utf-8"))
    data["goals"] = dict(zip(_KINDS, map(float, weights), strict=True))
    write_atomically(path, json.dumps(data, indent=1) + "\n")


if __name__ == "__main__":
    write_weights(lambda line: print(line, file=sys.stderr))
