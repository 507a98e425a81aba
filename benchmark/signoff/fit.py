"""The weights of the probability that an edit is right, fitted on sessions of families to tune on."""

from __future__ import annotations

import json
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.optimize import minimize

from benchmark.journal import run_units
from benchmark.report import Tell
from benchmark.signoff.calibration import calibrate
from benchmark.signoff.client import Client, FamilyStatus
from benchmark.signoff.conditions import open_family
from benchmark.signoff.judge import Judge
from benchmark.signoff.opening import open_review
from benchmark.signoff.queue import sign_off
from benchmark.study import CONDITIONS, FLAT, TRUE
from benchmark.study.condition import PROPAGATED, SYSTEMATIC
from benchmark.study.project import name_by_files
from benchmark.tasks import task, tasks
from meshforge.batch import IN_PROCESS
from meshforge.common import write_atomically
from meshforge.geometry import Floats
from meshforge.label_model import model_family
from meshforge.project import Project, ProjectReview
from meshforge.project.alarms import measure_results
from meshforge.project.sign_offs import find_inputs
from meshforge.signoff import BAR, confidence, describe_odd_results
from meshforge.signoff.family import FamilyTrial
from meshforge.synthesis import Ambiguous, Found

LABELS = (FLAT, TRUE, SYSTEMATIC, PROPAGATED[2])
"""Under which the sessions are."""
SEED = 1
_CAP = 90.0  # seconds of a person, after which a session says nothing new
MOST_WRONG = 0.01
"""The share of the edits at the bar that may be wrong in the midst of sessions: as at their end, where it is less."""
_STEP = 0.05  # by which less speaks for edits
_STRAY = 1e-3  # cost of the squares of the weights
_SIGNS = (0, 1, -1, -1, -1)  # of the weights: what speaks for an edit never speaks against it


class _Observer(Client):
    """Keeps what speaks for each edit whenever a person looks. looks: the rows of each look, as of `_list_rows`."""

    def __init__(self, judge: Judge, looks: list[list[list[float]]], project: Project) -> None:
        super().__init__(project)
        self._judge, self._looks = judge, looks

    def review(self) -> FamilyStatus:
        status = super().review()
        self._looks.append(self._list_rows(self.found) if self.found else [])
        return status

    def _list_rows(self, found: ProjectReview) -> list[list[float]]:
        """The features of each edit that was judged, how far its program is trusted, and whether it is right, where
        nobody has looked at it."""
        state, outcome = found.state, found.outcome
        if not isinstance(outcome, Found | Ambiguous):
            return []
        posterior = model_family(list(state.meshes.values())).infer(
            [hull.annotation for mesh in state.meshes.values() for hull in mesh.hulls]
        )
        inputs = find_inputs(self.project, IN_PROCESS)
        alarms = describe_odd_results(measure_results(self.project, outcome.program, state.meshes, inputs))
        family = FamilyTrial.of(state, outcome.program, outcome.readings, posterior, alarms)
        looked_at = {*state.demos, *state.accepted}
        return [
            [
                *evidence.features.tolist(),
                evidence.program,
                float(self._judge.is_right(one.asset, self.read_output(one.asset))),
            ]
            for one, evidence in zip(family.trials, family.evidence, strict=True)
            if not one.error and one.asset in self._judge.possible and one.asset not in looked_at
        ]


def observe(name: str, condition: str, folder: str) -> list[list[float]]:
    """The rows of all looks of one session of the queue."""
    one, looks = CONDITIONS[condition], list[list[list[float]]]()
    bench = open_family(name, one.setting(SEED), folder)
    sign_off(bench, one, SEED, partial(_Observer, Judge(name_by_files(bench)), looks), _CAP)
    return [row for look in looks for row in look]


def observe_taught(name: str, condition: str, folder: str) -> list[list[float]]:
    """The rows of a family that was taught as before there was a queue; trust in the program is a column of its own, so
    none of its edits has to be told as right."""
    one, looks = CONDITIONS[condition], list[list[list[float]]]()
    bench = open_family(name, one.setting(SEED), folder)
    observer = partial(_Observer, Judge(name_by_files(bench)), looks)
    open_review(bench, one, SEED, observer, tells_looks=False)
    return looks[-1] if looks else []


