"""How fast rules and whole programs are learned, against the paper's algorithms and cvc5 on the same problems."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from statistics import mean

from benchmark.learning.boxes import boxes_case
from benchmark.learning.cases import FAMILY, Case, case, cases
from benchmark.learning.contest import limit_of, run_contests
from benchmark.learning.ratios import Row
from benchmark.learning.search_programs import Times, programs_timed
from benchmark.learning.search_tables import contest_goals, contest_tables, describe_contest
from benchmark.learning.tables import PROGRAM, RULES, upright
from benchmark.report import Goal, Result, Table, Tell

_SEED, _DEMONSTRATED = 100, 2
_LARGE = (5, 7, 9)
"""Sizes of extractors on boxes at random, where nothing smaller fits by accident."""
_DRAWS = 4
"""Draws of boxes for each size."""


def measure(tell: Tell, quick: bool) -> Result:
    """Let all contestants take turns on every problem, then learn whole programs."""
    rows, details = list[Row](), []
    for _, row, told in run_contests(_problems(quick), quick):
        rows.append(row)
        details.append(told)
        tell(f"search: {len(rows)} problems, {row.group}")
    programs = programs_timed(tell, quick)
    tables = (*contest_tables(rows), _programs(programs))
    notes = tuple(_notes(rows, limit_of(quick)))
    return Result("search", "Searching", tables, tuple(_goals(rows, programs)), notes, tuple(details))


def _problems(quick: bool) -> Iterator[tuple[str, Case]]:
    families = cases([_SEED], _DEMONSTRATED, ("lamp",)) if quick else cases([_SEED], _DEMONSTRATED)
    for number, problem in enumerate(families):
        if not quick or number < 2:
            yield "families", problem
    tables = tuple(upright().values())
    for extractor in RULES[:1] if quick else RULES:
        if found := case("tables", extractor, PROGRAM.labels, tables, _DEMONSTRATED, _SEED):
            yield "bundled tables", found
    for nodes in _LARGE[:1] if quick else _LARGE:
        for seed in range(1 if quick else _DRAWS):
            yield "boxes at random", boxes_case(nodes, FAMILY, 3, seed=seed)


def _programs(rows: Sequence[Times]) -> Table:
    columns = (
        "program",
        "rules",
        "meshes",
        "hulls",
        "search and readings, ms",
        "with repair, contacts and all, ms",
        "replay, ms",
        "all of it again, ms",
    )
    return Table("Whole programs, demonstrated on two meshes", columns, tuple(row.cells() for row in rows))


def _goals(rows: Sequence[Row], programs: Sequence[Times]) -> Iterator[Goal]:
    yield from contest_goals(rows)
    yield Goal("search and readings of a program, mean, s", "at most", 0.05, mean(row.readings for row in programs))
    yield Goal("replay of a program over the batch, slowest, s", "at most", 1.0, max(row.replay for row in programs))


def _notes(rows: Sequence[Row], limit: float) -> Iterator[str]:
    yield (
        f"Problems: the hidden rules of four families of 30, demonstrated on two meshes; {len(RULES)} rules on the "
        f"bundled tables, likewise; and extractors of 5, 7 and 9 nodes on 30 meshes of 40 boxes at random, {_DRAWS} "
        "draws of each, demonstrated on three meshes. Meshes are given as the rule meets them, contacts known. Sizes "
        "are those of the smallest extractor that agrees with what was demonstrated, which is often smaller than the "
        "hidden one. More problems of 5, 7 and 9 nodes are on [the benchmark's page](../README.md)."
    )
    yield from describe_contest(limit)
    yield f"False alarms of label repair, all labels being right: {sum(row.alarms for row in rows)} of {len(rows)}."
