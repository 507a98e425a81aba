"""Which outputs of a family are right: the selections of the reference on true labels, and the task's criterion."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

from benchmark.study.desk import Bench, Desk
from benchmark.tasks import EditResult
from meshforge.geometry import digest
from meshforge.language import Program
from meshforge.symbolic import SymbolicMesh


@dataclass(frozen=True, eq=False, slots=True)
class Output:
    """What becomes of an asset in the end; by_hand: whether somebody edited it by hand after the program."""

    edited: EditResult
    by_hand: bool = False

    @property
    def selections(self) -> tuple[frozenset[str], ...] | None:
        """What each rule selected, None where the program cannot run."""
        return None if self.edited.mesh is None else tuple(frozenset(line.selected) for line in self.edited.trace)


def run_on_desk(desk: Desk, program: Program | None, name: str) -> Output | None:
    """What a program makes of a mesh in memory; None without a program."""
    return Output(desk.edit(program, name)) if program else None


class Judge:
    """Of one task's family; what was judged before is remembered by the bench."""

    def __init__(self, bench: Bench) -> None:
        self.bench = bench

    @cached_property
    def possible(self) -> frozenset[str]:
        """The assets on which the reference meets the criterion under true labels: on the others nothing is right."""
        bench, reference = self.bench, self.bench.task.program
        return frozenset(name for name in bench.samples if not bench.failure(name, bench.truth.edit(reference, name)))

    def is_right(self, name: str, output: Output | None) -> bool:
        """Whether an asset is edited as wanted, and meets the criterion."""
        if output is None or name not in self.possible or not self._is_as_wanted(name, output):
            return False
        return not self.bench.failure(name, output.edited)

    def looks_right(self, name: str, output: Output | None) -> bool:
        """Whether a person who sees the result would leave it; where nothing is right, as wanted is enough."""
        if output is None or not self._is_as_wanted(name, output):
            return False
        return name not in self.possible or self.is_right(name, output)

    def count_right(self, desk: Desk, program: Program | None, names: Iterable[str] | None = None) -> int:
        """How many assets a program gets right on meshes in memory, of all or of some."""
        return sum(self.is_right(name, run_on_desk(desk, program, name)) for name in names or self.bench.samples)

    def _is_as_wanted(self, name: str, output: Output) -> bool:
        """Whether every rule selects what it should; after an edit by hand, whether the hulls are those that are
        wanted."""
        wanted = self.bench.truth.reference[name]
        if wanted is None or output.edited.mesh is None:
            return False
        if not output.by_hand:
            return output.selections == wanted
        meant = self.bench.truth.edit(self.bench.task.program, name).mesh
        return meant is not None and _count_shapes(output.edited.mesh) == _count_shapes(meant)


def _count_shapes(mesh: SymbolicMesh) -> Counter[str]:
    return Counter(digest(hull.shape) for hull in mesh.hulls)
