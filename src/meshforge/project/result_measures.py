"""Measures of the results of a family, by which some stand out; what is not written yet is made in memory for that."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from meshforge.batch import (
    ApplyTask,
    OutputInputs,
    program_digest,
    read_stamp,
    replay_corrections,
    selections_of,
    template_digests,
)
from meshforge.common import MeshForgeError
from meshforge.language import Program
from meshforge.project import run
from meshforge.project.sign_offs import is_written
from meshforge.signoff import EditMeasures, measure_edit
from meshforge.store import ConfidenceLine, Feedback, Store
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import memoize


def measure_results(
    store: Store,
    program: Program,
    meshes: Mapping[str, SymbolicMesh],
    inputs: Mapping[str, OutputInputs],
    stop: Callable[[], bool] = lambda: False,
) -> dict[str, EditMeasures]:
    """The measures of the results of a program, by asset; of some only once `stop` says so.

    meshes: of the family, by id; inputs: of the edits as they are now. What is known of an output, or of the last
    review, is not measured again while it is up to date; an asset on which the program cannot run has no result.
    """
    plan = _Plan.of(store, program)
    found = dict[str, EditMeasures]()
    for asset, mesh in meshes.items():
        if stop():
            break
        try:
            found[asset] = plan.recall(asset, inputs.get(asset)) or plan.measure(asset, mesh)
        except MeshForgeError:
            continue
    return found


@dataclass(frozen=True, eq=False, slots=True)
class _Plan:
    """What `apply` would do to each asset. last: what the last review found, by asset; digest: of the program; key: two
    with the same do the same."""

    store: Store
    task: ApplyTask
    last: Mapping[str, ConfidenceLine]
    digest: str
    key: str
    feedback: Feedback

    @staticmethod
    def of(store: Store, program: Program) -> _Plan:
        task, last = run.build_task(store, program), store.assessment()
        digest = program_digest(program)
        key = f"{digest} {template_digests(task.templates)}"
        return _Plan(store, task, last.assets if last else {}, digest, key, store.feedback())

    def recall(self, asset: str, now: OutputInputs | None) -> EditMeasures | None:
        """The measures of an output or of the last review, None where neither is as this program would make it now."""
        if now is None or now.program != self.digest:
            return None
        stamp, line = read_stamp(self.store.layout.edited, asset), self.last.get(asset)
        if stamp and stamp.measures and is_written(stamp, now):
            return stamp.measures
        return line.measures if line and line.rests_on == now else None

    def measure(self, asset: str, mesh: SymbolicMesh) -> EditMeasures:
        """The measures of an edit with what was done by hand after it; cached with the mesh."""
        corrections, meant = self.store.corrections(asset), run.find_selections(self.feedback, asset)
        program, templates = self.task.program, self.task.templates

        def make() -> EditMeasures:
            after = program.run(mesh, templates, selections=selections_of(meant, program), memo=memoize).mesh
            return measure_edit(mesh, replay_corrections(corrections, mesh, after, program, templates)[0])

        return memoize(mesh, ("measures", self.key, *map(str, (*corrections, *meant))), EditMeasures, make)
