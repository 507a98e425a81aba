"""A simulated demonstrator: knows what the task wants, shows it, looks at results, answers and confirms."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

from benchmark.study.condition import SEEN, Condition
from benchmark.study.desk import Desk, Selections
from meshforge.language import Program
from meshforge.synthesis import Answer, Demonstration, LabelFix, OpenRule, Repair, Step


class Person:
    """Draws from a seed of its own; the same seed, the same choices."""

    def __init__(self, desk: Desk, seed: int, condition: Condition) -> None:
        self._draw = random.Random(f"{seed} {desk.bench.task.name}")
        self._slips = random.Random(f"slips {seed} {desk.bench.task.name}")
        self._task, self._truth, self._errs = desk.bench.task, desk.bench.truth, condition.errs
        self._first, self._names_rules, self._excuses = condition.first, condition.names_rules, condition.excuses

    def begins_with(self, names: Sequence[str], propose: Callable[[Sequence[str]], str | None]) -> str:
        """Any mesh; or of a dozen one on which most rules have something to do: of several such the first, or the one
        that the tool proposes.

        propose: the tool's choice of some.
        """
        if self._first == "random":
            return self._draw.choice(list(names))
        some = self._draw.sample(list(names), min(SEEN, len(names)))
        most = max(map(self._busy, some))
        busy = [name for name in some if self._busy(name) == most]
        return (self._first == "advised" and propose(busy)) or busy[0]

    def _busy(self, name: str) -> int:
        wanted = self._truth.reference[name]
        return sum(map(bool, wanted or ()))

    def wants(self, name: str, rule: int) -> bool:
        """Whether a rule has something to do on a mesh."""
        wanted = self._truth.reference[name]
        return bool(wanted and wanted[rule - 1])

    def shows(self, desk: Desk, name: str, rules: frozenset[int] | None = None) -> Demonstration:
        """What is wanted on a mesh, by the eye: all rules, or some of them."""
        wanted = self._truth.reference[name]
        assert wanted is not None, f"the reference fails on {name}"
        rows = list(enumerate(zip(self._task.program.rules, wanted, strict=True), 1))
        steps = [
            Step(number, select if rules is None or number in rules else None, one.action, one.label)
            for number, (one, select) in rows
            if rules is None or number <= max(rules)
        ]
        return Demonstration(desk.meshes[name], steps, name)

    def looks_at(self, names: Sequence[str]) -> list[str]:
        """A dozen meshes, drawn anew each time."""
        return self._draw.sample(list(names), min(SEEN, len(names)))

    def accepts(self, name: str, done: Selections | None) -> bool:
        """Whether a result is as it should be, by the eye."""
        return done is not None and done == self._truth.reference[name]

    def sees(self, desk: Desk, program: Program, names: Sequence[str]) -> tuple[str, frozenset[int] | None] | None:
        """The first mesh whose result is not as it should be by the eye, and what to show there; None: all well.

        All of the edit is shown (None); or, by a person who names the rule that failed, the first such rule and those
        before it that do something else than is wanted by the eye, as they may take its hulls away. A person who
        excuses passes over what the reference gets wrong as well, since a label is wrong.
        """
        for name in names:
            done, wanted, true = desk.select(program, name), desk.reference[name], self._truth.reference[name]
            if true is None or (self._excuses and wanted is None):
                continue
            rows = list(zip(done or (None,) * len(true), wanted or (None,) * len(true), true, strict=True))
            allowed = [{eye, same} if self._excuses else {eye} for _, same, eye in rows]
            wrong = next((place for place, row in enumerate(rows) if row[0] not in allowed[place]), None)
            if wrong is not None:
                before = [place for place, (one, _, eye) in enumerate(rows[:wrong]) if one != eye]
                return name, frozenset(place + 1 for place in [*before, wrong]) if self._names_rules else None
        return None

    def answers(self, desk: Desk, one: OpenRule, program: Program) -> Answer:
        """The selection that is right, or none of them; program: what was learned so far."""
        right = self.picks(desk, (one.asset, one.rule), one.selections, program)
        said = self.slips_from(right, len(one.selections))
        if said is None:
            return Answer(one.rule, one.asset, None, one.selections)
        return Answer(one.rule, one.asset, one.selections[said])

    def picks(
        self, desk: Desk, where: tuple[str, int], choices: Sequence[frozenset[str]], program: Program
    ) -> int | None:
        """The place of the choice that is right for a rule on an asset, by the eye, or as the reference selects under
        these labels.

        program: what was learned so far, since the rule meets the mesh as the rules before it leave it.
        """
        wanted = self._answers_to(desk, where, program)
        return next((choices.index(select) for select in wanted if select in choices), None)

    def slips_from(self, right: int | None, count: int) -> int | None:
        """What the person says instead of a choice among so many, or of none, where they err."""
        if self.errs_now():
            others: list[int | None] = [place for place in (*range(count), None) if place != right]
            return self._slips.choice(others)
        return right

    def errs_now(self) -> bool:
        """Whether the next act is a slip."""
        return self._slips.random() < self._errs

    def _answers_to(self, desk: Desk, where: tuple[str, int], program: Program) -> Iterator[frozenset[str]]:
        name, place = where[0], where[1] - 1
        words = tuple(dict.fromkeys([*program.labels, *self._task.program.labels]))
        mixed = replace(program, labels=words, rules=(*program.rules[:place], self._task.program.rules[place]))
        for done in (self._truth.reference[name], desk.reference[name], desk.select(mixed, name)):
            if done is not None:
                yield done[place]

    def takes_back(self, desk: Desk, answers: Sequence[Answer], rule: int) -> Answer | None:
        """The last answer about a rule that was wrong, when a person looks at them again."""
        for answer in reversed(answers):
            known = (self._truth.reference[answer.asset], desk.reference[answer.asset])
            right = [done[rule - 1] for done in known if done is not None]
            if answer.rule == rule and answer.select is not None and answer.select not in right:
                return answer
        return None

    def confirms(self, repair: Repair) -> bool:
        """Whether a label is to be corrected so."""
        right = self.knows(repair.fix)
        return right != self.errs_now()

    def knows(self, correction: LabelFix) -> bool:
        """Whether a correction is right."""
        return self._truth.meshes[correction.asset].hull_of(correction.hull).label == correction.to
