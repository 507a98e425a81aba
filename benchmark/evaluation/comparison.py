"""RQ2: the paper's baselines over the same tasks; they need an endpoint, and are not run without one."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from benchmark.baselines import agent, blender_model
from benchmark.baselines.accounts import accounts
from benchmark.baselines.blender.apart import find_python
from benchmark.baselines.blender.process import Blender
from benchmark.baselines.refinement import ROUNDS
from benchmark.baselines.run import BaselineRun, run_baseline, vlm_agent, vlm_blender
from benchmark.evaluation import paper
from benchmark.evaluation.figures import by_task, format_pair, fpr, spread
from benchmark.evaluation.sessions import sessions
from benchmark.options import RunOptions
from benchmark.report import Cell, Result, Table, Tell
from benchmark.study import FLAT, TRUE, Session
from meshforge.labels import Endpoint
from meshforge.store.settings import VlmSettings

_CONDITIONS = (TRUE, FLAT)


@dataclass(frozen=True, slots=True)
class _Row:
    """A baseline: what came of it, None where it was not run, and what there is to say about that."""

    name: str
    played: BaselineRun | None
    about: str = ""

    @property
    def whole(self) -> BaselineRun | None:
        """What came of all sessions."""
        return None if self.played is None or self.played.missing else self.played


def measure(tell: Tell, quick: bool, given: RunOptions | None = None) -> Result:
    """Our row from the same sessions as RQ1, and the rows of the baselines."""
    given = given or RunOptions()
    settings = given.settings()
    taught = sessions(_CONDITIONS, tell, quick)
    rows = (_agent(taught, settings, tell), _blender(taught, settings, given.blender, tell))
    functional = Table(
        "Functional pass rate",
        ("", "FPR (paper)", *(f"FPR, {condition.name}" for condition in _CONDITIONS)),
        (
            ("MeshForge", paper.RQ2["MeshForge"], *_share_that_pass(taught)),
            *((row.name, paper.RQ2[row.name], *_cells(row)) for row in rows),
        ),
    )
    whole = [(row.name, row.whole, row.name == agent.NAME) for row in rows if row.whole]
    is_priced = settings is not None and Endpoint(settings).is_priced
    return Result(
        "comparison",
        "RQ2: comparison",
        (functional, *([accounts(whole, _CONDITIONS, is_priced=is_priced)] if whole else [])),
        notes=tuple(_notes(rows, settings)),
        details=tuple(_details(rows)),
    )


def _agent(taught: Sequence[Session], settings: VlmSettings | None, tell: Tell) -> _Row:
    if settings is None:
        return _Row(agent.NAME, None, "no model was named")
    return _Row(agent.NAME, run_baseline(vlm_agent(), taught, settings, tell))


def _blender(taught: Sequence[Session], settings: VlmSettings | None, python: Path | None, tell: Tell) -> _Row:
    if settings is None:
        return _Row(blender_model.NAME, None, "no model was named")
    python = python or find_python()
    if python is None:
        return _Row(blender_model.NAME, None, "no Python with Blender in it (bpy) was named")
    with Blender(python) as blender:
        fences = blender.fences
    about = f"Scripts ran in Blender {fences.blender}, fenced in: {fences}"
    return _Row(blender_model.NAME, run_baseline(vlm_blender(python), taught, settings, tell), about)


def _share_that_pass(rows: Sequence[Session]) -> tuple[Cell, ...]:
    return tuple(format_pair(spread(by_task(rows, condition.name), fpr)) for condition in _CONDITIONS)


def _cells(row: _Row) -> tuple[Cell, ...]:
    if row.whole:
        return _share_that_pass(row.whole.sessions)
    return ("not finished" if row.played else "not run",) * len(_CONDITIONS)


def _details(rows: Sequence[_Row]) -> Iterator[dict[str, Any]]:
    for row in rows:
        for session, written in zip(row.played.sessions, row.played.written, strict=True) if row.played else ():
            yield {"baseline": row.name, **session.to_json(), "asking": written.to_json()}


def _notes(rows: Sequence[_Row], settings: VlmSettings | None) -> Iterator[str]:
    yield (
        "*VLM Agent*: a model is given the documentation and the grammar of the language, and writes the program. "
        "*VLM Blender*: it writes a Blender script, which is run on each mesh; a mesh with an object that is not a "
        "closed convex hull counts as failed. Both get the demonstrations of MeshForge's session: for each mesh the "
        "hulls with labels, boxes and contacts, pictures before and after, and all steps, also if the person showed "
        "the tool only some; they do not get answers to its questions. The model gets a report of what its program "
        f"or script does differently on these meshes, up to {ROUNDS} answers in all. The best one is judged on all "
        "other meshes by the task's criterion, even if it never matched the demonstrations."
    )
    yield (
        "Labels, orientation, thresholds and templates are those of the session; under noisy labels the baselines "
        "keep those that the person started with, while MeshForge's row has the corrections that were confirmed. "
        "Scripts get each mesh in the same orientation as the rules, or unturned if its landmarks are not found. "
        "There is one script for all meshes, while those of the paper may also go mesh by mesh."
    )
    for row in rows:
        if row.played is None:
            yield f"{row.name} was not run: {row.about}."
        elif row.played.missing:
            yield f"{row.name} is not finished: {row.played.missing} sessions are missing. {row.played.why}"
        elif row.about:
            yield f"{row.about}."
    if settings is None:
        yield (
            "To run them: `script/bench comparison --vlm FILE`, with a table `[vlm]` in the file as in a project's "
            "`meshforge.toml`, and Blender's Python in `.bench/blender` (dependency group `blender`) or named by "
            "`--blender PYTHON`. Answers are kept, so that an interrupted run continues; `--max-cost DOLLARS` limits "
            "what one run may spend on each baseline."
        )
    else:
        endpoint = Endpoint(settings)
        yield f"The model asked: {endpoint.settings.model}, at temperature 0."
    yield paper.CONDITIONS
