"""One person signs a family off in a project: replies to its questions, shows and corrects what it asks for, until it
asks no more."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from typing import Any

from benchmark.signoff.client import Client, FamilyStatus
from benchmark.signoff.judge import Output
from benchmark.signoff.ledger import price_of_hand_by_keys
from benchmark.signoff.point import Point
from benchmark.signoff.reviewer import Reviewer
from benchmark.study.client import TaskClient
from benchmark.study.condition import MOST, Condition
from benchmark.study.desk import Bench, Desk
from benchmark.study.keystrokes import CONFIRMATION, GLANCE
from benchmark.study.labels import count_wrong
from benchmark.study.project import name_by_files, open_project
from benchmark.study.propagation import begin_by_hand
from meshforge.common import MeshForgeError
from meshforge.project import Project
from meshforge.signoff import ReviewQuestion, ReviewReply
from meshforge.signoff.question import WRONG
from meshforge.synthesis import Nearest

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
    it gets right under the labels there are in the end; seconds, by_keys, acts: of the person, by what they did, as in
    `Ledger`; all_by_hand: seconds by keys to edit each asset by hand, without the tool; aside: assets set aside;
    first: of each asset not demonstrated, where a right edit is possible, the probability that the tool gave it
    when it first had a program, and whether it was right; wrong: assets signed off in the end, yet not right;
    unseen: assets that nobody had demonstrated when there was the first program; early, early_wrong: those of them
    that were signed off then, and of these the ones that were not right; misnamed: on the meshes that were
    demonstrated by then, the labels that had been wrong; refused: repairs that were proposed though no label was
    wrong.
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
    by_keys: dict[str, float] = field(default_factory=dict)
    all_by_hand: float = 0.0
    acts: dict[str, int] = field(default_factory=dict)
    aside: list[str] = field(default_factory=list)
    first: list[tuple[float, bool]] = field(default_factory=list)
    wrong: list[str] = field(default_factory=list)
    unseen: int = 0
    early: int = 0
    early_wrong: int = 0
    misnamed: int = 0
    refused: int = 0

    @staticmethod
    def of_json(row: dict[str, Any]) -> Review:
        first = [(share, right) for share, right in row["first"]]
        return Review(**{**row, "points": [Point(*point) for point in row["points"]], "first": first})


def sign_off(
    bench: Bench, condition: Condition, seed: int, client: Callable[[Project], Client] = Client, cap: float = CAP
) -> Review:
    """A family signed off by one person in a new project; client: what they do it with."""
    bench = name_by_files(bench)
    reviewer, desk = Reviewer(bench, seed, condition), bench.desk(condition.labels, seed)
    with open_project(desk) as project:
        if condition.labels == "propagated":
            _, painted = begin_by_hand(TaskClient(project), bench, condition.labelled)
            reviewer.ledger.add_labels(painted)
        return ReviewCourse(desk, condition, seed, reviewer, client(project)).run(cap)


class ReviewCourse:
    """The state of a session on its way. shown: assets that are demonstrated, in order."""

    def __init__(self, desk: Desk, condition: Condition, seed: int, reviewer: Reviewer, client: Client) -> None:
        self.bench, self.reviewer, self.client, self.judge = desk.bench, reviewer, client, reviewer.judge
        setting = next(iter(self.bench.samples.values())).setting
        family = (self.bench.task.name, condition.name, seed, setting)
        self.log = Review(*family, len(self.bench.samples), len(self.judge.possible))
        client.take_labels()
        self._given, self.desk = desk, desk.with_meshes(client.read_meshes())
        self.shown = list[str]()
        self._given_up = set[str]()
        self._status: FamilyStatus | None = None
        self._asked = Counter[str]()

    def run(self, cap: float) -> Review:
        """All of it, to the end."""
        while not self.log.ended:
            self._step(cap)
        log, ledger, program = self.log, self.reviewer.ledger, self.client.program
        log.reference = self.judge.count_right(self.desk, self.bench.task.program)
        log.program = str(program) if program else None
        log.seconds = {what: round(seconds, 2) for what, seconds in ledger.seconds.items()}
        log.by_keys = {what: round(seconds, 2) for what, seconds in ledger.by_keys.items()}
        log.all_by_hand = round(self._price_all_by_hand(), 2)
        log.acts, log.refused = dict(ledger.acts), self.reviewer.refused
        log.aside = sorted(self._status.excluded) if self._status else []
        return log

    def _price_all_by_hand(self) -> float:
        edits = ((name, wanted) for name, wanted in self.bench.truth.reference.items() if wanted is not None)
        return sum(price_of_hand_by_keys(wanted, self.bench.find_alike(name)) for name, wanted in edits)

    def _step(self, cap: float) -> None:
        """Look how the family stands, and take what is asked."""
        try:
            status = self.client.review()
        except MeshForgeError as error:
            self._recover(None, error.where, cap)
            return
        finally:
            self.desk = self.desk.with_meshes(self.client.read_meshes())
        self._status, question = status, status.question
        self._note(status)
        if self.reviewer.ledger.total >= cap:
            self.log.ended = BROKEN
        elif question is not None and not (question.kind == "demonstrate" and question.asset in self.shown):
            self._take(question, cap)
        elif question is not None or not status.has_program:
            self._recover(status.nearest, question.asset if question else None, cap)
        else:
            self.log.ended = EMPTY if status.held else DONE

    def _note(self, status: FamilyStatus) -> None:
        aside, signed = set(status.excluded), set(status.signed_off)
        right = {name for name in self.bench.samples if name not in aside and self._is_right(name)}
        wrong = (signed & self.judge.possible) - right
        figures = (len(right), len(signed), len(wrong), len(status.held), len(signed & right))
        self.log.points.append(Point(round(self.reviewer.ledger.total, 2), *figures))
        self.log.wrong = sorted(wrong)
        if status.has_program and not self.log.first:
            self._note_first(status, right)

    def _note_first(self, status: FamilyStatus, right: set[str]) -> None:
        """How the assets stand that nobody demonstrated, when there is the first program."""
        rest = [name for name in self.bench.samples if name not in self.shown]
        shares, signed = status.probabilities, set(status.signed_off)
        able = [name for name in rest if name in self.judge.possible]
        self.log.first = [(round(shares[name], 4), name in right) for name in able if name in shares]
        true, given = self.bench.truth.meshes, self._given.meshes
        self.log.misnamed = sum(count_wrong(true[name], given[name]) for name in self.shown)
        self.log.unseen = len(rest)
        self.log.early = len(signed.intersection(rest))
        self.log.early_wrong = len(signed.intersection(able) - right)

    def _is_right(self, name: str) -> bool:
        return self.judge.is_right(name, self.client.read_output(name))

    def _take(self, question: ReviewQuestion, cap: float) -> None:
        self._asked[question.id] += 1
        if self._asked[question.id] > _SAME:
            self.log.ended = REPEATED
        elif question.kind == "demonstrate":
            self._demonstrate(question.asset)
        else:
            output = self.client.read_output(question.asset)
            reply = self.reviewer.reply(question, self.desk, self.client.program, output)
            if question.kind == "result" and reply.choice == WRONG:
                self._correct(question, reply, output)
            else:
                self._reply(question, reply)

    def _reply(self, question: ReviewQuestion, reply: ReviewReply) -> None:
        """Reply; where that is refused the question is asked again."""
        with suppress(MeshForgeError):
            self.client.reply(question, reply)

    def _correct(self, question: ReviewQuestion, reply: ReviewReply, output: Output | None) -> None:
        """Say what is right of a result that is wrong: which hulls, or which labels where the mesh is turned wrongly or
        the program cannot run; where no label helps, show the whole edit."""
        name = question.asset
        if not self.client.says_what_is_right:
            self._reply(question, reply)
            return
        done, wanted = output.selections if output else None, self.bench.truth.reference[name]
        if done is not None and wanted is not None and done != wanted:
            selections = self.reviewer.correct_selections(name, done, wanted)
            self._reply(question, replace(reply, selections=selections))
            return
        there = [hull.name for hull in self.desk.meshes[name].hulls]
        labels = self.reviewer.inspect_labels(self.desk, name, there)
        self._reply(question, replace(reply, labels=labels))
        if labels:
            self.client.take_labels()
            self.desk = self.desk.with_meshes(self.client.read_meshes())
        elif self.client.shows_corrections and (name in self._showable() or name in self.reviewer.slipped):
            self._show(name, "correction")

    def _look_through(self, name: str, hulls: Collection[str] | None = None) -> bool:
        """Whether a label of a mesh, of some hulls or of all, was found to be wrong, and is right now."""
        there = [hull.name for hull in self.desk.meshes[name].hulls if hulls is None or hull.name in hulls]
        labels = self.reviewer.inspect_labels(self.desk, name, there)
        return self._set_labels(name, labels)

    def _set_labels(self, name: str, labels: Mapping[str, str]) -> bool:
        """Whether there are labels to give; if so they are given."""
        if labels:
            self.client.set_labels(name, labels)
            self.desk = self.desk.with_meshes(self.client.read_meshes())
        return bool(labels)

    def _showable(self) -> list[str]:
        """The assets that a person could show, and has not."""
        able = (name for name, wanted in self.bench.truth.reference.items() if wanted is not None)
        return [name for name in able if name not in self.shown and name not in self._given_up]

    def _demonstrate(self, name: str) -> None:
        """Show an asset that is asked for; in place of one that nobody could show, or that was shown without a slip
        before, another one."""
        able, first = self._showable(), not self.shown
        if name not in able and name not in self.reviewer.slipped:
            if not able:
                self.log.ended = HOPELESS
                return
            name = self.reviewer.person.begins_with(able, self.client.propose_first)
        self._show(name)
        if first:
            self._show_rules()

    def _show(self, name: str, act: str = "demonstration") -> None:
        unnamed = [hull.name for hull in self.desk.meshes[name].hulls if hull.label is None]
        self._set_labels(name, self.reviewer.name_hulls(name, unnamed))
        self.client.demonstrate(name, self.reviewer.shows(self.desk, name, act).steps)
        self.shown = [*(other for other in self.shown if other != name), name]

    def _show_rules(self) -> None:
        """Show another asset while there is a rule that had nothing to do on any."""
        person = self.reviewer.person
        for rule in range(1, len(self.bench.task.program.rules) + 1):
            if not any(person.wants(name, rule) for name in self.shown) and len(self.shown) < MOST:
                busy = [name for name in self._showable() if person.wants(name, rule)]
                if busy:
                    self._show(person.begins_with(busy, self.client.propose_first))

    def _recover(self, nearest: Nearest | None, named: str | None, cap: float) -> None:
        """Nothing was learned: begin; or take an answer back; or show once more what was shown with a slip; or look
        through the labels there, those first that are named; or take the demonstration back that nothing fits."""
        if self.reviewer.ledger.total >= cap:
            self.log.ended = BROKEN
            return
        if nearest and self._refuse_choices(nearest.rule, nearest.asset):
            return
        if self.shown and self._look_again(named if named and named in self.shown else self.shown[-1], nearest):
            return
        if not self.shown:
            self._demonstrate("")

    def _look_again(self, name: str, nearest: Nearest | None) -> bool:
        """Whether a demonstration that nothing fits, or its labels, could be corrected; else it is taken back."""
        self.reviewer.ledger.add("look again", GLANCE)
        if name in self.reviewer.slipped:
            self._show(name)
            return True
        differing = {*nearest.extra, *nearest.missing} if nearest and nearest.asset == name else set[str]()
        if self._look_through(name, differing) or self._look_through(name):
            return True
        self.reviewer.ledger.add("taken back", CONFIRMATION)
        self.client.take_demonstration_back(name)
        self.shown.remove(name)
        self._given_up.add(name)
        return False

    def _refuse_choices(self, rule: int, asset: str) -> bool:
        """Take an answer back that nothing fits: what is meant is none of the choices there."""
        for answer in self.client.answers:
            if (answer.rule, answer.asset) == (rule, asset) and answer.select is not None:
                self.client.refuse_choices(answer)
                self.reviewer.ledger.add("taken back", CONFIRMATION)
                return True
        return False
