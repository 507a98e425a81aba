"""What an edit is worth in a simulation: contacts, time to rest and steps a second in MuJoCo, before and after."""

from dataclasses import dataclass
from time import thread_time
from typing import Any

import numpy as np

from meshforge.checks.base import CheckFindings, CheckSubject, Measure, MeasureCheck
from meshforge.checks.physics.mechanism import JointTree
from meshforge.checks.physics.model import STEP, compile_model
from meshforge.checks.physics.simulation import BODIES, HULLS, JITTER, SETTLE_SECONDS, WATCH_SECONDS
from meshforge.common import MeshForgeError, require_mujoco
from meshforge.symbolic import SymbolicMesh

_GRAVITY = 9.81
_CHUNK = 25  # steps after which speeds are looked at
_TIMED = 1000  # steps that are timed, the same before and after: of the processor, so that other work does not count


@dataclass(frozen=True, slots=True)
class RunSpeed:
    """A simulation of an asset that is put on a plane. contacts: points of contact at its end; rest: seconds of
    simulated time until all is at rest, None where that does not come; steps: of MuJoCo a second, on this machine."""

    contacts: int
    rest: float | None
    steps: float


@dataclass(frozen=True, eq=False, slots=True)
class Speed(Measure):
    """How fast an asset is simulated; before: as it was before an edit, None where that is not known."""

    now: RunSpeed
    before: RunSpeed | None

    @property
    def description(self) -> str:
        runs = [run for run in (self.before, self.now) if run]
        steps, contacts = " → ".join(f"{run.steps:,.0f}" for run in runs), " → ".join(str(run.contacts) for run in runs)
        rest = " → ".join("never" if run.rest is None else f"{run.rest:.3g} s" for run in runs)
        factor = f" ({self.now.steps / self.before.steps:.1f} times)" if self.before else ""
        more = f"contacts: {contacts}; at rest after: {rest}"
        return f"steps of MuJoCo a second, measured on this machine: {steps}{factor}; {more}"

    def to_json(self) -> dict[str, Any]:
        """Return what is the same on every machine, times in seconds: no steps a second."""
        runs = {"now": self.now, "before": self.before}
        return {name: {"contacts": run.contacts, "rest": run.rest} for name, run in runs.items() if run}


class SpeedCheck(MeasureCheck):
    """How fast MuJoCo simulates an asset, with how many contacts, and when it rests; before an edit, too."""

    name = "speed"

    def measure(self, subject: CheckSubject) -> CheckFindings:
        try:
            before = _run(subject.sound_before) if subject.sound_before else None
            return CheckFindings(measures={self.name: Speed(_run(subject.sound), before)})
        except MeshForgeError as error:
            return CheckFindings(notes=(f"speed was not measured: {error.sentence}",))


def _run(mesh: SymbolicMesh) -> RunSpeed:
    """Simulate a mesh on a plane as the check of physics does. Raises MeshForgeError where that cannot be done."""
    require_mujoco("the check of speed")
    import mujoco  # lazy: 0.3 s, only the physics checks need it

    tree = JointTree.of(mesh)
    if not mesh.hulls or len(mesh.hulls) > HULLS or len(tree.bodies) > BODIES:
        raise MeshForgeError(f"it has no hull, or more than {HULLS:,} hulls or {BODIES:,} bodies")
    try:
        model = compile_model(mesh, tree)
    except ValueError as error:  # MuJoCo's compiler
        raise MeshForgeError(f"MuJoCo refuses it: {str(error).splitlines()[0].removeprefix('Error: ')}") from None
    data = mujoco.MjData(model)
    reach = np.zeros(model.nbody)
    np.maximum.at(reach, model.geom_bodyid, model.geom_rbound)
    quiet, times, restless = JITTER * np.sqrt(_GRAVITY * mesh.diagonal), list[float](), 0
    for step in range(_CHUNK, round((SETTLE_SECONDS + WATCH_SECONDS) / STEP) + 1, _CHUNK):
        started = thread_time()
        mujoco.mj_step(model, data, nstep=_CHUNK)
        times.append(thread_time() - started)
        if any(data.warning[w].number for w in (mujoco.mjtWarning.mjWARN_BADQPOS, mujoco.mjtWarning.mjWARN_BADQACC)):
            raise MeshForgeError("the simulation blew up")
        turning, going = np.split(np.abs(data.cvel[1:]), 2, axis=1)
        restless = step if max(going.max(), (turning * reach[1:, None]).max()) > quiet else restless
        if is_at_rest := step >= _TIMED and (step - restless) * STEP >= WATCH_SECONDS:
            break
    steps = _CHUNK / float(np.median(times[: _TIMED // _CHUNK]))
    return RunSpeed(int(data.ncon), restless * STEP if is_at_rest else None, steps)
