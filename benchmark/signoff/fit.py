"""The probability that an edit is right, and the threshold from which on it is signed off without a look, fitted on
sessions of families to tune on."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import minimize

from benchmark.journal import run_units
from benchmark.report import Tell
from benchmark.signoff.calibration import calibrate
from benchmark.signoff.client import Client, FamilyStatus
from benchmark.signoff.conditions import ERRS, NONE, open_family
from benchmark.signoff.judge import Judge
from benchmark.signoff.queue import sign_off
from benchmark.study import CONDITIONS, FLAT
from benchmark.study.condition import PROPAGATED, SYSTEMATIC
from benchmark.study.project import name_by_files
from benchmark.tasks import task, tasks
from meshforge.common import write_atomically
from meshforge.geometry import Floats
from meshforge.label_model import model_family
from meshforge.project import Project, ProjectReview
from meshforge.signoff import assessment
from meshforge.signoff.family import FamilyRun
from meshforge.synthesis import Ambiguous, Found

LABELS = (FLAT, NONE, ERRS, SYSTEMATIC, PROPAGATED[2])
"""Under which the sessions are; of the first families the first three."""
SEED = 0
RISK = 0.01
"""The share of the assets of a family that are signed off and wrong, at most, as far as can be expected."""
MOST_LOSS = 0.25
"""What a family counts at most whose edits are signed off and wrong: with the few families that there are, one that
counted as a whole would leave no threshold."""
_CAP = 150.0  # seconds of a person, after which a session says little new
_FIRST = 3.0  # what an edit counts at the first look beside one at a later look, of which there are many
_STRAY = 1e-4  # cost of the squares of the weights
_SIGNS = (
    0,
    1,
    0,
    1,
    -1,
    -1,
    -1,
    1,
    1,
)  # of the weights, then of a program and of a result: what speaks for never against
_START = (0.5, 1.0, 0.5, 1.0, 0.0, 0.0, 0.0, 3.0, 1.0)
_FEATURES = 5
_THRESHOLDS = np.round(np.arange(0.5, 0.9951, 0.005), 3)
Look = list[list[float]]
"""Of each edit that was judged and that nobody had seen at one look: the features, results that were found right, what
wrong ones say against the program [nats], whether it was called wrong, and whether it is right."""


class _Observer(Client):
    """Keeps what speaks for each edit whenever a person looks; nothing where an alarm makes it stand out."""

    def __init__(self, judge: Judge, looks: list[Look], project: Project) -> None:
        super().__init__(project)
        self._judge, self._looks = judge, looks

    def review(self) -> FamilyStatus:
        status = super().review()
        if self.found and isinstance(self.found.outcome, Found | Ambiguous):
            self._looks.append(list(self._list_rows(self.found, self.found.outcome)))
        return status

    def _list_rows(self, found: ProjectReview, outcome: Found | Ambiguous) -> Iterator[list[float]]:
        state, known = found.state, assessment.read_calibration()
        family = model_family(list(state.meshes.values()))
        said = [hull.annotation for mesh in state.meshes.values() for hull in mesh.hulls]
        posterior = family.infer(said, state.frame.labels)
        trial = FamilyRun.of(state, outcome.program, outcome.candidates, posterior, {})
        trust, right = trial.trust_in_program(), len(trial.results[0])
        against = known.program + known.result * right - float(np.log(trust / (1 - trust)))
        for one, evidence in zip(trial.runs, trial.evidence, strict=True):
            alarms = any(doubt.kind == "alarm" for doubt in found.assessment.assets[one.asset].reasons)
            if not (one.error or alarms or one.asset in state.reviewed_assets) and one.asset in self._judge.possible:
                is_right = self._judge.is_right(one.asset, self.read_output(one.asset))
                yield [*evidence.features.tolist(), right, against, float(one.asset in state.wrong), float(is_right)]


def observe(name: str, condition: str, folder: str) -> list[Look]:
    """All looks of one session of the queue."""
    one, looks = CONDITIONS[condition], list[Look]()
    bench = open_family(name, one.setting(SEED), folder)
    sign_off(bench, one, SEED, partial(_Observer, Judge(name_by_files(bench)), looks), _CAP)
    return looks


def fit(folders: Sequence[Path], tell: Tell) -> None:
    """Fit the weights on all tasks, say how good they are on categories left out, choose the threshold by these, and
    write all where it ships. folders: each with families of all categories; the labels of each further one are of one
    kind, in turn."""
    units = [(one.name, condition.name, str(folders[0])) for one in tasks() for condition in LABELS[:3]]
    for place, other in enumerate(folders[1:]):
        units += [(one.name, LABELS[(place + k) % len(LABELS)].name, str(other)) for k, one in enumerate(tasks())]
    sessions = list(zip(units, run_units("signoff-fit", observe, units, tell), strict=True))
    kinds = [task(name).category for (name, *_), _ in sessions]
    left_out = dict[str, Floats]()
    for kind in sorted(set(kinds)):
        left_out[kind] = fit_weights([looks for own, (_, looks) in zip(kinds, sessions, strict=True) if own != kind])
    rated = [_rate(left_out[own], looks) for own, (_, looks) in zip(kinds, sessions, strict=True)]
    for what, some in (("first look", [looks[:1] for looks in rated]), ("all looks", rated)):
        pairs = [(share, bool(right)) for looks in some for look in looks for share, _, right in look.tolist()]
        tell(f"{what}, category left out: {calibrate(pairs)}")
    losses = dict[tuple[str, str], list[Floats]]()
    for own, ((_, _, folder), _), looks in zip(kinds, sessions, rated, strict=True):
        losses.setdefault((own, folder), []).append(lose(looks))
    threshold = choose_threshold([np.mean(some, axis=0) for some in losses.values()])
    weights = fit_weights([looks for _, looks in sessions])
    data: dict[str, Any] = {"about": "made by `python -m benchmark.signoff fit FOLDER ...`"}
    names = zip(assessment.WEIGHTS, weights, strict=False)
    data["weights"] = {name: round(float(one), 3) for name, one in names} | assessment.BY_HAND
    data |= {"program": round(float(weights[-2]), 3), "result": round(float(weights[-1]), 3)}
    data |= {"threshold": threshold, "families": len(losses), "risk": RISK}
    write_atomically(Path(assessment.__file__).parent / assessment.WEIGHTS_FILE, json.dumps(data, indent=1) + "\n")
    tell(str(data))


def choose_threshold(losses: Sequence[Floats]) -> float:
    """The least threshold at which the expected loss of a new family is at most RISK; 1 where there is none.

    By conformal risk control.

    losses: of each family at each of the thresholds.
    """
    bound = (np.sum(losses, axis=0) + MOST_LOSS) / (len(losses) + 1)
    left = _THRESHOLDS[np.flatnonzero(bound > RISK).max(initial=-1) + 1 :]
    return float(left[0]) if len(left) else 1.0


def lose(looks: Sequence[Floats]) -> Floats:
    """The loss of a session at each threshold: the share of the edits that are signed off without a look at its end,
    though they are wrong."""
    if not looks:
        return np.zeros(len(_THRESHOLDS))
    wrong = looks[-1][(looks[-1][:, 1] == 0) & (looks[-1][:, 2] == 0), 0]
    share = (wrong[:, None] >= _THRESHOLDS).sum(axis=0) / max(len(looks[0]), 1)
    found: Floats = np.minimum(share, MOST_LOSS)
    return found


def fit_weights(sessions: Sequence[Sequence[Look]]) -> Floats:
    """The weights, then what speaks for a program and for a result, each session counting alike."""
    tables, worths = list[Floats](), list[Floats]()
    for looks in (one for one in sessions if any(one)):
        rows = np.array([row for look in looks for row in look])
        worth = np.array([_FIRST if place == 0 else 1.0 for place, look in enumerate(looks) for _ in look])
        tables.append(rows)
        worths.append(worth / worth.sum())
    rows, worth = np.concatenate(tables), np.concatenate(worths)
    bounds = [(None if sign <= 0 else 0.0, None if sign >= 0 else 0.0) for sign in _SIGNS]
    return np.array(minimize(partial(_compute_loss, rows, worth), np.array(_START), bounds=bounds).x)


def _rate(weights: Floats, looks: Sequence[Look]) -> list[Floats]:
    """Of each edit at each look the probability, whether it was called wrong, and whether it is right."""
    width = _FEATURES + 4
    tables = [np.array(look).reshape(-1, width) for look in looks]
    return [np.column_stack([_predict(weights, rows), rows[:, -2:]]) for rows in tables]


def _predict(weights: Floats, rows: Floats) -> Floats:
    """The probability that each edit is right (rows,)."""
    trust = weights[-2] + weights[-1] * rows[:, _FEATURES] - rows[:, _FEATURES + 1]
    found: Floats = assessment.combine(rows[:, :_FEATURES], weights[:-2]) / (1 + np.exp(-trust))
    return found


def _compute_loss(rows: Floats, worth: Floats, weights: Floats) -> float:
    shares, right = np.clip(_predict(weights, rows), 1e-9, 1 - 1e-9), rows[:, -1]
    nats = right * np.log(shares) + (1 - right) * np.log(1 - shares)
    return _STRAY * float(weights @ weights) - float(worth @ nats) / float(worth.sum())
