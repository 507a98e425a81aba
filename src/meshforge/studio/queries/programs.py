"""Programs, extractors and the language in words for the page, checked as they are typed, and what they select; and the
steps of an asset, replayed."""

import re
from collections.abc import Iterable

from meshforge import language
from meshforge.common import MeshForgeError, ProgramError
from meshforge.project import Project
from meshforge.studio.actions import list_action_forms, list_operator_views, view_action
from meshforge.studio.edits.base import program_version
from meshforge.studio.queries.goals import list_goal_forms
from meshforge.studio.wire import program as wire
from meshforge.studio.wire.requests import SelectRequest
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Demonstration, Step, begin_replay, memoize, strip_each

_POSITION = re.compile(r".*:(\d+):(\d+)")


def read_program_view(project: Project) -> wire.ProgramView:
    """Return the accepted program as its file has it, an empty view where there is none."""
    version = program_version(project)
    if not version:
        return wire.ProgramView()
    path, state = project.layout.program, project.program_state()
    text = path.read_text(encoding="utf-8", errors="replace")
    try:
        program = language.Program.read(path)
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
    """Return whether a text is a program, and what it says."""
    try:
        program = language.Program.parse(text)
    except MeshForgeError as error:
        return wire.ProgramCheck(mark=mark_error(error))
    return wire.ProgramCheck(rules=rule_views(program), orient_sentence=orient_sentence(program.orient))


def rule_views(program: language.Program) -> tuple[wire.RuleView, ...]:
    """Return the rules of a program in words."""
    return tuple(
        wire.RuleView(rule=k, text=language.show(rule), sentence=language.explain(rule))
        for k, rule in enumerate(program.rules, 1)
    )


def orient_sentence(orient: language.Orient | None) -> str:
    """Return an orientation in words, empty for none."""
    return language.explain(orient) if orient else ""


def mark_error(error: MeshForgeError, line: int = 0, column: int = 0) -> wire.Mark:
    """Return the place of an error of parsing, the very beginning where it names none.

    line, column: how many lines and columns into the page's text the parsed text begins; columns matter on its first
    line only.
    """
    found = _POSITION.fullmatch(error.where or "")
    row, place = (int(found[1]), int(found[2])) if found else (1, 1)
    problem = error.problem.split("\n")[0]
    message = f"{problem}. {error.remedy}" if error.remedy else problem
    return wire.Mark(line=row + line, column=place + (column if row == 1 else 0), message=message)


def build_language_view() -> wire.LanguageView:
    """Return actions, operators and directions; `Each` is no form of its own."""
    return wire.LanguageView(
        actions=list_action_forms(),
        operators=list_operator_views(),
        directions=language.DIRECTIONS,
        goals=list_goal_forms(),
    )


def select_hulls(
    project: Project, asset: str, mesh: SymbolicMesh, request: SelectRequest, program: language.Program | None = None
) -> wire.SelectionView:
    """Return what an extractor selects on an asset after some of its steps, or what is wrong with its text.

    mesh: the asset as it comes; program: the one that `request.rule` counts in. Raises MeshForgeError where the asset
    cannot be turned, or a rule before that one fails.
    """
    text = request.extractor
    try:
        extractor = language.parse_extractor(text)
    except ProgramError as error:  # its place counts from the first character that is no space
        return wire.SelectionView(mark=mark_error(error, *_end_of(text[: len(text) - len(text.lstrip())])))
    if request.rule is None:
        now = replay_steps(project, asset, mesh, request.steps).mesh
    else:
        plan = program or language.Program(orient=project.orientation)
        now = project.mesh_before_rule(asset, request.rule, plan, {asset: mesh})
    known = [*project.vocabulary, *(hull.label for hull in now.hulls if hull.label)]
    if unknown := _mark_unknown_label(extractor, text, known):
        return wire.SelectionView(mark=unknown)
    mask = language.select_mask(extractor, now, project.settings.thresholds.extremity or language.EXTREMITY)
    return wire.SelectionView(select=now.names_of(mask), sentence=language.explain(extractor))


def _end_of(text: str) -> tuple[int, int]:
    return text.count("\n"), len(text) - (text.rfind("\n") + 1)


def _mark_unknown_label(extractor: language.Extractor, text: str, known: Iterable[str]) -> wire.Mark | None:
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


def guess_selections(
    project: Project, asset: str, mesh: SymbolicMesh, program: language.Program
) -> tuple[wire.Guess, ...]:
    """Return a guess for each rule of a program; mesh: the asset as it comes.

    A rule that was demonstrated on the asset, or left out there, does that before the next one is guessed. Raises
    ProgramError where the asset cannot be turned.
    """
    replay = begin_replay(asset, Demonstration(mesh, project.steps(asset)), program.orient, program.contact)
    guesses = []
    for number, rule in enumerate(program.rules, 1):
        error: str | None = None
        mask = language.select_mask(rule.extractor, replay.mesh, program.extremity or language.EXTREMITY)
        names = replay.mesh.names_of(mask)
        try:
            templates = project.templates(rule.action.templates)
            replay = replay.advance(rule, templates, program.extremity)
        except MeshForgeError as problem:  # the next rules are guessed without this one
            error = problem.message
            replay = replay.skip(error)
        action = view_action(rule.action, rule.label)
        guesses.append(
            wire.Guess(rule=number, action=action, select=names, sentence=language.explain(rule), error=error)
        )
    return tuple(guesses)


def replay_steps(project: Project, asset: str, mesh: SymbolicMesh, steps: int | None = None) -> language.Replay:
    """Return an asset after its first steps, all by default; a step that fails is skipped, and its trace has the error.

    A step without a selection does what the rule of its number does in the present program, as in learning, or nothing
    without such a rule. Raises ProgramError where the orientation does not turn the asset.
    """
    contact = project.settings.thresholds.contact
    replay = language.Replay.begin(mesh, project.orientation, contact, name=asset, memo=memoize)
    try:
        program = project.program() or language.Program()
    except ProgramError:
        program = language.Program()
    for step in project.steps(asset)[:steps]:
        try:
            replay = _apply_step(project, replay, step, program)
        except MeshForgeError as error:
            replay = replay.skip(error.message)
    return replay


def _apply_step(project: Project, replay: language.Replay, step: Step, program: language.Program) -> language.Replay:
    action, label = step.action, step.label
    if step.select is not None:
        mask = replay.mask_of(step.select)
    else:
        rule = _rule_of(program, step)
        if rule is None:
            return replay.skip()
        mask, action, label = replay.select(rule, program.extremity), rule.action, rule.label
    return replay.apply(mask, action, label, project.templates(action.templates))


def _rule_of(program: language.Program, step: Step) -> language.Rule | None:
    rules = program.rules[step.rule - 1 : step.rule]
    return next((r for r in rules if (strip_each(r.action), r.label) == (strip_each(step.action), step.label)), None)
