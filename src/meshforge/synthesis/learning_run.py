"""One run of learning: rule by rule, each on the meshes that the rules before it make; the program is run again on
every demonstration before it is returned."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TypedDict, assert_never

from meshforge.common import MeshForgeError
from meshforge.language import Orient, Program, Rule, Template
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import outcome
from meshforge.synthesis.asset_selection import find_open_rule
from meshforge.synthesis.candidates.rank import RankedCandidates, enumerate_consistent
from meshforge.synthesis.demonstration import (
    Answer,
    Demonstration,
    Example,
    LabelFix,
    OpenRule,
    Repair,
    RuleSpec,
    name_demonstrations,
)
from meshforge.synthesis.diagnosis import give_advice
from meshforge.synthesis.options import OutOfTime, TimeBudget
from meshforge.synthesis.orientation.alternatives import find_more_believable
from meshforge.synthesis.orientation.suggest import (
    MIN_SAVING,
    OrientationSuggestion,
    explain_orientation,
    suggest_orientation,
)
from meshforge.synthesis.paper.search import HitWithFixes, PaperSearch
from meshforge.synthesis.repair.explain import RepairCollector, make_confirmer
from meshforge.synthesis.search.smallest import Hit, Miss, Search, SearchEffort, Unfinished
from meshforge.synthesis.task import LearningTask, ReplaySet, correct_demonstrations, memoize

PLAIN_SIZE = 7
"""Nodes up to which an extractor is plain enough to speak for an orientation that is suggested."""


class _OutcomeFields(TypedDict):
    rules: tuple[Rule, ...]
    candidates: tuple[outcome.CandidateProgram, ...]
    tried: tuple[SearchEffort, ...]
    seconds: Mapping[str, float]
    stale: tuple[Answer, ...]


@dataclass(frozen=True, slots=True)
class _RuleOutcome:
    """One rule, its readings, and the names of the meshes in their field."""

    rule: Rule
    candidates: RankedCandidates
    names: tuple[str, ...]

    @property
    def size(self) -> int:
        """Nodes of the extractor."""
        return self.candidates.terms[0].size

    def select(self) -> dict[str, frozenset[str]]:
        """Return the names of the hulls that the rule selects on each mesh of the field."""
        field, bits = self.candidates.field, self.candidates.terms[0].bits
        rows = zip(self.names, field.meshes, strict=True)
        return {name: frozenset(mesh.names_of(field.on(bits, place))) for place, (name, mesh) in enumerate(rows)}

    def list_candidates(self, rule: int) -> Iterator[outcome.CandidateProgram]:
        """Yield the readings, the most believable first; rule: its number."""
        ranked = self.candidates
        for place, (term, belief) in enumerate(zip(ranked.terms, ranked.beliefs, strict=True)):
            differs = tuple(self.names[k] for k in ranked.differences(place))
            yield outcome.CandidateProgram(f"{rule}.{place + 1}", rule, term.extractor, belief, differs)


class LearningRun:
    """Learns the rules of a task one after the other, as far as it gets."""

    def __init__(self, task: LearningTask, budget: TimeBudget, confirm: Callable[[Repair], bool] | None = None) -> None:
        self._task, self._budget, self._confirm = task, budget, confirm
        self._replays = ReplaySet(task)
        self._learned: list[_RuleOutcome] = []
        self._tried: list[SearchEffort] = []
        self._open_rule: OpenRule | None = None
        self._searching = 0.0
        meshes = {replay.name: replay.mesh for replay in [*self._replays.shown, *self._replays.others]}
        self._repairs = RepairCollector(task, meshes, budget)

    def run(self) -> outcome.LearningOutcome:
        """Return what comes of it."""
        failed = next((failure for spec in self._task.rules if (failure := self._learn(spec))), None)
        if self._question_landmarks(failed):
            return outcome.NeedsRepair(
                repairs=self._repairs.repairs, proposed=self._learn_with_repairs(), **self._common_fields()
            )
        if failed:
            return failed
        if self._repairs.repairs:
            return outcome.NeedsRepair(repairs=self._repairs.repairs, proposed=self._program(), **self._common_fields())
        return self._finish()

    def _question_landmarks(self, failed: outcome.LearningOutcome | None) -> bool:
        """Whether labels of landmarks are rather wrong than the rules as they are; the repairs are theirs then."""
        if isinstance(failed, outcome.TimedOut):
            return False
        try:
            learned = [one.rule.extractor for one in self._learned]
            return self._repairs.find_landmark_fixes(learned, failed is not None)
        except OutOfTime:
            return False

    def _learn_with_repairs(self) -> Program | None:
        fixes, task = [repair.fix for repair in self._repairs.repairs], self._task
        options = replace(task.options, repair=False, suggest_orientation=False)
        corrected = replace(task, demos=correct_demonstrations(task.demos, fixes), options=options)
        return LearningRun(corrected, self._budget).run().program

    def _learn(self, spec: RuleSpec) -> outcome.LearningOutcome | None:
        """Learn one rule and run it on all meshes; what stands in the way, if anything does."""
        while True:
            examples, rest = self._replays.examples(spec)
            names = (*(example.name for example in examples), *(replay.name for replay in rest))
            start = self._budget.elapsed
            found = self._find_candidates(spec, examples, [replay.mesh for replay in rest])
            self._searching += self._budget.elapsed - start
            match found:
                case RankedCandidates():
                    self._accept(spec, found, names)
                    return None
                case Miss():
                    return self._fail(spec, found, examples)
                case Unfinished():
                    nearest = outcome.Nearest.of(spec.number, found.nearest) if found.nearest else None
                    return outcome.TimedOut(nearest=nearest, **self._common_fields())
                case tuple():
                    self._replays.correct(found)
                case _:
                    assert_never(found)

    def _find_candidates(
        self, spec: RuleSpec, examples: Sequence[Example], rest: Sequence[SymbolicMesh]
    ) -> RankedCandidates | Miss | Unfinished | tuple[LabelFix, ...]:
        """The readings of a rule; or corrections of labels, with which it is to be looked at again."""
        task, budget = self._task, self._budget
        if task.options.strategy == "paper":
            return self._find_by_paper(spec, examples, rest)
        search = Search(examples, task.frame.labels, budget, task.options, rest)
        found = search.run()
        self._record_effort(spec, found.tried)
        if isinstance(found, Unfinished):
            return found
        try:
            fixes = self._repairs.find_fixes(spec.number, examples, found)
        except OutOfTime:
            fixes = ()
        if fixes:
            return fixes
        if isinstance(found, Miss):
            return found
        preferences = self._replays.preferences(spec.number, search.field.meshes)
        return RankedCandidates(search, enumerate_consistent(search, found.extractor, task.options.above), preferences)

    def _find_by_paper(
        self, spec: RuleSpec, examples: Sequence[Example], rest: Sequence[SymbolicMesh]
    ) -> RankedCandidates | Miss | Unfinished | tuple[LabelFix, ...]:
        task = self._task
        confirm = make_confirmer(spec.number, self._confirm) if self._confirm else None
        found = PaperSearch(
            examples, task.frame.labels, self._budget, task.options, confirm, task.rejected, self._repairs.counts
        ).run()
        self._record_effort(spec, found.tried)
        if isinstance(found, HitWithFixes):
            return self._repairs.record_inferred(spec.number, found)
        if not isinstance(found, Hit):
            return found
        search = Search(examples, task.frame.labels, self._budget, task.options, rest)
        return RankedCandidates.of_single(search, found.extractor)

    def _accept(self, spec: RuleSpec, ranked: RankedCandidates, names: tuple[str, ...]) -> None:
        rule = Rule(ranked.extractor, spec.action, spec.label)
        self._learned.append(_RuleOutcome(rule, ranked, names))
        if not self._open_rule:
            declined = {a.asset for a in self._task.answers if a.rule == spec.number and a.select is None}
            self._open_rule = find_open_rule(spec.number, ranked, names, self._repairs.trust, declined)
        self._replays.advance(rule, last=spec.number == len(self._task.rules))

    def _finish(self) -> outcome.LearningOutcome:
        task, program = self._task, self._program()
        _verify(program, task.demos, task.templates)
        suggested, common = self._suggest_alternative(), self._common_fields()
        if self._open_rule:
            return outcome.Ambiguous(program=program, open_rule=self._open_rule, suggested=suggested, **common)
        unambiguous = bool(self._replays.others) and all(learned.candidates.unambiguous for learned in self._learned)
        return outcome.Found(program=program, unambiguous=unambiguous, suggested=suggested, **common)

    def _fail(self, spec: RuleSpec, miss: Miss, examples: Sequence[Example]) -> outcome.LearningOutcome:
        nearest, repairs = outcome.Nearest.of(spec.number, miss.nearest), self._repairs.repairs
        if repairs:
            return outcome.NeedsRepair(repairs=repairs, nearest=nearest, **self._common_fields())
        return outcome.NoProgram(
            why=miss.why,
            nearest=nearest,
            advice=give_advice(miss.nearest, examples, self._replays.assets_with_answers(spec.number)),
            suggested=self._suggest_orientation() if self._task.options.suggest_orientation else None,
            **self._common_fields(),
        )

    def _suggest_orientation(self) -> OrientationSuggestion | None:
        options = self._task.options
        plain = replace(options, max_size=min(options.max_size, PLAIN_SIZE))
        try:
            return suggest_orientation(replace(self._task, options=plain), self._budget)
        except (OutOfTime, MeshForgeError):
            return None

    def _suggest_alternative(self) -> OrientationSuggestion | None:
        """An orientation in which rules that were learned are more believable, and select something else somewhere."""
        task, options = self._task, self._task.options
        is_plain = options.suggest_orientation and options.strategy != "paper" and "G" in options.layers
        if not is_plain or task.frame.orient:
            return None
        try:
            extractors = [learned.rule.extractor for learned in self._learned]
            orient = find_more_believable(task, self._budget, extractors)
            return self._compare(orient) if orient else None
        except (OutOfTime, MeshForgeError):
            return None

    def _compare(self, orient: Orient) -> OrientationSuggestion | None:
        """What becomes of the rules in another frame; None where that makes no difference, or some are not found."""
        options = replace(self._task.options, suggest_orientation=False, repair=False)
        frame = replace(self._task.frame, orient=orient)
        other = LearningRun(replace(self._task, frame=frame, options=options), self._budget)
        if not isinstance(other.run(), outcome.Found | outcome.Ambiguous):
            return None
        differs = set[str]()
        for ours, theirs in zip(self._learned, other._learned, strict=True):
            now, then = ours.select(), theirs.select()
            differs.update(name for name in now if now[name] != then.get(name))
        sizes, before = (tuple(one.size for one in learned) for learned in (other._learned, self._learned))
        if not differs and sum(before) - sum(sizes) < MIN_SAVING:
            return None
        why = explain_orientation(orient, sizes, before, len(differs))
        return OrientationSuggestion(orient, sizes, why, before, tuple(sorted(differs)))

    def _program(self) -> Program:
        return replace(self._task.frame, rules=tuple(learned.rule for learned in self._learned))

    def _record_effort(self, spec: RuleSpec, tried: SearchEffort) -> None:
        self._tried = [*self._tried[: spec.number - 1], tried]

    def _common_fields(self) -> _OutcomeFields:
        return {
            "rules": tuple(learned.rule for learned in self._learned),
            "candidates": tuple(
                candidate
                for number, learned in enumerate(self._learned, 1)
                for candidate in learned.list_candidates(number)
            ),
            "tried": tuple(self._tried),
            "seconds": {"search": self._searching, "replay": self._budget.elapsed - self._searching},
            "stale": self._replays.stale,
        }


def _verify(program: Program, demos: Sequence[Demonstration], templates: Mapping[str, Template]) -> None:
    """Raise AssertionError, an error of ours, where the program selects something else than was shown.

    Raises ProgramError where it cannot run: it asks for labels, and a demonstrated mesh has none.
    """
    made_of = tuple(templates[name].digest for name in program.templates if name in templates)
    for name, demo in name_demonstrations(demos):
        key = ("verified", str(program), made_of, demo.steps)
        memoize(demo.mesh, key, bool, partial(_check_demonstration, program, demo, templates, name))


def _check_demonstration(program: Program, demo: Demonstration, templates: Mapping[str, Template], name: str) -> bool:
    try:
        trace = program.run(demo.mesh, templates, memo=memoize).trace
    except MeshForgeError as error:
        raise error.at(name) from None
    for done in trace:
        step = demo.step(done.rule)
        if step and step.select != frozenset(done.selected):
            raise AssertionError(
                f"the learned rule {done.rule} selects {sorted(done.selected)} on {name}, "
                f"not {sorted(step.select or ())} as was shown"
            )
    return True
