"""What was changed since the first edition of the benchmark, why, and what each change did to the figures."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

from benchmark.report import Cell, Result, Table, format_cell
from benchmark.study import FLAT, TRUE
from benchmark.study.condition import KIND, PROPAGATED, SYSTEMATIC, TELLING

_ABSENT = "not run"
_KIND_TELLING = TELLING.vary_to_kind_person()


@dataclass(frozen=True, slots=True)
class _Book:
    """All results, to look figures up in."""

    results: Mapping[str, Result]

    def find_cell(self, part: str, table: str, row: str, column: str) -> str:
        """A cell of a table whose title begins so; of columns of one name the first."""
        found = self.results.get(part)
        for one in found.tables if found else ():
            if one.title.startswith(table):
                for line in one.rows:
                    if line[0] == row:
                        return format_cell(line[one.columns.index(column)])
        return _ABSENT

    def find_goal(self, part: str, what: str) -> str:
        """What was measured for a goal that begins so."""
        found = self.results.get(part)
        return next(
            (format_cell(g.measured) for g in (found.goals if found else ()) if g.what.startswith(what)), _ABSENT
        )

    def find_learning(self, condition: str, column: str = "SSR") -> str:
        return self.find_cell("effectiveness", "What is learned", condition, column)

    def find_edit(self, condition: str, column: str = "FPR") -> str:
        return self.find_cell("effectiveness", "What becomes", condition, column)

    def find_cost(self, condition: str, column: str = "seconds in all") -> str:
        return self.find_cell("effectiveness", "What a person does", condition, column)


@dataclass(frozen=True, slots=True)
class _Change:
    """what: was changed, and why; figure: what is compared; before: in the first edition; now: looked up."""

    what: str
    figure: str
    before: str
    now: Callable[[_Book], str]


def _count_deletions(book: _Book) -> str:
    """Of how many meshes `All => Delete` passes, all tasks."""
    found = book.results.get("mutation")
    rows = [row for row in found.details if str(row["mutant"]).startswith("All => Delete")] if found else []
    passed, tried = sum(len(row["pass"]) for row in rows), sum(row["differs"] for row in rows)
    return f"{passed} of {tried} meshes, all tasks" if rows else _ABSENT


_CHANGES = (
    _Change(
        "Criteria ask what became of every true part (kept, gone, made of new hulls), and mutants of the reference "
        "test them: many passed where nothing asked that the rest be still there",
        "mutants that pass on more than a tenth of the meshes",
        "27 of 97 passed on half of them",
        lambda book: book.find_goal("mutation", "mutants that pass"),
    ),
    _Change("the same", "`All => Delete` passes", "75 of 75 meshes of kettle-medium", _count_deletions),
    _Change(
        "the same",
        "unedited assets that fail, least of all tasks, %",
        "64",
        lambda book: book.find_goal("ceiling", "unedited assets"),
    ),
    _Change(
        "the same",
        "FPR, noisy labels, telling confidence, the first edition's person",
        "0.54 ± 0.23",
        lambda book: book.find_edit(_KIND_TELLING.name),
    ),
    _Change(
        "Assets whose decompositions were the same at two settings are drawn anew",
        "different meshes",
        "548 of 600",
        lambda book: book.find_cell("ceiling", "Different meshes", "separate", "different"),
    ),
    _Change(
        "Two sets decomposed by one call for the whole asset: users meet hulls that span parts, the benchmark had none",
        "hulls that span parts, %",
        "0.5",
        lambda book: (
            f"union {book.find_goal('ceiling', 'union: hulls')}, welded {book.find_goal('ceiling', 'welded: hulls')}"
        ),
    ),
    _Change(
        "the same",
        "FPR of the reference, true labels",
        "0.98",
        lambda book: ", ".join(
            f"{sort} {book.find_edit(f'true labels, {sort}', 'of the reference, true labels')}"
            for sort in ("union", "welded")
        ),
    ),
    _Change(
        "Families of 25 different assets at one decomposition: in families of 75 three decompositions of an asset "
        "stood for each other",
        "SSR, true labels, the first edition's person",
        "24/24",
        lambda book: book.find_learning(KIND.name),
    ),
    _Change(
        "The person helps in no way: any first mesh, a random dozen, the whole edit again, nothing excused",
        "SSR, true labels",
        "24/24",
        lambda book: book.find_learning(TRUE.name),
    ),
    _Change(
        "the same",
        "demonstrations plus answers, true labels",
        "2.1 ± 1.0",
        lambda book: book.find_learning(TRUE.name, "k"),
    ),
    _Change(
        "the same",
        "SSR, noisy labels, telling confidence",
        "17/24",
        lambda book: (
            f"{book.find_learning(TELLING.name)} (the first edition's person: {book.find_learning(_KIND_TELLING.name)})"
        ),
    ),
    _Change(
        "Noisy labels whose confidence does not tell which are wrong; and systematic errors",
        "SSR, noisy labels",
        "17/24",
        lambda book: f"flat {book.find_learning(FLAT.name)}, systematic {book.find_learning(SYSTEMATIC.name)}",
    ),
    _Change(
        "The reference under the same labels stands beside each row",
        "FPR, noisy labels",
        "0.54 ± 0.23, alone",
        lambda book: (
            f"flat {book.find_edit(FLAT.name)}; the reference "
            f"{book.find_edit(FLAT.name, 'of the reference, same labels')}, with true labels "
            f"{book.find_edit(FLAT.name, 'of the reference, true labels')}"
        ),
    ),
    _Change(
        "Labels are propagated between different assets only, also from none at the start",
        "FPR, propagated from 3",
        "0.80 ± 0.19",
        lambda book: f"{book.find_edit(PROPAGATED[3].name)}; from none {book.find_edit(PROPAGATED[0].name)}",
    ),
    _Change(
        "All that a person does is counted, looks and approvals one by one, at prices fixed beforehand",
        "person, modelled, s a task, true labels",
        "57",
        lambda book: book.find_cost(TRUE.name),
    ),
    _Change(
        "Settled results are counted over all conditions",
        "settled, yet wrong",
        "0, of true labels alone (11 of 240 under propagated ones)",
        lambda book: book.find_goal("effectiveness", "settled and accepted, yet wrong"),
    ),
    _Change(
        "Speed by size of the extractor, medians and geometric means: sums rested on one time-out",
        "the paper's time as a ratio to ours, from 5 nodes on, median",
        "887, 96 and 74 times, of sums",
        lambda book: (
            f"at least {book.find_goal('contest', 'times as fast from')}; "
            f"{book.find_goal('contest', 'the same, at the size')} at the size where it is least"
        ),
    ),
    _Change(
        "Families of real assets, frozen before the tool saw them",
        "SSR, true labels, all families and decompositions",
        "no real asset",
        lambda book: book.find_goal("real", "tasks synthesized, true labels"),
    ),
)
_REMOVED = (
    "Goals that could not fail are gone: the functional pass rate under true labels (equal to the reference's by "
    'construction), the 95th percentile of wrong labels (clamped by the labeller), "at least 0.1 points" lost without '
    "a layer (now 5), and all ratios of sums over time-outs."
)


def tell_changes(results: Mapping[str, Result]) -> tuple[Table, str]:
    """The table of changes with the figures before and after, and which goals were taken away."""
    return Table(
        "", ("what was changed, and why", "figure", "first edition", "now"), tuple(_rows(_Book(results)))
    ), _REMOVED


def _rows(book: _Book) -> Iterator[tuple[Cell, ...]]:
    for one in _CHANGES:
        yield one.what, one.figure, one.before, one.now(book)
