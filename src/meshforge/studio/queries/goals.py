"""Goals for the page: their forms, the text that a form comes to, those of the project in words, and extractors for
hulls that a person selects."""

import re
from collections.abc import Collection, Iterator, Mapping
from dataclasses import fields
from typing import Any, cast

from meshforge.checks.goals.base import Goal
from meshforge.checks.goals.registry import GOALS, parse_goal
from meshforge.common import MeshForgeError
from meshforge.language import (
    EXTREMITY,
    ArgumentType,
    Delete,
    Extractor,
    ExtractorArgument,
    Is,
    OptionArgument,
    Program,
    explain,
    labels_of,
    select_mask,
    size_of,
)
from meshforge.project import Project
from meshforge.studio.wire import family as wire
from meshforge.studio.wire import program as forms
from meshforge.symbolic import SymbolicMesh, bits_of, mask_of
from meshforge.synthesis import Demonstration, Options, Step, begin_replay, synthesize

_MOST_CANDIDATES = 4
_SEARCH = Options(budget=2.0, repair=False, suggest_orientation=False)
"""How extractors are looked for while a person waits [s]."""


def list_goal_forms() -> tuple[forms.GoalForm, ...]:
    """Return a form for each goal, those of plug-ins among them."""
    return tuple(
        forms.GoalForm(
            name=kind.word(), summary=kind.summary(), usage=kind.usage(), arguments=tuple(_list_arguments(kind))
        )
        for kind in GOALS.loadable().values()
    )


def _list_arguments(kind: type[Goal]) -> Iterator[forms.Argument]:
    options, texts = kind.options(), {one.name: one.metadata for one in fields(cast(Any, kind))}
    for name, argument in kind.arguments().items():
        value = _value_of(argument)
        default = None if options.get(name) is None else value.show(options[name])
        yield forms.Argument(
            name=name,
            kind="words" if value.choices else "extractor" if isinstance(value, ExtractorArgument) else "text",
            title=texts[name].get("title", name.capitalize()),
            wants=value.wants,
            choices=tuple(word for word in value.choices if word != default),
            words=texts[name].get("words", {}),
            omitted=texts[name].get("omitted", default or ""),
            required=name not in options,
        )


def _value_of(argument: ArgumentType) -> ArgumentType:
    return argument.value if isinstance(argument, OptionArgument) else argument


def check_goal(project: Project, call: wire.GoalCall) -> wire.GoalCheck:
    """Return the goal that a form comes to, and whether it is one."""
    kind = GOALS.get(call.name)
    given = {name: call.arguments.get(name, "").strip() for name in (kind.arguments() if kind else ())}
    words = [
        f"{argument.choices[0]} = {given[name]}" if isinstance(argument, OptionArgument) else given[name]
        for name, argument in (kind.arguments() if kind else {}).items()
        if given[name]
    ]
    text = f"{call.name}({', '.join(words)})" if words else call.name
    try:
        goal = parse_goal(text, "goal", project.words)
    except MeshForgeError as error:
        return wire.GoalCheck(text=text, error="\n".join(filter(None, [error.problem, error.remedy])))
    labels = [label for one in _extractors_of(goal).values() for label in labels_of(one)]
    name = re.sub(r"\W+", "_", "_".join([goal.word(), *labels[:1]]))
    return wire.GoalCheck(text=str(goal), sentence=_explain(goal), name=name)


def list_goal_views(project: Project) -> tuple[wire.GoalView, ...]:
    """Return the goals of a project; one that does not parse with the reason."""
    return tuple(_view_goal(name, text, project.words) for name, text in project.settings.goals.items())


def _view_goal(name: str, text: str, words: tuple[str, ...]) -> wire.GoalView:
    try:
        goal = parse_goal(text, name, words)
    except MeshForgeError as error:
        return wire.GoalView(name=name, text=text, error=error.message)
    shown = {one: _value_of(goal.arguments()[one]).show(value) for one, value in goal.values().items()}
    call = wire.GoalCall(name=goal.word(), arguments=shown)
    return wire.GoalView(name=name, text=str(goal), sentence=_explain(goal), call=call)


def _extractors_of(goal: Goal) -> Mapping[str, Extractor]:
    return {name: value for name, value in goal.values().items() if isinstance(value, Extractor)}


def _explain(goal: Goal) -> str:
    """A goal as a sentence: its summary with what it selects in words."""
    sentence, first = type(goal).summary(), next(iter(_extractors_of(goal).values()), None)
    if first:
        sentence = re.sub("a selection", lambda _: explain(first), sentence, count=1, flags=re.IGNORECASE)
    return sentence[:1].upper() + sentence[1:]


def suggest_extractors(
    project: Project, asset: str, mesh: SymbolicMesh, select: Collection[str], program: Program | None
) -> tuple[wire.ExtractorSuggestion, ...]:
    """Return extractors that select some hulls of an asset, the smallest first: those that select just these, their
    labels, and what rules of a program select. Raises DemonstrationError for hulls that there are not."""
    limits, frame = project.settings.thresholds, project.orientation
    demo = Demonstration(mesh, (Step(1, frozenset(select), Delete()),), asset)
    found = synthesize([demo], orient=frame, vocabulary=project.words, options=_SEARCH)
    labels = {hull.label: Is(hull.label) for hull in mesh.hulls if hull.name in select and hull.label}
    rules = [rule.extractor for rule in program.rules] if program else []
    exact = [one.extractor for one in found.candidates[:2]]
    start = begin_replay(asset, demo, frame, limits.contact).mesh
    wanted, rows = mask_of(start.index[name] for name in select), dict[str, wire.ExtractorSuggestion]()
    for one in sorted([*labels.values(), *rules, *exact], key=size_of):
        mask = select_mask(one, start, limits.extremity or EXTREMITY)
        if mask & wanted == wanted:
            places = tuple(sorted(bits_of(mask)))
            rows[str(one)] = wire.ExtractorSuggestion(text=str(one), sentence=explain(one), places=places)
    return tuple(rows.values())[:_MOST_CANDIDATES]
