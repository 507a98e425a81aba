"""What is to be learned in whatever frame; what frames have in common is done once."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from meshforge.errors import MeshForgeError
from meshforge.language import EXTREMITY, Extractor, Orient, Program, Rule, Template, size
from meshforge.synthesis.agreement import Agreed
from meshforge.synthesis.demonstration import Demonstration, named
from meshforge.synthesis.frames.course import Course
from meshforge.synthesis.frames.sight import Look, Met, met
from meshforge.synthesis.frames.turning import Turning
from meshforge.synthesis.options import Options
from meshforge.synthesis.replay import Replay, advanced, example
from meshforge.synthesis.search import Hit, Search, Unfinished
from meshforge.synthesis.watch import OutOfTime, Watch


class Lesson:
    """The rules to be learned, and the courses that learning them took in the frames tried so far.

    floors: nodes that each rule needs in whatever frame.
    """

    def __init__(
        self,
        demos: Sequence[Demonstration],
        rules: Sequence[Agreed],
        frame: Program,
        templates: Mapping[str, Template],
        options: Options,
        watch: Watch,
        sizes: Sequence[int] | None,
    ) -> None:
        self.rules = tuple(rules)
        self._closed = all(demo.step(rule.number) for demo in demos for rule in rules)
        self.floors = [min(nodes, 2) if self._closed else 1 for nodes in sizes or [1] * len(rules)]
        self._frame, self._templates, self._options, self._watch = frame, templates, options, watch
        self._extremity = EXTREMITY if frame.extremity is None else frame.extremity
        self._turners = [(name, demo, Turning(demo.mesh, frame.contact)) for name, demo in named(demos)]
        self._by_orient: dict[Orient, Course | None] = {}
        self._by_turns: dict[tuple[bytes, ...], Course] = {}
        self._extractors: dict[frozenset[Look], Extractor] = {}
        self._none_up_to: dict[frozenset[Look], int] = {}

    def attempt(self, orient: Orient) -> Course | None:
        """Learning in the frame of a directive, as far as it came; None where it fails on a demonstrated mesh."""
        if orient not in self._by_orient:
            self._watch.check()
            self._by_orient[orient] = self._begin(orient)
        return self._by_orient[orient]

    def _begin(self, orient: Orient) -> Course | None:
        """Directives that turn every mesh alike share one course."""
        try:
            turned = [(name, demo, *turning.turn(orient)) for name, demo, turning in self._turners]
        except MeshForgeError:
            return None
        turns = tuple(turn for *_, turn in turned)
        if turns not in self._by_turns:
            self._by_turns[turns] = Course(self, [Replay(name, demo, mesh) for name, demo, mesh, _ in turned])
        return self._by_turns[turns]

    def analyze(self, rule: Agreed, replays: Sequence[Replay]) -> Met:
        """The next rule of some replays. Raises MeshForgeError where what was shown cannot be done."""
        examples = [shown for replay in replays if (shown := example(replay, rule))]
        found = met(examples, self._frame.labels, self._options.layers, self._extremity)
        if not found.base and self._closed:  # bases select the same in every frame, unless open steps differ
            self.floors[rule.number - 1] = 2
        return found

    def find_smallest(self, rule: Met, most: int) -> Extractor | None:
        """The extractor that learning finds, if it has at most that many nodes. Raises OutOfTime."""
        if rule.base or rule.strays or most < rule.least:
            return rule.base
        if rule.signatures not in self._extractors and self._none_up_to.get(rule.signatures, 0) < most:
            self._search(rule, most)
        found = self._extractors.get(rule.signatures)
        return found if found and size(found) <= most else None

    def _search(self, rule: Met, most: int) -> None:
        options = replace(self._options, max_size=most)
        answer = Search(rule.examples, self._frame.labels, self._watch, options, self._extremity).run()
        if isinstance(answer, Unfinished):
            raise OutOfTime
        if isinstance(answer, Hit):
            self._extractors[rule.signatures] = answer.extractor
        else:
            self._none_up_to[rule.signatures] = most

    def advance(self, replays: Sequence[Replay], rule: Agreed, extractor: Extractor) -> list[Replay]:
        """The replays after one more rule. Raises MeshForgeError where its action cannot be done."""
        done = Rule(extractor, rule.action, rule.label)
        return [advanced(replay, rule.number, done, self._templates, self._frame.extremity) for replay in replays]
