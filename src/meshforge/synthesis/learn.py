"""Learns a program from demonstrations (paper, stage III): one lesson after the other while labels get corrected."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping, Sequence

from meshforge.language import Orient, Program, Template
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis.agreement import agreed_rules
from meshforge.synthesis.asking import Answer, Repair
from meshforge.synthesis.batch import Batch, corrected, named_batch
from meshforge.synthesis.correction import Correction
from meshforge.synthesis.demonstration import Demonstration, named
from meshforge.synthesis.lesson import Lesson
from meshforge.synthesis.options import Options
from meshforge.synthesis.outcome import NeedsRepair, Outcome
from meshforge.synthesis.task import Task
from meshforge.synthesis.vocabulary import learned_vocabulary
from meshforge.synthesis.watch import Clock, Watch

DEFAULTS = Options()


def synthesize(
    demos: Sequence[Demonstration],
    batch: Iterable[SymbolicMesh] | Batch = (),
    orient: Orient | None = None,
    templates: Mapping[str, Template] | None = None,
    vocabulary: Sequence[str] | None = None,
    contact: float | None = None,
    extremity: float | None = None,
    options: Options = DEFAULTS,
    confirm: Callable[[Repair], bool] | None = None,
    answers: Sequence[Answer] = (),
    rejected: Iterable[Correction] = (),
    follow: Program | None = None,
    clock: Clock = time.monotonic,
    stop: Callable[[], bool] | None = None,
) -> Outcome:
    """The program that does on every demonstration what was shown, and whatever else these leave open.

    batch: the meshes it is meant for, by name or by their files' paths; vocabulary: labels it may ask for, by default
    all on the meshes. templates: by the paths that actions name; contact, extremity: thresholds the program is to set.
    confirm: is asked about each label that is probably wrong; without it the outcome proposes the repairs.
    answers: what a person said to earlier questions; rejected: corrections that a person refused, so the labels stand.
    follow: a program somebody had in mind; the outcome tells what became of each of its rules.
    stop: asked now and then; when it says so, what was found so far is returned, as when the time runs out.
    Raises DemonstrationError for demonstrations that contradict each other or name what is not there, ProgramError
    where the orientation fails on one of them.
    """
    meshes = named_batch(batch, demos)
    rules = agreed_rules(demos)
    labels = learned_vocabulary(demos, meshes.values(), orient, vocabulary)
    frame = Program(labels, orient, (), contact, extremity)
    watch = Watch(options.budget, clock, stop)
    asked = _Asked(confirm, rejected, watch)
    confirmed: tuple[Correction, ...] = ()
    while True:
        task = Task(
            rules,
            tuple(
                Demonstration(corrected(demo.mesh, name, confirmed), demo.steps, demo.name)
                for name, demo in named(demos)
            ),
            {name: corrected(mesh, name, confirmed) for name, mesh in meshes.items()},
            frame,
            templates or {},
            tuple(answers),
            asked.rejected,
            options,
            follow,
            confirmed,
        )
        outcome = Lesson(task, watch, asked.confirm if confirm else None).run()
        if not confirm or not isinstance(outcome, NeedsRepair):
            return outcome
        confirmed += asked.confirm_all(outcome.repairs)


class _Asked:
    """Asks a person about each correction once; what was confirmed is not to be undone by another one."""

    def __init__(self, confirm: Callable[[Repair], bool] | None, rejected: Iterable[Correction], watch: Watch) -> None:
        self._confirm, self._watch = confirm, watch
        self._decisions = dict.fromkeys(rejected, False)

    @property
    def rejected(self) -> frozenset[Correction]:
        """What is not to be proposed: what was refused, and the reverse of what was confirmed."""
        refused = {correction for correction, right in self._decisions.items() if not right}
        return frozenset(refused.union(c.reverse for c, right in self._decisions.items() if right and c.reverse))

    def confirm_all(self, repairs: Iterable[Repair]) -> tuple[Correction, ...]:
        """Those that are confirmed; of a rule's repairs none is asked about after one that is refused.

        They explain the rule together, so without one the others may be pointless; if not, they are proposed again.
        """
        right, refused = list[Correction](), set[int]()
        for repair in repairs:
            if repair.rule in refused:
                continue
            if self.confirm(repair):
                right.append(repair.correction)
            else:
                refused.add(repair.rule)
        return tuple(right)

    def confirm(self, repair: Repair) -> bool:
        """Whether a repair is confirmed."""
        assert self._confirm
        if repair.correction not in self._decisions:
            with self._watch.pause():
                self._decisions[repair.correction] = self._confirm(repair)
        return self._decisions[repair.correction]
