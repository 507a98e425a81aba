"""Which edits of a family are right: the selections of the reference on true labels, and the task's criterion."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cached_property

from benchmark.study.desk import Bench, Desk
from meshforge.language import Program


class Judge:
    """Of one task's family; what was judged before is remembered by the bench."""

    def __init__(self, bench: Bench) -> None:
        self.bench = bench

    @cached_property
    def possible(self) -> frozenset[str]:
        """The assets on which the reference meets the criterion under true labels: on the others nothing is right."""
        bench, reference = self.bench, self.bench.task.program
        return frozenset(name for name in bench.samples if not bench.failure(name, bench.truth.edit(reference, name)))

    def is_right(self, desk: Desk, program: Program | None, name: str) -> bool:
        """Whether an asset is edited as wanted, and meets the criterion."""
        if program is None or name not in self.possible or not self._is_as_wanted(desk, program, name):
            return False
        return not self.bench.failure(name, desk.edit(program, name))

    def looks_right(self, desk: Desk, program: Program | None, name: str) -> bool:
        """Whether a person who sees the result would leave it; where nothing is right, as wanted is enough."""
        if program is None or not self._is_as_wanted(desk, program, name):
            return False
        return name not in self.possible or self.is_right(desk, program, name)

    def count_right(self, desk: Desk, program: Program | None, names: Iterable[str] | None = None) -> int:
        """How many assets are right, of all or of some."""
        return sum(self.is_right(desk, program, name) for name in names or self.bench.samples)

    def _is_as_wanted(self, desk: Desk, program: Program, name: str) -> bool:
        wanted = self.bench.truth.reference[name]
        return wanted is not None and desk.select(program, name) == wanted
