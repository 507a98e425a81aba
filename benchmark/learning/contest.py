"""The contestants on one rule: the default strategy, alone and with all it does besides, the paper's, and cvc5."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from functools import partial
from importlib.util import find_spec
from statistics import median
from typing import Any

from benchmark.clock import Run, in_turns
from benchmark.learning.cases import Case, learn, name_of
from benchmark.learning.ratios import Row
from benchmark.learning.sygus import cvc5_problem
from meshforge.label_model.odds import LabelBeliefs
from meshforge.language import Extractor, show, size_of
from meshforge.synthesis.candidates.rank import RankedCandidates, enumerate_consistent
from meshforge.synthesis.demonstration import LabelFix
from meshforge.synthesis.options import Options, TimeBudget
from meshforge.synthesis.paper.search import PaperSearch
from meshforge.synthesis.repair.explain import Explanation, FixSearch
from meshforge.synthesis.search.smallest import Hit

ALONE, READINGS, REPAIR = "MeshForge, search alone", "MeshForge, search and readings", "MeshForge, repair on"
PAPER, PAPER_REPAIR, CVC5 = "the paper's, repair off", "the paper's, repair on", "cvc5"
LIMIT, QUICK_LIMIT = 10.0, 2.0
"""Seconds for one rule; MeshForge is never stopped by it."""
_ROUNDS = 3
_SLOW = 0.3  # seconds of a turn that is not taken again
HAS_CVC5 = find_spec("cvc5") is not None


@dataclass(eq=False)
class Contest:
    """One rule for all contestants; answers: what each has found, nothing where its time was out."""

    case: Case
    limit: float = LIMIT
    answers: dict[str, Extractor | None] = field(default_factory=dict)
    alarms: int = 0

    def measure(self, group: str, rounds: int) -> Row:
        """The median of each contestant; who has not finished counts as having taken the limit at least."""
        works: dict[str, Callable[[], Extractor | None]] = {
            ALONE: self._alone,
            READINGS: lambda: _smallest(learn(self.case.search())),
            REPAIR: self._with_repair,
            PAPER: partial(self._paper, False),
            PAPER_REPAIR: partial(self._paper, True),
        }
        turns: dict[str, Run] = {name: self._record(name, work) for name, work in works.items()}
        if HAS_CVC5:
            turns[CVC5] = self._cvc5
        times = {name: median(seconds) for name, seconds in in_turns(turns, rounds, slow=_SLOW).items()}
        seconds = {name: t if self.answers[name] else max(t, self.limit) for name, t in times.items()}
        sizes = {name: size_of(found) if found else None for name, found in self.answers.items()}
        return Row(group, seconds, sizes, self.alarms)

    def to_json(self, row: Row) -> dict[str, Any]:
        found = {name: show(extractor) if extractor else None for name, extractor in self.answers.items()}
        of_case = {"problem": self.case.family, "hidden": show(self.case.hidden), "shown": len(self.case.shown)}
        return {"group": row.group, **of_case, "seconds": row.seconds, "found": found}

    def _record(self, name: str, work: Callable[[], Extractor | None]) -> Run:
        def run() -> None:
            self.answers[name] = work()

        return lambda: run

    def _alone(self) -> Extractor | None:
        """The smallest extractor, without a look at the meshes that are not demonstrated."""
        found = self.case.search(batch=False).run()
        return found.extractor if isinstance(found, Hit) else None

    def _with_repair(self) -> Extractor | None:
        """All that learning does for a rule: what label repair finds on right labels is a false alarm."""
        search = self.case.search()
        found = search.run()
        assert isinstance(found, Hit)
        self.alarms = bool(self._explain(found.extractor))
        return _smallest(RankedCandidates(search, enumerate_consistent(search, found.extractor, search.options.above)))

    def _explain(self, exact: Extractor) -> Explanation | None:
        case = self.case
        known, rest = ({name_of(k): case.meshes[k] for k in some} for some in (case.shown, case.rest()))
        labels = LabelBeliefs(known, rest, case.vocabulary)
        budget = TimeBudget(Options().budget)
        return FixSearch(case.examples(), case.vocabulary, labels, Options(), budget, exact, {}, ()).run()

    def _paper(self, repair: bool) -> Extractor | None:
        """With repair on it asks about every label it would correct, and the answer is no: all are right."""
        if repair and not self.answers[PAPER]:
            return None  # with repair it does all that it does without, and more: it would not finish either
        options = Options(strategy="paper", repair=repair)
        examples, vocabulary = self.case.examples(), self.case.vocabulary
        found = PaperSearch(examples, vocabulary, TimeBudget(self.limit), options, confirm=_no).run()
        return found.extractor if isinstance(found, Hit) else None

    def _cvc5(self) -> Callable[[], object]:
        solve = cvc5_problem(self.case.examples(), self.case.vocabulary, seconds=self.limit)
        return self._record(CVC5, solve)()


def run_contests(problems: Iterable[tuple[str, Case]], quick: bool) -> Iterator[tuple[Case, Row, dict[str, Any]]]:
    """Let all contestants take turns on every problem, given with its group; what they took, and what is kept of it."""
    for group, problem in problems:
        contest = Contest(problem, limit_of(quick))
        row = contest.measure(group, 1 if quick else _ROUNDS)
        yield problem, row, contest.to_json(row)


def limit_of(quick: bool) -> float:
    """Seconds for one rule."""
    return QUICK_LIMIT if quick else LIMIT


def _smallest(weighed: RankedCandidates) -> Extractor:
    return weighed.consistent.terms[0].extractor


def _no(_: LabelFix) -> bool:
    return False
