"""Which results of a family stand out, those that are not written yet, too: these are made in memory and measured."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from meshforge.batch import (
    ApplyTask,
    OutputInputs,
    program_digest,
    read_stamp,
    replay_corrections,
    template_digests,
)
from meshforge.common import MeshForgeError
from meshforge.language import Program
from meshforge.project import run
from meshforge.project.sign_offs import is_written
from meshforge.signoff import EditMeasures, find_alarms, measure_edit
from meshforge.store import Store
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import memoize


def find_result_alarms(
    store: Store,
    program: Program,
    meshes: Mapping[str, SymbolicMesh],
    inputs: Mapping[str, OutputInputs],
    stop: Callable[[], bool] = lambda: False,
) -> dict[str, tuple[str, ...]]:
    """Sentences on those results of a program that stand out of their family, by asset; none once `stop` says so.

    meshes: of the family, by id; inputs: of the edits as they are now. An output that is up to date is not made again,
    and an asset on which the program cannot run has no result.
    """
    plan = _Plan.of(store, program)
    found = dict[str, EditMeasures]()
    for asset, mesh in meshes.items():
        if stop():
            return {}
        try:
            found[asset] = plan.read_measures(asset, inputs.get(asset)) or plan.measure(asset, mesh)
        except MeshForgeError:
            continue
    return {asset: tuple(alarm.text for alarm in alarms) for asset, alarms in find_alarms(found).items()}


@dataclass(frozen=True, eq=False, slots=True)
class _Plan:
    """What `apply` would do to each asset. digest: of the program; key: two with the same do the same."""

    store: Store
    task: ApplyTask
    digest: str
    key: str

    @staticmethod
    def of(store: Store, program: Program) -> _Plan:
        task = run.build_task(store, program)
        digest = program_digest(program)
        return _Plan(store, task, digest, f"{digest} {template_digests(task.templates)}")

    def read_measures(self, asset: str, now: OutputInputs | None) -> EditMeasures | None:
        """The measures of an output, None where it is not there as this program would make it now."""
        if now is None or now.program != self.digest:
            return None
        stamp = read_stamp(self.store.layout.edited, asset)
        return stamp.measures if stamp and is_written(stamp, now) else None

    def measure(self, asset: str, mesh: SymbolicMesh) -> EditMeasures:
        """The measures of an edit with what was done by hand after it; cached with the mesh."""
        corrections = self.store.corrections(asset)
        program, templates = self.task.program, self.task.templates

        def make() -> EditMeasures:
            after = program.run(mesh, templates).mesh
            return measure_edit(mesh, replay_corrections(corrections, mesh, after, program, templates)[0])

        return memoize(mesh, ("measures", self.key, *map(str, corrections)), EditMeasures, make)
