"""One person signs a family off: replies to the tool's questions, shows and mends what it asks for, until it asks no
more."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection
from dataclasses import dataclass, field, replace
from typing import Any

from benchmark.signoff.judge import Judge
from benchmark.signoff.point import Point
from benchmark.signoff.reviewer import Reviewer
from benchmark.signoff.tool import Tool, forget, program_of, show
from benchmark.study.condition import MOST, Condition
from benchmark.study.desk import Bench
from benchmark.study.keystrokes import CONFIRMATION, GLANCE
from benchmark.study.propagation import begin_by_hand
from meshforge.common import MeshForgeError
from meshforge.language import Program
from meshforge.signoff import Assessment, ReviewQuestion, ReviewState
from meshforge.signoff.question import CORRECT, RIGHT, WRONG
from meshforge.synthesis import Answer, LearningOutcome, NeedsRepair, NoProgram

CAP = 600.0
"""Seconds of a person after which a session is broken off."""
_SAME = 3  # times that one question is asked at most
DONE, EMPTY, BROKEN, REPEATED, HOPELESS = "done", "nothing left to ask", "broken off", "repeats itself", "nothing fits"
"""How a session ends: all signed off or set aside; assets held yet no question; after the cap; the same question time
and again; no demonstration that anything could be learned from."""


@dataclass(slots=True)
class Review:
    """One session.

    assets, possible: of the family, and those that the reference gets right under true labels; reference: those that
    it gets right under the labels there are in the end; seconds, acts: of the person, by what they did; aside: assets
    set aside; first: of each asset not demonstrated, where a right edit is possible, the probability that the tool gave
    it when it first had a program, and whether it was right; wrong: assets signed off in the end, yet not right.
    """

    task: str
    condition: str
    seed: int
    setting: str
    assets: int
    possible: int
    reference: int = 0
    ended: str = ""
    program: str | None = None
    points: list[Point] = field(default_factory=list)
    seconds: dict[str, float] = field(default_factory=dict)
    acts: dict[str, int] = field(default_factory=dict)
    aside: list[str] = field(default_factory=list)
    first: list[tuple[float, bool]] = field(default_factory=list)
    wrong: list[str] = field(default_factory=list)

    @staticmethod
    def of_json(row: dict[str, Any]) -> Review:
        first = [(share, right) for share, right in row["first"]]
        return Review(**{**row, "points": [Point(*point) for point in row["points"]], "first": first})


def sign_off(bench: Bench, condition: Condition, seed: int, tool: Tool | None = None, cap: float = CAP) -> Review:
    """A family signed off by one person; tool: another than the product, for tests."""
    return ReviewCourse(bench, condition, seed, tool or Tool(bench, condition)).run(cap)


class ReviewCourse:
    """The state of a session on its way."""

    def __init__(self, bench: Bench, condition: Condition, seed: int, tool: Tool) -> None:
        self.bench, self.tool, self.judge = bench, tool, Judge(bench)
        self.reviewer = Reviewer(bench, seed, condition)
        setting = next(iter(bench.samples.values())).setting
        family = (bench.task.name, condition.name, seed, setting)
        self.log = Review(*family, len(bench.samples), len(self.judge.possible))
        if condition.labels == "propagated":
            desk, _, painted = begin_by_hand(bench, condition.labelled)
            self.reviewer.ledger.add_labels(painted)
        else:
            desk = bench.desk(condition.labels, seed)
        self.desk = tool.take_labels(desk)
        self.state = tool.begin(self.desk)
        self.program: Program | None = None
        self._asked = Counter[str]()

    def run(self, cap: float) -> Review:
        """All of it, to the end."""
        while not self.log.ended:
            self._step(cap)
        log, ledger = self.log, self.reviewer.ledger
        log.reference = self.judge.count_right(self.desk, self.bench.task.program)
        log.program = str(self.program) if self.program else None
        log.seconds = {what: round(seconds, 2) for what, seconds in ledger.seconds.items()}
        log.acts, log.aside = dict(ledger.acts), sorted(self.state.aside)
        return log

    def _step(self, cap: float) -> None:
        """Learn, judge the family, and take what is asked."""
        try:
            outcome = self._learn()
        except MeshForgeError as error:
            self._recover(error, cap)
            return
        assessment = self.tool.review(self.desk, self.state, outcome)
        self.program = program_of(outcome)
        self._note(assessment)
        if self.reviewer.ledger.total >= cap:
            self.log.ended = BROKEN
        elif assessment.question is not None:
            shown = assessment.question.kind == "demonstrate" and assessment.question.asset in self.state.demos
            self._recover(outcome, cap) if shown else self._take(assessment.question)
        elif self.program is None:
            self._recover(outcome, cap)
        else:
            self.log.ended = DONE if assessment.is_done else EMPTY

    def _learn(self) -> LearningOutcome | None:
        """Where no program keeps all that was mended and accepted, that is forgotten, as a project does; likewise what
        was mended, where only other labels would explain it."""
        found = self.tool.learn(self.desk, self.state)
        while isinstance(found, NoProgram) and self.state.mended and self._look_at_answers(found.nearest.rule):
            found = self.tool.learn(self.desk, self.state)
        forgotten = replace(self.state, mended={}), replace(self.state, mended={}, accepted={})
        failures = (NoProgram, NeedsRepair), (NoProgram,)
        for state, kinds in zip(forgotten, failures, strict=True):
            if isinstance(found, kinds) and state != self.state:
                found = self.tool.learn(self.desk, state)
        return found

    def _look_at_answers(self, rule: int) -> bool:
        """Whether an answer about a rule was wrong, and is taken back: what was mended contradicts it."""
        answers = [one for one in self.state.answers if one.rule == rule and one.select is not None]
        self.reviewer.ledger.add("look again", GLANCE * len(answers))
        wrong = self.reviewer.person.takes_back(self.desk, answers, rule)
        if wrong is None:
            return False
        self.reviewer.ledger.add("taken back", CONFIRMATION)
        self.state = replace(self.state, answers=tuple(one for one in self.state.answers if one is not wrong))
        return True

    def _note(self, assessment: Assessment) -> None:
        right = {name for name in self.bench.samples if self._is_right(name)}
        signed = set(assessment.signed_off)
        wrong = (signed & self.judge.possible) - right
        figures = (len(right), len(signed), len(wrong), len(assessment.held), len(signed & right))
        self.log.points.append(Point(round(self.reviewer.ledger.total, 2), *figures))
        self.log.wrong = sorted(wrong)
        if self.program and not self.log.first:
            rest = [name for name in assessment.assets if name in self.judge.possible and name not in self.state.demos]
            self.log.first = [(round(assessment.assets[name].probability, 4), name in right) for name in rest]

    def _is_right(self, name: str) -> bool:
        """Whether an asset ends as wanted: as it was mended, or as the program edits it."""
        if name in self.state.mended:
            return name in self.judge.possible and self.state.mended[name] == self.bench.truth.reference[name]
        return self.judge.is_right(self.desk, self.program, name)

    def _take(self, question: ReviewQuestion) -> None:
        self._asked[question.id] += 1
        if self._asked[question.id] > _SAME:
            self.log.ended = REPEATED
        elif question.kind == "demonstrate":
            self._demonstrate(question.asset)
        else:
            self._reply(question)

    def _reply(self, question: ReviewQuestion) -> None:
        reply = self.reviewer.reply(question, self.desk, self.program)
        done = self.desk.select(self.program, question.asset) if self.program else None
        said = None if reply.choice is None or not question.choices else question.choices[reply.choice].text
        self._set(self.tool.apply(self.state, question, reply, done))
        if question.kind == "result" and said not in (RIGHT, None) and reply.mended is None:
            self._mend(question.asset, said in (WRONG, CORRECT))

    def _set(self, state: ReviewState) -> None:
        """Go on from a state; where labels changed, with all that the tool then takes them for."""
        changed = any(mesh is not self.desk.meshes[name] for name, mesh in state.meshes.items())
        if changed:
            self.desk = self.tool.take_labels(self.desk.with_meshes(state.meshes))
            state = replace(state, meshes=self.desk.meshes)
        self.state = state

    def _mend(self, name: str, wrong: bool) -> None:
        """Show what is wanted where a result is wrong; or look through its labels, where the mesh cannot be turned, or
        all is selected as wanted."""
        if not wrong:
            return
        done = self.desk.select(self.program, name) if self.program else None
        as_wanted = done == self.bench.truth.reference[name]
        turned_wrongly = as_wanted and not self.judge.looks_right(self.desk, self.program, name)
        if (done is None or turned_wrongly) and self._look_through(name):
            return
        self._demonstrate(name)

    def _look_through(self, name: str, hulls: Collection[str] | None = None) -> bool:
        """Whether a label of a mesh, of some hulls or of all, was found to be wrong, and is right now."""
        there = [hull.name for hull in self.desk.meshes[name].hulls if hulls is None or hull.name in hulls]
        desk = self.reviewer.looks_through(self.desk, name, there)
        changed = desk is not self.desk
        self._set(replace(self.state, meshes=desk.meshes))
        return changed

    def _showable(self) -> list[str]:
        """The assets that a person could show, and has not."""
        able = (name for name, wanted in self.bench.truth.reference.items() if wanted is not None)
        return [name for name in able if name not in self.state.demos and name not in self.state.aside]

    def _demonstrate(self, name: str) -> None:
        """Show an asset; one that nobody could show, or that was shown without a slip before, is set aside."""
        if name not in self._showable() and name not in self.reviewer.slipped:
            self.reviewer.ledger.add("set aside", CONFIRMATION)
            self._set(replace(self.state, aside=self.state.aside | {name}))
            return
        first = not self.state.demos
        self._show(name)
        if first:
            self._show_rules()

    def _show(self, name: str) -> None:
        unnamed = [hull.name for hull in self.desk.meshes[name].hulls if hull.label is None]
        desk = self.reviewer.paints(self.desk, name, unnamed)
        self._set(show(self.state, name, self.reviewer.shows(desk, name), desk.meshes))

    def _show_rules(self) -> None:
        """Show another asset while there is a rule that had nothing to do on any."""
        person = self.reviewer.person
        for rule in range(1, len(self.bench.task.program.rules) + 1):
            if not any(person.wants(name, rule) for name in self.state.demos) and len(self.state.demos) < MOST:
                busy = [name for name in self._showable() if person.wants(name, rule)]
                if busy:
                    self._show(person.begins_with(self.desk, busy))

    def _recover(self, found: LearningOutcome | MeshForgeError | None, cap: float) -> None:
        """Nothing was learned: begin; or take an answer back; or show once more what was shown with a slip; or look
        through the labels there, those first that are named; or take the demonstration back that nothing fits."""
        nearest = found.nearest if found is not None and not isinstance(found, MeshForgeError) else None
        named = found.where if isinstance(found, MeshForgeError) else nearest and nearest.asset
        demos, ledger = self.state.demos, self.reviewer.ledger
        if ledger.total >= cap:
            self.log.ended = BROKEN
            return
        if nearest and self._unsay(nearest.rule, nearest.asset):
            return
        if demos:
            hardest = str(named) if named in demos else [*demos][-1]
            ledger.add("look again", GLANCE)
            if hardest in self.reviewer.slipped:
                self._show(hardest)
                return
            differing = {*nearest.extra, *nearest.missing} if nearest and nearest.asset == hardest else set[str]()
            if self._look_through(hardest, differing) or self._look_through(hardest):
                return
            ledger.add("set aside", CONFIRMATION)
            self.state = forget(self.state, hardest)
        if not self.state.demos:
            if self._showable():
                self._demonstrate(self.reviewer.person.begins_with(self.desk, self._showable()))
            else:
                self.log.ended = HOPELESS

    def _unsay(self, rule: int, asset: str) -> bool:
        """Take an answer back that nothing fits: what is meant is none of the choices there."""
        for place, answer in enumerate(self.state.answers):
            if (answer.rule, answer.asset) == (rule, asset) and answer.select is not None:
                answers = list(self.state.answers)
                answers[place] = Answer(rule, asset, None)
                self.state = replace(self.state, answers=tuple(answers))
                self.reviewer.ledger.add("taken back", CONFIRMATION)
                return True
        return False
