"""Learns a program from demonstrations, rule by rule, with a replay in between (paper, stage III)."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TypedDict, assert_never

from meshforge.language import EXTREMITY, Extractor, Orient, Program, Rule, Template
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis.agreement import Agreed, agreed_rules
from meshforge.synthesis.demonstration import Demonstration, named
from meshforge.synthesis.options import Options
from meshforge.synthesis.outcome import Found, Nearest, NoProgram, Outcome, Reading, TimedOut
from meshforge.synthesis.replay import advanced, begun, example
from meshforge.synthesis.search import Answer, Hit, Miss, Search, Tried, Unfinished
from meshforge.synthesis.search.miss import NearMiss
from meshforge.synthesis.verify import verify
from meshforge.synthesis.vocabulary import learned_vocabulary
from meshforge.synthesis.watch import Clock, Watch

DEFAULTS = Options()


def synthesize(
    demos: Sequence[Demonstration],
    batch: Iterable[SymbolicMesh] = (),
    orient: Orient | None = None,
    templates: Mapping[str, Template] | None = None,
    vocabulary: Sequence[str] | None = None,
    contact: float | None = None,
    extremity: float | None = None,
    options: Options = DEFAULTS,
    confirm: Callable[[object], bool] | None = None,
    clock: Clock = time.monotonic,
) -> Outcome:
    """The program that does on every demonstration what was shown, with the smallest extractor for each rule.

    batch: the meshes it is meant for; vocabulary: labels it may ask for, by default all on the meshes.
    templates: by the paths that actions name; contact, extremity: thresholds the program is to set.
    confirm: would be asked before a label is corrected; a search for exact matches corrects none.
    Raises DemonstrationError for demonstrations that contradict each other or name what is not there, ProgramError
    where the orientation fails on one of them.
    """
    rules = agreed_rules(demos)
    labels = learned_vocabulary(demos, batch, orient, vocabulary)
    frame = Program(labels, orient, (), contact, extremity)
    return _Lesson(demos, frame, templates or {}, options, clock).learned(rules)


class _Shared(TypedDict):
    rules: tuple[Rule, ...]
    readings: tuple[Reading, ...]
    tried: tuple[Tried, ...]
    seconds: Mapping[str, float]


class _Lesson:
    """The course of learning one program: the demonstrations as replayed so far, and the rules learned so far.

    frame: the program without its rules.
    """

    def __init__(
        self,
        demos: Sequence[Demonstration],
        frame: Program,
        templates: Mapping[str, Template],
        options: Options,
        clock: Clock,
    ) -> None:
        self._demos, self._frame, self._templates, self._options = demos, frame, templates, options
        self._watch = Watch(options.budget, clock)
        self._searching = 0.0
        self._rules: list[Rule] = []
        self._tried: list[Tried] = []
        self._replays = [begun(name, demo, frame.orient, frame.contact) for name, demo in named(demos)]

    def learned(self, rules: Iterable[Agreed]) -> Outcome:
        for rule in rules:
            answer = self._answer(rule)
            self._tried.append(answer.tried)
            match answer:
                case Hit(extractor):
                    self._take(Rule(extractor, rule.action, rule.label))
                case Miss(why, nearest):
                    return NoProgram(why=why, nearest=_placed(rule.number, nearest), **self._shared())
                case Unfinished(nearest):
                    near = _placed(rule.number, nearest) if nearest else None
                    return TimedOut(nearest=near, **self._shared())
                case _:
                    assert_never(answer)
        return self._found()

    def _answer(self, rule: Agreed) -> Answer:
        examples = [shown for replay in self._replays if (shown := example(replay, rule))]
        start = self._watch.elapsed
        delta = EXTREMITY if self._frame.extremity is None else self._frame.extremity
        answer = Search(examples, self._frame.labels, self._watch, self._options, delta).run()
        self._searching += self._watch.elapsed - start
        return answer

    def _take(self, rule: Rule) -> None:
        self._rules.append(rule)
        number, delta = len(self._rules), self._frame.extremity
        self._replays = [advanced(replay, number, rule, self._templates, delta) for replay in self._replays]

    def _found(self) -> Found:
        frame = self._frame
        program = Program(frame.labels, frame.orient, tuple(self._rules), frame.contact, frame.extremity)
        verify(program, self._demos, self._templates)
        return Found(program=program, **self._shared())

    def _shared(self) -> _Shared:
        elapsed = self._watch.elapsed
        return {
            "rules": tuple(self._rules),
            "readings": tuple(_sole(number, rule.extractor) for number, rule in enumerate(self._rules, 1)),
            "tried": tuple(self._tried),
            "seconds": {"search": self._searching, "replay": elapsed - self._searching},
        }


def _sole(rule: int, extractor: Extractor) -> Reading:
    return Reading(f"{rule}.1", rule, extractor, belief=1.0)


def _placed(rule: int, miss: NearMiss) -> Nearest:
    return Nearest(rule, miss.extractor, miss.asset, miss.extra, miss.missing)
