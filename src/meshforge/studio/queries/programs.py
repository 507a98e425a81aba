"""Programs, extractors and the language in words for the page, checked as they are typed, and what they select."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import fields
from typing import Any, Literal

from meshforge import language
from meshforge.batch import action_text
from meshforge.common import MeshForgeError, ProgramError
from meshforge.language import EXTREMITY, Extractor, Orient, Program, explain, parse_extractor, select_mask, show
from meshforge.project import Project
from meshforge.studio.edits.base import program_version
from meshforge.studio.queries.replay import replay_steps
from meshforge.studio.wire import program as wire
from meshforge.studio.wire.requests import SelectRequest
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Demonstration, begin_replay

_POSITION = re.compile(r".*:(\d+):(\d+)")

ArgumentKind = Literal["words", "flag", "file", "shape", "factor", "length", "option"]

_KINDS: Mapping[type[language.ArgumentType], tuple[ArgumentKind, Any]] = {
    language.WordArgument: ("words", None),
    language.FlagArgument: ("flag", False),
    language.FileArgument: ("file", "part.obj"),
    language.PrimitiveOrFileArgument: ("shape", "box"),
    language.FactorArgument: ("factor", 1.0),
    language.LengthArgument: ("length", 0.001),
    language.OptionArgument: ("option", None),
}
"""What the page calls each kind of argument, and a value of it; of words, the first is one."""


def read_program_view(project: Project) -> wire.ProgramView:
    """The accepted program as its file has it, an empty view where there is none."""
    version = program_version(project)
    if not version:
        return wire.ProgramView()
    path, state = project.layout.program, project.program_state()
    text = path.read_text(encoding="utf-8", errors="replace")
    try:
        program = Program.read(path)
    except ProgramError as error:
        return wire.ProgramView(text=text, version=version, by_hand=True, error=error.message)
    return wire.ProgramView(
        text=text,
        version=version,
        by_hand=state.by_hand,
        outdated=state.outdated,
        labels=program.labels,
        orient_sentence=orient_sentence(program.orient),
        rules=rule_views(program),
    )


def check_text(text: str) -> wire.ProgramCheck:
    """Whether a text is a program, and what it says."""
    try:
        program = Program.parse(text)
    except MeshForgeError as error:
        return wire.ProgramCheck(mark=mark_error(error))
    return wire.ProgramCheck(rules=rule_views(program), orient_sentence=orient_sentence(program.orient))


def rule_views(program: Program, readings: Mapping[int, int] | None = None) -> tuple[wire.RuleView, ...]:
    """The rules of a program in words; readings: how many extractors agree with what was demonstrated, by rule."""
    readings = readings or {}
    return tuple(
        wire.RuleView(rule=k, text=show(rule), sentence=explain(rule), readings=readings.get(k, 1))
        for k, rule in enumerate(program.rules, 1)
    )


def orient_sentence(orient: Orient | None) -> str:
    """An orientation in words, empty for none."""
    return explain(orient) if orient else ""


def mark_error(error: MeshForgeError, line: int = 0, column: int = 0) -> wire.Mark:
    """The place of an error of parsing, the very beginning where it names none.

    line, column: how many lines and columns into the page's text the parsed text begins; columns matter on its first
    line only.
    """
    found = _POSITION.fullmatch(error.where or "")
    row, place = (int(found[1]), int(found[2])) if found else (1, 1)
    problem = error.problem.split("\n")[0]
    message = f"{problem}. {error.remedy}" if error.remedy else problem
    return wire.Mark(line=row + line, column=place + (column if row == 1 else 0), message=message)


def build_language_view() -> wire.LanguageView:
    """Actions, operators and directions; `Each` is no form of its own."""
    forms = (_try_action_form(name, kind) for name, kind in language.ACTIONS.loadable().items())
    return wire.LanguageView(
        actions=tuple(form for form in forms if form),
        operators=tuple(map(_operator_view, language.OPERATORS)),
        directions=language.DIRECTIONS,
    )


def _try_action_form(name: str, kind: type[language.Action]) -> wire.ActionForm | None:
    """The form of an action; None for `Each`, and for one of a plug-in whose arguments the page has no fields for."""
    if kind is language.Each or (name not in language.ACTIONS.built_in and not _has_fields(kind)):
        return None
    try:
        return _action_form(name, kind)
    except MeshForgeError:  # a plug-in's, whose arguments do not go together so
        return None


def _has_fields(kind: type[language.Action]) -> bool:
    return all(type(argument) in _KINDS for argument in kind.arguments().values())


def _action_form(name: str, kind: type[language.Action]) -> wire.ActionForm:
    given = kind.arguments()
    required = list(given)[: kind.min_arguments()]
    example = language.make_operation(kind, {one: _example_value(given[one]) for one in required})
    return wire.ActionForm(
        name=name,
        summary=kind.summary(),
        usage=kind.usage(),
        makes=example.makes_hulls,
        arguments=tuple(_argument_field(one, argument, one in required) for one, argument in given.items()),
    )


def _argument_field(name: str, argument: language.ArgumentType, required: bool) -> wire.Argument:
    kind, _ = _KINDS[type(argument)]
    return wire.Argument(name=name, kind=kind, wants=argument.wants, choices=argument.choices, required=required)


def _example_value(argument: language.ArgumentType) -> Any:
    return argument.choices[0] if isinstance(argument, language.WordArgument) else _KINDS[type(argument)][1]


def _operator_view(name: str) -> wire.Operator:
    kind = getattr(language, name)
    operands = ", ".join(field.name for field in fields(kind))
    summary = (kind.__doc__ or "").strip().splitlines()[0]
    return wire.Operator(name=name, usage=f"{name}({operands})" if operands else name, summary=summary)


def select_hulls(
    project: Project, asset: str, mesh: SymbolicMesh, request: SelectRequest, program: Program | None = None
) -> wire.SelectionView:
    """What an extractor selects on an asset after some of its steps, or what is wrong with its text.

    mesh: the asset as it comes; program: the one that `request.rule` counts in. Raises MeshForgeError where the asset
    cannot be turned, or a rule before that one fails.
    """
    text = request.extractor
    try:
        extractor = parse_extractor(text)
    except ProgramError as error:  # its place counts from the first character that is no space
        return wire.SelectionView(mark=mark_error(error, *_end_of(text[: len(text) - len(text.lstrip())])))
    if request.rule is None:
        now = replay_steps(project, asset, mesh, request.steps).mesh
    else:
        plan = program or Program(orient=project.orientation)
        now = project.mesh_before_rule(asset, request.rule, plan, {asset: mesh})
    known = [*project.vocabulary, *(hull.label for hull in now.hulls if hull.label)]
    if unknown := _mark_unknown_label(extractor, text, known):
        return wire.SelectionView(mark=unknown)
    mask = select_mask(extractor, now, project.settings.thresholds.extremity or EXTREMITY)
    return wire.SelectionView(select=now.names_of(mask), sentence=explain(extractor))


def _end_of(text: str) -> tuple[int, int]:
    return text.count("\n"), len(text) - (text.rfind("\n") + 1)


def _mark_unknown_label(extractor: Extractor, text: str, known: Iterable[str]) -> wire.Mark | None:
    """The place of a label that neither the vocabulary nor any hull has; None where all are known, or none is."""
    known = tuple(dict.fromkeys(known))
    for label in language.labels_of(extractor) if known else ():
        try:
            language.check_declared(label, known)
        except ProgramError as error:
            found = re.search(rf"(?<!\w){re.escape(language.show_label(label))}(?!\w)", text)
            lines, columns = _end_of(text[: found.start() if found else 0])
            return mark_error(error, lines, columns)
    return None


def guess_selections(project: Project, asset: str, mesh: SymbolicMesh, program: Program) -> wire.Guesses:
    """A guess for each rule of a program; mesh: the asset as it comes.

    A rule that was demonstrated on the asset, or left out there, does that before the next one is guessed. Raises
    ProgramError where the asset cannot be turned.
    """
    replay = begin_replay(asset, Demonstration(mesh, project.steps(asset)), program.orient, program.contact)
    guesses = []
    for number, rule in enumerate(program.rules, 1):
        error: str | None = None
        mask = select_mask(rule.extractor, replay.mesh, program.extremity or EXTREMITY)
        names = replay.mesh.names_of(mask)
        try:
            templates = project.templates(rule.action.templates)
            replay = replay.advance(rule, templates, program.extremity)
        except MeshForgeError as problem:  # the next rules are guessed without this one
            error = problem.message
            replay = replay.skip(error)
        action = action_text(rule.action, rule.label)
        guesses.append(wire.Guess(rule=number, action=action, select=names, sentence=explain(rule), error=error))
    return wire.Guesses(asset=asset, guesses=tuple(guesses))
