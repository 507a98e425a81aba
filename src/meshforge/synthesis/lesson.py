"""The course of learning one program: rule by rule, each on the meshes that the rules before it make."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TypedDict, assert_never

from meshforge.errors import MeshForgeError
from meshforge.language import Program, Rule
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis.agreement import Agreed
from meshforge.synthesis.asking import Answer, Question, Repair
from meshforge.synthesis.batch import Course
from meshforge.synthesis.correction import Correction
from meshforge.synthesis.example import Example
from meshforge.synthesis.failure import advice
from meshforge.synthesis.follow import followed, unfollowed
from meshforge.synthesis.frames import Suggested, suggest_orientation
from meshforge.synthesis.guidance import hint, question, reading_id
from meshforge.synthesis.outcome import Ambiguous, Found, Nearest, NeedsRepair, NoProgram, Outcome, Reading, TimedOut
from meshforge.synthesis.paper import Explained, paper_search
from meshforge.synthesis.readings import Weighed, every
from meshforge.synthesis.repairs import Repairs, inquiry
from meshforge.synthesis.sample import sample
from meshforge.synthesis.search import Hit, Miss, Search, Tried, Unfinished
from meshforge.synthesis.search.miss import NearMiss
from meshforge.synthesis.task import Task
from meshforge.synthesis.verify import verify
from meshforge.synthesis.watch import OutOfTime, Watch

PLAIN = 7
"""Nodes up to which an extractor is plain enough to speak for an orientation that is suggested."""


@dataclass(frozen=True, slots=True)
class Learned:
    """One rule, its readings, and the names of the meshes in their field."""

    rule: Rule
    readings: Weighed
    names: tuple[str, ...]


class _Shared(TypedDict):
    rules: tuple[Rule, ...]
    readings: tuple[Reading, ...]
    tried: tuple[Tried, ...]
    seconds: Mapping[str, float]
    stale: tuple[Answer, ...]
    followed: tuple[str, ...]


class Lesson:
    """Learns the rules of a task one after the other, as far as it gets."""

    def __init__(self, task: Task, watch: Watch, confirm: Callable[[Repair], bool] | None = None) -> None:
        self._task, self._watch, self._confirm = task, watch, confirm
        self._replays = Course(task.demos, task.batch, task.frame, task.templates, task.answers)
        self._learned: list[Learned] = []
        self._tried: list[Tried] = []
        self._question: Question | None = None
        self._searching = 0.0
        self._followed = list(unfollowed(task, task.follow)) if task.follow else []
        meshes = {replay.name: replay.mesh for replay in [*self._replays.shown, *self._replays.others]}
        self._repairs = Repairs(task, meshes, watch)

    def run(self) -> Outcome:
        """What comes of it."""
        for agreed in self._task.rules:
            failed = self._learn(agreed)
            if failed:
                return failed
        return self._propose_repairs() if self._repairs.repairs else self._finish()

    def _learn(self, agreed: Agreed) -> Outcome | None:
        """Learn one rule and run it on all meshes; what stands in the way, if anything does."""
        while True:
            examples, rest = self._replays.examples(agreed)
            names = (*(example.name for example in examples), *(replay.name for replay in rest))
            start = self._watch.elapsed
            found = self._find_readings(agreed, examples, [replay.mesh for replay in rest])
            self._searching += self._watch.elapsed - start
            if not isinstance(found, tuple):
                self._follow(agreed, found if isinstance(found, Weighed) else None, names, examples)
            match found:
                case Weighed():
                    self._accept(agreed, found, names)
                    return None
                case Miss():
                    return self._fail(agreed, found, examples)
                case Unfinished():
                    nearest = _placed(agreed.number, found.nearest) if found.nearest else None
                    return TimedOut(nearest=nearest, **self._common_fields())
                case tuple():
                    self._replays.correct(found)
                case _:
                    assert_never(found)

    def _find_readings(
        self, agreed: Agreed, examples: Sequence[Example], rest: Sequence[SymbolicMesh]
    ) -> Weighed | Miss | Unfinished | tuple[Correction, ...]:
        """The readings of a rule; or corrections of labels, with which it is to be looked at again."""
        task, watch = self._task, self._watch
        if task.options.strategy == "paper":
            return self._find_by_paper(agreed, examples, rest)
        search = Search(examples, task.frame.labels, watch, task.options, task.extremity, rest)
        found = search.run()
        self._record_effort(agreed, found.tried)
        if isinstance(found, Unfinished):
            return found
        try:
            corrections = self._repairs.find_corrections(agreed.number, examples, found)
        except OutOfTime:
            corrections = ()
        if corrections:
            return corrections
        if isinstance(found, Miss):
            return found
        refused = self._replays.rejections(agreed.number, search.field.meshes)
        return Weighed(search, every(search, found.extractor, task.options.above), refused)

    def _find_by_paper(
        self, agreed: Agreed, examples: Sequence[Example], rest: Sequence[SymbolicMesh]
    ) -> Weighed | Miss | Unfinished | tuple[Correction, ...]:
        task = self._task
        found = paper_search(
            examples,
            task.frame.labels,
            self._watch,
            task.options,
            task.extremity,
            inquiry(agreed.number, self._confirm) if self._confirm else None,
            task.rejected,
            self._repairs.counts,
        )
        self._record_effort(agreed, found.tried)
        if isinstance(found, Explained):
            return self._repairs.record_inferred(agreed.number, found)
        if not isinstance(found, Hit):
            return found
        search = Search(examples, task.frame.labels, self._watch, task.options, task.extremity, rest)
        return Weighed.of_single(search, found.extractor)

    def _follow(
        self, agreed: Agreed, weighed: Weighed | None, names: Sequence[str], examples: Sequence[Example]
    ) -> None:
        wanted = self._task.follow
        if wanted and agreed.number <= len(wanted.rules):
            extractor = wanted.rules[agreed.number - 1].extractor
            self._followed.append(followed(agreed, extractor, weighed, names, examples, self._task))

    def _accept(self, agreed: Agreed, weighed: Weighed, names: tuple[str, ...]) -> None:
        rule = Rule(weighed.extractor, agreed.action, agreed.label)
        self._learned.append(Learned(rule, weighed, names))
        if not self._question:
            declined = {a.asset for a in self._task.answers if a.rule == agreed.number and a.select is None}
            self._question = question(agreed.number, weighed, names, self._repairs.trust, declined)
        self._replays.advance(agreed.number, rule, last=agreed.number == len(self._task.rules))

    def _finish(self) -> Outcome:
        task, program = self._task, self._program()
        verify(program, task.demos, task.templates)
        known = [(learned.readings, learned.names) for learned in self._learned]
        ahead, looks = hint(known), sample(known, self._repairs.trust)
        if self._question:
            return Ambiguous(program=program, question=self._question, hint=ahead, sample=looks, **self._common_fields())
        settled = bool(self._replays.others) and all(learned.readings.settled for learned in self._learned)
        return Found(program=program, settled=settled, hint=ahead, sample=looks, **self._common_fields())

    def _propose_repairs(self) -> Outcome:
        return NeedsRepair(repairs=self._repairs.repairs, proposed=self._program(), **self._common_fields())

    def _fail(self, agreed: Agreed, miss: Miss, examples: Sequence[Example]) -> Outcome:
        nearest, repairs = _placed(agreed.number, miss.nearest), self._repairs.repairs
        if repairs:
            return NeedsRepair(repairs=repairs, nearest=nearest, **self._common_fields())
        answered = self._replays.assets_with_answers(agreed.number)
        return NoProgram(
            why=miss.why,
            nearest=nearest,
            advice=advice(miss.nearest, examples, answered),
            suggested=self._suggest_orientation(),
            **self._common_fields(),
        )

    def _suggest_orientation(self) -> Suggested | None:
        task = self._task
        try:
            return suggest_orientation(
                task.demos,
                task.rules,
                task.frame,
                task.templates,
                replace(task.options, max_size=min(task.options.max_size, PLAIN)),
                self._watch,
                None,
                list(task.batch.values()),
            )
        except (OutOfTime, MeshForgeError):
            return None

    def _program(self) -> Program:
        rules = tuple(learned.rule for learned in self._learned)
        return replace(self._task.frame, rules=rules)

    def _record_effort(self, agreed: Agreed, tried: Tried) -> None:
        self._tried = [*self._tried[: agreed.number - 1], tried]

    def _common_fields(self) -> _Shared:
        elapsed = self._watch.elapsed
        return {
            "rules": tuple(learned.rule for learned in self._learned),
            "readings": tuple(
                reading
                for number, learned in enumerate(self._learned, 1)
                for reading in _readings(number, learned.readings, learned.names)
            ),
            "tried": tuple(self._tried),
            "seconds": {"search": self._searching, "replay": elapsed - self._searching},
            "stale": self._replays.stale,
            "followed": tuple(self._followed),
        }


def _readings(rule: int, weighed: Weighed, names: Sequence[str]) -> Iterator[Reading]:
    for place, (term, belief) in enumerate(zip(weighed.terms, weighed.beliefs, strict=True)):
        differs = tuple(names[k] for k in weighed.differences(place))
        yield Reading(reading_id(rule, place), rule, term.extractor, belief, differs)


def _placed(rule: int, miss: NearMiss) -> Nearest:
    return Nearest(rule, miss.extractor, miss.asset, miss.extra, miss.missing)
