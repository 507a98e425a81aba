"""What a part of the benchmark finds: tables, figures to reach, notes; and how these are written down."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from typing import Any

Tell = Callable[[str], None]
"""Called with a line about how far the work is."""
Cell = str | int | float


@dataclass(frozen=True, slots=True)
class Table:
    """Rows of cells under columns; floats are shown with three digits."""

    title: str
    columns: tuple[str, ...]
    rows: tuple[tuple[Cell, ...], ...]


@dataclass(frozen=True, slots=True)
class Goal:
    """A figure to reach: at least or at most `wanted`."""

    what: str
    sense: str
    wanted: float
    measured: float

    @property
    def reached(self) -> bool:
        return self.measured >= self.wanted if self.sense == "at least" else self.measured <= self.wanted


@dataclass(frozen=True, slots=True)
class Result:
    """All that one part has found; details: figures for the JSON only; lead: what a reader must know first."""

    part: str
    title: str
    tables: tuple[Table, ...]
    goals: tuple[Goal, ...] = ()
    notes: tuple[str, ...] = ()
    details: tuple[dict[str, Any], ...] = ()
    lead: str = ""

    def to_json(self) -> dict[str, Any]:
        goals = [{**asdict(goal), "reached": goal.reached} for goal in self.goals]
        return {**asdict(self), "goals": goals}

    @staticmethod
    def of_json(data: Mapping[str, Any]) -> Result:
        tables = [Table(t["title"], tuple(t["columns"]), tuple(map(tuple, t["rows"]))) for t in data["tables"]]
        goals = [Goal(g["what"], g["sense"], g["wanted"], g["measured"]) for g in data["goals"]]
        details = tuple(data["details"])
        notes, lead = tuple(data["notes"]), data.get("lead", "")
        return Result(data["part"], data["title"], tuple(tables), tuple(goals), notes, details, lead)


_LINES = {"tables": 3}
"""How many levels below a key of a result have lines of their own; else one."""


def write_lines(data: Mapping[str, Any]) -> str:
    """The JSON of a result, with a line for each goal, note, detail and row of a table: diffs are readable."""
    return _expand(data, 1, _LINES) + "\n"


def _expand(value: Any, levels: int, deeper: Mapping[str, int] | None = None) -> str:
    """JSON whose outer levels have a line for each entry; deeper: how many levels there are below some keys."""
    if not (levels and value and isinstance(value, Mapping | list | tuple)):
        return json.dumps(value, ensure_ascii=False, separators=(",", ":"))
    if not isinstance(value, Mapping):
        return "[\n" + ",\n".join(_expand(entry, levels - 1) for entry in value) + "\n]"
    below = {key: levels - 1 if deeper is None else deeper.get(key, 1) for key in value}
    lines = (f"{json.dumps(key)}: {_expand(entry, below[key])}" for key, entry in value.items())
    return "{\n" + ",\n".join(lines) + "\n}"


def format_cell(cell: Cell) -> str:
    """A cell as text."""
    return (
        f"{cell:.3g}"
        if isinstance(cell, float) and abs(cell) < 1000
        else f"{cell:,.0f}"
        if isinstance(cell, float)
        else str(cell)
    )


def as_text(result: Result) -> str:
    """A result in Markdown."""
    parts = [f"## {result.title}\n", *([f"{result.lead}\n"] if result.lead else [])]
    if result.goals:
        rows = tuple(
            (g.what, f"{g.sense} {format_cell(g.wanted)}", format_cell(g.measured), _verdict(g)) for g in result.goals
        )
        parts.append(format_table(Table("To reach", ("figure", "to reach", "measured", ""), rows)))
    parts += [format_table(table) for table in result.tables]
    if result.notes:
        parts.append("".join(f"- {note}\n" for note in result.notes))
    return "\n".join(parts)


def _verdict(goal: Goal) -> str:
    return "reached" if goal.reached else "**not reached**"


def format_table(table: Table) -> str:
    """A table in Markdown, under its title where it has one; *none* in place of no rows."""
    lines = [table.columns, *(tuple(format_cell(cell).replace("|", "/") for cell in row) for row in table.rows)]
    widths = [max(len(line[k]) for line in lines) for k in range(len(table.columns))]
    text = ["| " + " | ".join(c.ljust(w) for c, w in zip(line, widths, strict=True)) + " |" for line in lines]
    rule = "|" + "|".join("-" * (w + 2) for w in widths) + "|"
    body = [text[0], rule, *text[1:]] if table.rows else ["*none*"]
    return "\n".join([*([f"**{table.title}**\n"] if table.title else []), *body]) + "\n"
