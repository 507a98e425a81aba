"""How what a model wrote does on the meshes that were not demonstrated, by the criterion of the task."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from benchmark.baselines.blender.edit import edit_task
from benchmark.baselines.blender.process import Blender
from benchmark.baselines.replay import desk_of
from benchmark.study import CONDITIONS, Bench, Session, open_bench
from benchmark.tasks import EditResult
from meshforge.language import Program
from meshforge.symbolic import SymbolicMesh

_PATIENCE = 3
"""Meshes in a row that a script spoils by taking too long or breaking Blender, after which it is tried on no more."""
_REPORTED = 200  # characters
_SPOILT = ("it took longer", "Blender broke down")


def judge_program(name: str, condition: str, seed: int, shown: Sequence[str], text: str | None) -> dict[str, Any]:
    """A program in the language, judged; JSON of a session."""
    bench, log = _begin(name, condition, seed, shown, text)
    desk = desk_of(bench, log)
    program = Program.parse(text) if text else None
    _judge(bench, log, lambda mesh: desk.edit(program, mesh) if program else _nothing())
    log.right = program is not None and not desk.find_differences(program, _rest(bench, log))
    return log.to_json()


def judge_script(
    name: str, condition: str, seed: int, shown: Sequence[str], text: str | None, python: str
) -> dict[str, Any]:
    """A Blender script, judged; JSON of a session. `right` says nothing, since a script has no rules."""
    bench, log = _begin(name, condition, seed, shown, text)
    desk = desk_of(bench, log)
    with Blender(Path(python)) as blender:
        edits = _Edits(blender, bench, text)
        _judge(bench, log, lambda mesh: edits.of(desk.meshes[mesh]))
    return log.to_json()


class _Edits:
    """What a script makes of one mesh after the other."""

    def __init__(self, blender: Blender, bench: Bench, script: str | None) -> None:
        self._blender, self._task, self._script = blender, bench.task, script
        self._spoilt = 0

    def of(self, mesh: SymbolicMesh) -> EditResult:
        if self._script is None:
            return _nothing()
        if self._spoilt == _PATIENCE:
            return EditResult(None, error=f"not tried: {_PATIENCE} meshes in a row took too long or broke Blender")
        done = edit_task(self._blender, self._script, self._task, mesh)
        self._spoilt = self._spoilt + 1 if (done.error or "").startswith(_SPOILT) else 0
        return done


def _judge(bench: Bench, log: Session, edit: Callable[[str], EditResult]) -> None:
    """Write down on which of the meshes that were not demonstrated an edit fails."""
    rest = _rest(bench, log)
    log.judged, log.judged_pure = len(rest), sum(name in bench.pure for name in rest)
    for name in rest:
        if why := bench.failure(name, edit(name)):
            lines = why.splitlines()
            log.failures[name] = lines[-1 if lines[0].startswith("Traceback") else 0][:_REPORTED]
            log.failed_pure += name in bench.pure


def _nothing() -> EditResult:
    return EditResult(None, error="the model wrote nothing that can be read")


def _rest(bench: Bench, log: Session) -> list[str]:
    return [name for name in bench.samples if name not in log.shown]


def _begin(name: str, condition: str, seed: int, shown: Sequence[str], text: str | None) -> tuple[Bench, Session]:
    """The meshes of the person, and a session to write down in."""
    setting = CONDITIONS[condition].setting(seed)
    return open_bench(name, setting), Session(name, condition, seed, setting, shown=list(shown), program=text)
