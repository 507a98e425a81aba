"""Programs, extractors and the language for the page: in words, checked as one types, and what they select on an
asset."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import fields
from typing import Any, Literal

from meshforge.common import MeshForgeError, ProgramError
from meshforge.language import (
    ACTIONS,
    DIRECTIONS,
    EXTREMITY,
    OPERATORS,
    Action,
    All,
    Argument,
    Attach,
    Diff,
    Each,
    Extractor,
    FactorArgument,
    FileArgument,
    FlagArgument,
    Geo,
    Intersect,
    Is,
    Orient,
    PrimitiveOrFileArgument,
    Program,
    Rule,
    Union,
    WordArgument,
    check_declared,
    explain,
    labels_of,
    parse_extractor,
    select_mask,
    show,
    show_label,
)
from meshforge.project import Project
from meshforge.store import action_text
from meshforge.studio.edits.base import program_version
from meshforge.studio.queries.replay import replay_steps
from meshforge.studio.wire.program import (
    ActionForm,
    Guess,
    Guesses,
    LanguageView,
    Mark,
    Operator,
    ProgramCheck,
    ProgramView,
    RuleView,
    Selected,
)
from meshforge.studio.wire.program import Argument as Field
from meshforge.studio.wire.requests import SelectRequest
from meshforge.symbolic import SymbolicMesh, bits_of
from meshforge.synthesis import Demonstration, Replay, advance, begin_replay

_POSITION = re.compile(r".*:(\d+):(\d+)")

ArgumentKind = Literal["words", "flag", "file", "shape", "factor"]

_KINDS: Mapping[type[Argument], tuple[ArgumentKind, Any]] = {
    WordArgument: ("words", None),
    FlagArgument: ("flag", False),
    FileArgument: ("file", "part.obj"),
    PrimitiveOrFileArgument: ("shape", "box"),
    FactorArgument: ("factor", 1.0),
}
"""What the page calls each kind of argument, and a value of it; of words, the first is one."""

_SYNTAX = {kind.__name__: kind for kind in (All, Is, Attach, Geo, Union, Intersect, Diff)}


def read_program_view(project: Project) -> ProgramView:
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


def check_text(text: str) -> ProgramCheck:
    """Whether a text is a program, and what it says."""
    try:
        program = Program.parse(text)
    except MeshForgeError as error:
        return ProgramCheck(mark=mark_error(error))
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


def mark_error(error: MeshForgeError, line: int = 0, column: int = 0) -> Mark:
    """The place of an error of parsing, the very beginning where it names none.

    line, column: how far from the beginning of the page's text, lines and columns, the text begins that was parsed;
    the columns count on its first line.
    """
    found = _POSITION.fullmatch(error.where or "")
    row, place = (int(found[1]), int(found[2])) if found else (1, 1)
    problem = error.problem.split("\n")[0]
    said = f"{problem}. {error.remedy}" if error.remedy else problem
    return Mark(line=row + line, column=place + (column if row == 1 else 0), message=said)


def build_language_view() -> LanguageView:
    """Actions, operators and directions; `Each` is no form of its own."""
    forms = tuple(_action_form(name, kind) for name, kind in ACTIONS.items() if kind is not Each)
    return LanguageView(actions=forms, operators=tuple(map(_operator_view, OPERATORS)), directions=DIRECTIONS)


def _action_form(name: str, kind: type[Action]) -> ActionForm:
    given = kind.arguments()
    required = list(given)[: kind.min_arguments()]
    example = kind(*(_example_value(given[one]) for one in required))
    return ActionForm(
        name=name,
        summary=kind.summary(),
        usage=kind.usage(),
        makes=example.makes_hulls,
        arguments=tuple(_argument_field(one, argument, one in required) for one, argument in given.items()),
    )


def _argument_field(name: str, argument: Argument, required: bool) -> Field:
    kind, _ = _KINDS[type(argument)]
    return Field(name=name, kind=kind, wants=argument.wants, choices=argument.choices, required=required)


def _example_value(argument: Argument) -> Any:
    return argument.choices[0] if isinstance(argument, WordArgument) else _KINDS[type(argument)][1]


def _operator_view(name: str) -> Operator:
    kind = _SYNTAX[name]
    operands = ", ".join(field.name for field in fields(kind))
    summary = (kind.__doc__ or "").strip().splitlines()[0]
    return Operator(name=name, usage=f"{name}({operands})" if operands else name, summary=summary)


def select_hulls(
    project: Project, asset: str, mesh: SymbolicMesh, request: SelectRequest, program: Program | None = None
) -> Selected:
    """What an extractor selects on an asset after some of its steps, or what is wrong with its text.

    mesh: the asset as it comes; program: whose rule is meant, where one is asked for. Raises MeshForgeError where the
    asset cannot be turned, or a rule before fails.
    """
    text = request.extractor
    try:
        extractor = parse_extractor(text)
    except ProgramError as error:
        return Selected(mark=mark_error(error, *_indent_of(text)))
    now = _mesh_at(project, asset, mesh, request, program)
    unknown = _mark_unknown_label(
        extractor, text, [*project.vocabulary, *(hull.label for hull in now.hulls if hull.label)]
    )
    if unknown:
        return Selected(mark=unknown)
    mask = select_mask(extractor, now, project.settings.thresholds.extremity or EXTREMITY)
    names = tuple(now.hulls[k].name for k in sorted(bits_of(mask)))
    return Selected(select=names, sentence=explain(extractor))


def _mesh_at(
    project: Project, asset: str, mesh: SymbolicMesh, request: SelectRequest, program: Program | None
) -> SymbolicMesh:
    if request.rule is None:
        return replay_steps(project, asset, mesh, request.steps).mesh
    return project.mesh_before_rule(asset, request.rule, program or Program(orient=project.orientation), {asset: mesh})


def _indent_of(text: str) -> tuple[int, int]:
    """Lines and columns before the first character that is no space: the parser sees the text without them."""
    return _end_of(text[: len(text) - len(text.lstrip())])


def _end_of(text: str) -> tuple[int, int]:
    """Lines and columns from the beginning of a text to its end."""
    return text.count("\n"), len(text) - (text.rfind("\n") + 1)


def _mark_unknown_label(extractor: Extractor, text: str, known: Iterable[str]) -> Mark | None:
    """The place of a label that neither the vocabulary nor any hull has; None where all are known, or none is."""
    known = tuple(dict.fromkeys(known))
    for label in labels_of(extractor) if known else ():
        try:
            check_declared(label, known)
        except ProgramError as error:
            found = re.search(rf"(?<!\w){re.escape(show_label(label))}(?!\w)", text)
            lines, columns = _end_of(text[: found.start() if found else 0])
            return mark_error(error, lines, columns)
    return None


def guess_selections(project: Project, asset: str, mesh: SymbolicMesh, program: Program) -> Guesses:
    """A guess for each rule of a program; mesh: the asset as it comes.

    Rules that were shown, or left out, on the asset do before the next ones what was shown. Raises ProgramError where
    the asset cannot be turned.
    """
    demo = Demonstration(mesh, project.steps(asset), asset)
    replay = begin_replay(asset, demo, program.orient, program.contact)
    found = []
    for number, rule in enumerate(program.rules, 1):
        mask = select_mask(rule.extractor, replay.mesh, program.extremity or EXTREMITY)
        names = tuple(replay.mesh.hulls[k].name for k in sorted(bits_of(mask)))
        replay, problem = _apply_rule(project, replay, number, rule, program)
        found.append(
            Guess(
                rule=number,
                action=action_text(rule.action, rule.label),
                select=names,
                sentence=explain(rule),
                error=problem,
            )
        )
    return Guesses(asset=asset, guesses=tuple(found))


def _apply_rule(
    project: Project, replay: Replay, number: int, rule: Rule, program: Program
) -> tuple[Replay, str | None]:
    """The replay after a rule; as it was, and why, where the rule cannot be done."""
    try:
        templates = project.templates(rule.action.templates)
        return advance(replay, number, rule, templates, program.extremity), None
    except MeshForgeError as error:
        return replay, error.message
