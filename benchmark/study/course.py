"""One person teaches one task: demonstrations, questions, confirmations, looks at the result (paper, protocol)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from time import perf_counter

from benchmark.study.client import TaskClient
from benchmark.study.condition import MOST, Condition
from benchmark.study.desk import Bench, Desk, Selections
from benchmark.study.person import Person
from benchmark.study.project import name_by_files, open_project
from benchmark.study.propagation import HandLabels, begin_by_hand, label_by_hand
from benchmark.study.sample import select_sample
from benchmark.study.session import Round, Session
from meshforge.common import MeshForgeError, UsageError
from meshforge.language import Program
from meshforge.synthesis import Ambiguous, LearningOutcome, Repair

_ANSWERS = 12  # that a person gives between two demonstrations at most


def teach_task(
    bench: Bench, condition: Condition, seed: int, others: Sequence[Bench] = (), *, takes_labels: bool = False
) -> Session:
    """A task taught by one person under a condition, in a new project on disk.

    others: further decompositions of the same assets; takes_labels: whether the labels are first taken as all sources
    together speak for them.
    """
    with open_course(name_by_files(bench), condition, seed, takes_labels=takes_labels) as course:
        log = course.session(others)
    shown = [name.rpartition(".")[0] for name in log.shown]
    return replace(log, shown=shown, failures={name.rpartition(".")[0]: why for name, why in log.failures.items()})


@contextmanager
def open_course(
    bench: Bench,
    condition: Condition,
    seed: int,
    watch: Callable[[Program | None], None] | None = None,
    *,
    takes_labels: bool = False,
) -> Iterator[Course]:
    """A session before anything is shown; the meshes of the bench have the names that `name_by_files` gives."""
    desk = bench.desk(condition.labels, seed)
    with open_project(desk) as project:
        client = TaskClient(project)
        if takes_labels:
            client.take_labels()
        yield Course(desk, client, condition, seed, watch)


class Course:
    """The state of a session on its way. All that the person does and the tool makes of it goes through the client.

    desk: the meshes as they are labelled in the project; watch: called with the program after each round.
    """

    def __init__(
        self,
        desk: Desk,
        client: TaskClient,
        condition: Condition,
        seed: int,
        watch: Callable[[Program | None], None] | None = None,
    ) -> None:
        bench = desk.bench
        self.bench, self.desk, self.client, self.condition, self._watch = bench, desk, client, condition, watch
        self.log = Session(bench.task.name, condition.name, seed, next(iter(bench.samples.values())).setting)
        self.by_hand = frozenset[str]()
        """Meshes that were labelled before any was demonstrated; they are not judged."""
        if condition.labels == "propagated":
            self.by_hand, painted = begin_by_hand(client, bench, condition.labelled)
            self._count(painted)
        self._read_labels()
        self.person = Person(self.desk, seed, condition)
        self.able = [name for name, done in bench.truth.reference.items() if done is not None]
        self.given: dict[str, frozenset[int] | None] = {}
        """Meshes with the rules that were shown on them, None for all."""
        self.accepted: dict[str, Selections] = {}
        """Results that were found right when they were looked at."""
        self.outcome: LearningOutcome | MeshForgeError = UsageError("nothing was shown")
        """What the tool made of it when it last learned."""
        self.clean: Program | None = None
        """The last program of which all results that were looked at were right."""
        self.found_right = frozenset[str]()
        """The meshes of those results."""

    def session(self, others: Sequence[Bench]) -> Session:
        if not self._showable():
            return self._give_up(others)
        self._begin()
        while True:
            outcome = self._learn()
            if self._answer(outcome) or self._label_landmarks(outcome):
                continue
            if isinstance(outcome, MeshForgeError) or outcome.program is None:
                if not self._another(outcome):
                    break
                continue
            if not self._looks_on(outcome, outcome.program):
                break
        self._judge(outcome, others)
        return self.log

    def _give_up(self, others: Sequence[Bench]) -> Session:
        """Nothing can be shown: the reference fails on every mesh."""
        self._note("refused", None, False, {"all": 0.0})
        self._judge(UsageError("there is no mesh on which anything could be shown"), others)
        return self.log

    def _read_labels(self) -> None:
        self.desk = self.desk.with_labels_of(self.client.read_meshes())

    def _count(self, painted: HandLabels) -> None:
        self.log.inspected += painted.inspected
        self.log.typed += painted.typed
        self.log.strokes += painted.strokes

    def _rest(self) -> list[str]:
        """The meshes that are not demonstrated."""
        return [name for name in self.bench.samples if name not in self.log.shown]

    def _showable(self) -> list[str]:
        """Those of them on which the reference can run: a person could show what is wanted there."""
        return [name for name in self.able if name not in self.log.shown]

    def _show(self, name: str, new: frozenset[int] | None) -> None:
        """Show some rules on a mesh, besides those that were shown there before, or all rules."""
        self.given[name] = new and new | (self.given.get(name) or frozenset())
        self.log.shown.append(name)
        if self.condition.labels == "propagated":
            painted, _ = label_by_hand(self.client, self.bench, name)
            self._count(painted)
            self._read_labels()
        self.client.demonstrate(name, self.person.shows(self.desk, name, self.given[name]).steps)
        steps = [step.select for step in self.person.shows(self.desk, name, new).steps if step.select]
        self.log.steps_shown += len(steps)
        self.log.hulls_shown += sum(map(len, steps))

    def _begin(self) -> None:
        """Show a mesh, and another one while there is a rule that had nothing to do on any."""
        self._show(self.person.begins_with(self._showable(), self.client.propose_first), None)
        for rule in range(1, len(self.bench.task.program.rules) + 1):
            if not any(self.person.wants(name, rule) for name in self.given) and len(self.log.shown) < MOST:
                busy = [name for name in self._showable() if self.person.wants(name, rule)]
                if busy:
                    self._show(self.person.begins_with(busy, self.client.propose_first), None)

    def _learn(self) -> LearningOutcome | MeshForgeError:
        """What the tool makes of it, or why it refuses the demonstrations."""
        start = perf_counter()
        try:
            outcome: LearningOutcome | MeshForgeError = self.client.synthesize(self.condition.options, self._confirm)
        except MeshForgeError as error:
            outcome = error
        self.outcome, seconds = outcome, {"all": perf_counter() - start}
        self._read_labels()
        if isinstance(outcome, MeshForgeError):
            self._note("refused", None, False, seconds)
            return outcome
        if outcome.program and not self.log.known_among:
            self.log.known_among = self._find_right_readings(outcome)
        self._note(outcome.status, outcome.program, outcome.unambiguous, {**seconds, **outcome.seconds})
        return outcome

    def _note(self, status: str, program: Program | None, settled: bool, seconds: dict[str, float]) -> None:
        log, differs = self.log, len(self.desk.find_differences(program, self._rest()))
        log.rounds.append(Round(len(log.shown), log.answers, differs, status, _text(program), settled, seconds))
        if self._watch:
            self._watch(program)

    def _label_landmarks(self, outcome: LearningOutcome | MeshForgeError) -> bool:
        """Whether labels were given by hand: to the landmarks of a demonstrated mesh that could not be oriented."""
        if not isinstance(outcome, MeshForgeError) or outcome.where not in self.given:
            return False
        landmarks = Program(orient=self.bench.task.program.orient).labels_in_use
        mesh, true = self.desk.meshes[outcome.where], self.bench.truth.meshes[outcome.where]
        pairs = [(hull, true.hull_of(hull.name).label) for hull in mesh.hulls]
        wrong = {hull.name: to for hull, to in pairs if to and to in landmarks and hull.label != to}
        self.client.set_labels(outcome.where, wrong)
        self._read_labels()
        self._count(HandLabels(len(mesh.hulls), len(wrong), len(set(wrong.values()))))
        return bool(wrong)

    def _find_right_readings(self, outcome: LearningOutcome) -> list[bool]:
        """For each rule, whether one of its readings behaves as the reference does on every mesh."""
        rules, readings = range(len(self.bench.task.program.rules)), outcome.candidates
        able = [name for name in self.able if self.desk.reference[name] is not None]
        return [
            any(self.desk.behaves(r.extractor, place, able) for r in readings if r.rule == place + 1) for place in rules
        ]

    def _confirm(self, repair: Repair) -> bool:
        said, log = self.person.confirms(repair), self.log
        log.rightly += said == self.person.knows(repair.fix)
        log.confirmed += said
        log.refused += not said
        return said

    def _answer(self, outcome: LearningOutcome | MeshForgeError) -> bool:
        """Whether a question of the tool was answered."""
        since = self.log.answers - self.log.rounds[-1].answers if self.log.rounds else 0
        if not self.condition.questions or not isinstance(outcome, Ambiguous) or since >= _ANSWERS:
            return False
        if sum(row.demonstrations == len(self.log.shown) for row in self.log.rounds) > _ANSWERS:
            return False
        answer = self.person.answers(self.desk, outcome.open_rule, outcome.program)
        self.client.project.add_answer(answer)
        self.log.answers += 1
        self.log.neither += answer.select is None
        return True

    def _another(self, outcome: LearningOutcome | MeshForgeError) -> bool:
        """No program fits, and the tool names a mesh: an answer about it is taken back; a demonstration of some rules,
        whose hulls are gone, shows the others, too; else it is set aside, and another mesh demonstrated.
        """
        nearest = None if isinstance(outcome, MeshForgeError) else outcome.nearest
        if nearest and self._unsaid(nearest.rule, nearest.asset):
            return True
        named = outcome.where if isinstance(outcome, MeshForgeError) else nearest and nearest.asset
        hardest = named if named in self.given else next(reversed(self.given))
        if isinstance(outcome, MeshForgeError) and self.given[hardest] is not None and len(self.log.shown) < MOST:
            self._show(hardest, None)
            return True
        del self.given[hardest]
        self.client.take_demonstration_back(hardest)
        self.log.set_aside += 1
        if len(self.log.shown) < MOST and self._showable():
            self._begin()
        return any(rules is None for rules in self.given.values())

    def _unsaid(self, rule: int, asset: str) -> bool:
        """Take an answer back that nothing fits, if it is one: what is meant is none of the choices there."""
        for answer in self.client.answers:
            if (answer.rule, answer.asset) == (rule, asset) and answer.select is not None and asset not in self.given:
                self.client.refuse_choices(answer)
                self.log.taken_back += 1
                return True
        return False

    def _looks_on(self, outcome: LearningOutcome, program: Program) -> bool:
        """Look at a dozen results; go on where one is wrong: take an answer back, or demonstrate what is wanted there.

        A guided person reports those that are right to the tool, and accepts the program if it keeps it then.
        """
        self.log.accepted = program == self.clean
        if self.log.accepted:
            return False
        guided = self.condition.guided
        names = self._worth_a_look(outcome) if guided else self.person.looks_at(self._showable())
        seen = self.person.sees(self.desk, program, names)
        looked_at = names[: names.index(seen[0])] if seen else names
        self.log.glances += len(looked_at) + (seen is not None)
        if guided:
            self._accept(program, looked_at)
        if seen is None:
            self.clean, self.log.accepted = program, not guided
            self.found_right = frozenset(looked_at)
            return guided
        name, rules = seen
        wrong = rules and self.person.takes_back(self.desk, self.client.answers, max(rules))
        if wrong:
            self.client.take_answer_back(wrong)
            self.log.taken_back += 1
            return True
        if len(self.log.shown) >= MOST:
            return False
        self._show(name, rules)
        return True

    def _worth_a_look(self, outcome: LearningOutcome) -> list[str]:
        """Those of a dozen telling meshes on which a person knows what is wanted, and may still show it."""
        known = {*self.accepted, *(name for name, rules in self.given.items() if rules is None)}
        sample = select_sample(outcome, self.desk.meshes, self.bench.task.program.labels, known)
        return [n for n in sample if n in self.able and (n not in self.log.shown or self.given.get(n) is not None)]

    def _accept(self, program: Program, names: Iterable[str]) -> None:
        for name in names:
            done = self.desk.select(program, name)
            if done is not None and self.person.accepts(name, done) and self.accepted.get(name) != done:
                self.client.accept(name)
                self.log.approvals += 1
                self.accepted[name] = done

    def _judge(self, outcome: LearningOutcome | MeshForgeError, others: Sequence[Bench]) -> None:
        """How good the last program is on all meshes that were neither demonstrated nor labelled before."""
        log, bench = self.log, self.bench
        rest = [name for name in self._rest() if name not in self.by_hand]
        program = None if isinstance(outcome, MeshForgeError) else outcome.program
        log.program, log.right, log.settled = _text(program), log.rounds[-1].right, log.rounds[-1].settled
        log.right_on_true = bool(program) and not bench.truth.find_differences(program, rest)
        log.right_elsewhere = self._is_right_on(program, others) if others else None
        log.judged, log.judged_pure = len(rest), sum(name in bench.pure for name in rest)
        log.f1, log.labels_right = self.desk.measure_f1(program, rest), self.desk.share_labels_right(rest)
        for name in rest:
            why = bench.failure(name, self.desk.edit(program, name)) if program else "no program was learned"
            if why:
                log.failures[name] = why
                log.failed_pure += name in bench.pure
        reference = bench.task.program
        log.reference_failed = sum(bool(bench.failure(name, self.desk.edit(reference, name))) for name in rest)
        log.ceiling_failed = sum(bool(bench.failure(name, bench.truth.edit(reference, name))) for name in rest)

    def _is_right_on(self, program: Program | None, others: Sequence[Bench]) -> bool:
        """Whether a program behaves as the reference on other decompositions of what was not shown, true labels."""
        known = {self.bench.samples[name].asset.name for name in [*self.log.shown, *self.by_hand]}
        return not any(
            other.truth.find_differences(
                program, [n for n, row in other.samples.items() if row.asset.name not in known]
            )
            for other in others
        )


def _text(program: Program | None) -> str | None:
    return str(program) if program else None