def fit(folder: Path, tell: Tell) -> None:
    """Fit the weights on all tasks, say how good they are on categories left out, and write them where they ship."""
    units = [(one.name, condition.name, str(folder)) for one in tasks() for condition in LABELS]
    rows = dict[tuple[str, str], npt.NDArray[np.float64]]()
    for what, work in (("signoff-fit", observe), ("signoff-taught", observe_taught)):
        for unit, some in zip(units, run_units(what, work, units, tell), strict=True):
            table = np.array(some).reshape(-1, len(_SIGNS) + 2)
            rows[what, unit[0]] = np.concatenate([rows.get((what, unit[0]), table[:0]), table])
    categories = sorted({task(name).category for _, name in rows})
    pairs: dict[str, list[tuple[float, bool]]] = {what: [] for what, _ in rows}
    for left in categories:
        weights = fit_weights([some for (_, name), some in rows.items() if task(name).category != left])
        for (what, name), some in rows.items():
            if task(name).category == left:
                shares = _predict(weights, some)
                pairs[what] += list(zip(shares.tolist(), (some[:, -1] > 0).tolist(), strict=True))
    for what, some in pairs.items():
        tell(f"{what}, category left out: {calibrate(some)}")
    weights = lower(fit_weights(list(rows.values())), np.concatenate(list(rows.values())))
    data: dict[str, Any] = {"about": "made by `python -m benchmark.signoff fit FOLDER`"}
    fitted = {name: round(float(one), 3) for name, one in zip(confidence.FEATURES, weights, strict=True)}
    data["weights"] = fitted | confidence.BY_HAND
    write_atomically(Path(confidence.__file__).parent / confidence.WEIGHTS_FILE, json.dumps(data, indent=1) + "\n")
    tell(str(data["weights"]))


def fit_weights(tables: Sequence[npt.NDArray[np.float64]]) -> Floats:
    """Logistic regression on rows as of `_Observer`, each task counting alike."""
    parts = [(rows, 1 / len(rows)) for rows in tables if len(rows)]
    low = [0.0 if sign > 0 else None for sign in _SIGNS]
    high = [0.0 if sign < 0 else None for sign in _SIGNS]
    start = np.array([0.0, 1.0, 0.0, 0.0, 0.0])
    return np.array(minimize(partial(_loss, parts), start, bounds=list(zip(low, high, strict=True)), jac=True).x)


def lower(weights: Floats, rows: Floats) -> Floats:
    """The weights with less speaking for every edit, until hardly any at the bar is wrong: what is signed off by
    mistake costs more than a question. rows: of all sessions."""
    found = weights.copy()
    while True:
        signed = _predict(found, rows) >= BAR
        if (rows[signed, -1] == 0).sum() <= MOST_WRONG * signed.sum():
            return found
        found[0] -= _STEP


def _predict(weights: Floats, rows: Floats) -> Floats:
    """The probability that each edit is right (rows,)."""
    found: Floats = rows[:, -2] / (1 + np.exp(-(rows[:, :-2] @ weights)))
    return found


def _loss(parts: Sequence[tuple[Floats, float]], weights: Floats) -> tuple[float, Floats]:
    total, slope = _STRAY * float(weights @ weights), 2 * _STRAY * weights
    for rows, worth in parts:
        features, trust, right = rows[:, :-2], rows[:, -2], rows[:, -1]
        share = 1 / (1 + np.exp(-(features @ weights)))
        found = np.clip(trust * share, 1e-9, 1 - 1e-9)
        total -= worth * float((right * np.log(found) + (1 - right) * np.log(1 - found)).sum()) / len(parts)
        pull = (found - right) / (found * (1 - found)) * trust * share * (1 - share)
        slope = slope + worth * features.T @ pull / len(parts)
    return total, slope
