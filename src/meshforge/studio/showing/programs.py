"""Programs for the page: the accepted one, any text that may be one, rules in words."""

from __future__ import annotations

import re
from collections.abc import Mapping

from meshforge.errors import MeshForgeError, ProgramError
from meshforge.language import Orient, Program, explain, show
from meshforge.project import Project
from meshforge.studio.versions import program_version
from meshforge.studio.wire.lesson import Mark, ProgramCheck, ProgramView, RuleView

_PLACE = re.compile(r".*:(\d+):(\d+)")


def program_view(project: Project) -> ProgramView:
    """The accepted program as its file has it, an empty view where there is none."""
    version = program_version(project)
    if not version:
        return ProgramView()
    path, standing = project.layout.program, project.program_state()
    text = path.read_text(encoding="utf-8", errors="replace")
    try:
        program = Program.read(path)
    except ProgramError as error:
        return ProgramView(text=text, version=version, by_hand=True, error=error.message)
    return ProgramView(
        text=text,
        version=version,
        by_hand=standing.by_hand,
        outdated=standing.outdated,
        labels=program.labels,
        orient_sentence=orient_sentence(program.orient),
        rules=rule_views(program),
    )


def check(text: str) -> ProgramCheck:
    """Whether a text is a program, and what it says."""
    try:
        program = Program.parse(text)
    except MeshForgeError as error:
        return ProgramCheck(mark=mark(error))
    return ProgramCheck(rules=rule_views(program), orient_sentence=orient_sentence(program.orient))


def rule_views(program: Program, readings: Mapping[int, int] | None = None) -> tuple[RuleView, ...]:
    """The rules of a program in words; readings: how many extractors agree with what was shown, by rule."""
    readings = readings or {}
    return tuple(
        RuleView(rule=k, text=show(rule), sentence=explain(rule), readings=readings.get(k, 1))
        for k, rule in enumerate(program.rules, 1)
    )


def orient_sentence(orient: Orient | None) -> str:
    """An orientation in words, empty for none."""
    return explain(orient) if orient else ""


def mark(error: MeshForgeError, line: int = 0, column: int = 0) -> Mark:
    """The place of an error of parsing, the very beginning where it names none.

    line, column: how far from the beginning of the page's text, lines and columns, the text begins that was parsed;
    the columns count on its first line.
    """
    found = _PLACE.fullmatch(error.where or "")
    row, place = (int(found[1]), int(found[2])) if found else (1, 1)
    problem = error.problem.split("\n")[0]
    said = f"{problem}. {error.remedy}" if error.remedy else problem
    return Mark(line=row + line, column=place + (column if row == 1 else 0), message=said)
