"""Goals for the page: their forms, the text that a form comes to, those of the project in words, and extractors for
hulls that a person selects."""

import re
from collections.abc import Collection
from dataclasses import fields, replace
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


def list_goal_forms() -> tuple[forms.Operator, ...]:
    """Return a form for each goal, those of plug-ins among them."""
    return tuple(
        forms.Operator(
            name=kind.word(), summary=kind.summary(), usage=kind.usage(), base=False, arguments=_list_arguments(kind)
        )
        for kind in GOALS.loadable().values()
    )


def _list_arguments(kind: type[Goal]) -> tuple[forms.Argument, ...]:
    options, texts = kind.options(), {one.name: one.metadata for one in fields(cast(Any, kind))}
    values = {name: _value_of(argument) for name, argument in kind.arguments().items()}
    defaults = {name: "" if one is None else values[name].show(one) for name, one in options.items()}
    return tuple(
        forms.Argument(
            name=name,
            kind="words" if value.choices else "extractor" if isinstance(value, ExtractorArgument) else "text",
            title=texts[name].get("title", name.capitalize()),
            wants=value.wants,
            choices=tuple(word for word in value.choices if word != defaults.get(name)),
            words=texts[name].get("words", {}),
            omitted=texts[name].get("omitted", defaults.get(name, "")),
            required=name not in options,
        )
        for name, value in values.items()
    )


def _value_of(argument: ArgumentType) -> ArgumentType:
    return argument.value if isinstance(argument, OptionArgument) else argument


def check_goal(project: Project, call: wire.GoalCall) -> wire.GoalView:
    """Return what a form comes to, and whether that is a goal; with a proposal for its name."""
    kind = GOALS.get(call.name)
    rows = [(one, call.arguments.get(name, "").strip()) for name, one in (kind.arguments() if kind else {}).items()]
    words = [f"{one.choices[0]} = {text}" if isinstance(one, OptionArgument) else text for one, text in rows if text]
    return _view_goal("", f"{call.name}({', '.join(words)})" if words else call.name, project.words)


def list_goal_views(project: Project) -> tuple[wire.GoalView, ...]:
    """Return the goals of a project; one that does not parse with the reason."""
    return tuple(_view_goal(name, text, project.words) for name, text in project.settings.goals.items())


def _view_goal(name: str, text: str, words: tuple[str, ...]) -> wire.GoalView:
    try:
        goal = parse_goal(text, name or "goal", words)
    except MeshForgeError as error:
        return wire.GoalView(name=name, text=text, error="\n".join(filter(None, [error.problem, error.remedy])))
    first = next((one for one in goal.values().values() if isinstance(one, Extractor)), None)
    sentence, labels = goal.summary(), labels_of(first)[:1] if first else ()
    if first:  # what it selects stands in its summary
        sentence = re.sub("a selection", lambda _: explain(first), sentence, count=1, flags=re.IGNORECASE)
    arguments = {one: _value_of(goal.arguments()[one]).show(value) for one, value in goal.values().items()}
    return wire.GoalView(
        name=name or re.sub(r"\W+", "_", "_".join([goal.word(), *labels])),
        text=str(goal),
        sentence=sentence[:1].upper() + sentence[1:],
        call=wire.GoalCall(name=goal.word(), arguments=arguments),
    )


def suggest_extractors(
    project: Project, asset: str, mesh: SymbolicMesh, select: Collection[str], program: Program | None
) -> tuple[wire.ExtractorSuggestion, ...]:
    """Return extractors that select some hulls of an asset, the smallest first: those that select just these, their
    labels, and what rules of a program select. Raises DemonstrationError for hulls that there are not."""
    limits, frame = project.settings.thresholds, project.orientation
    demo = Demonstration(mesh, (Step(1, frozenset(select), Delete()),), asset)
    options = replace(_SEARCH, contact=limits.contact, extremity=limits.extremity)
    found = synthesize([demo], orient=frame, vocabulary=project.words, options=options)
    given = {hull.label for hull in mesh.hulls if hull.name in select}
    labels = [Is(word) for word in project.words if word in given]
    rules = [rule.extractor for rule in program.rules] if program else []
    exact = [one.extractor for one in found.candidates[:2]]
    start = begin_replay(asset, demo, frame, limits.contact).mesh
    wanted, rows = mask_of(start.index[name] for name in select), dict[str, wire.ExtractorSuggestion]()
    for one in sorted([*labels, *rules, *exact], key=size_of):
        mask = select_mask(one, start, limits.extremity or EXTREMITY)
        if mask & wanted == wanted:
            places = tuple(sorted(bits_of(mask)))
            rows[str(one)] = wire.ExtractorSuggestion(text=str(one), sentence=explain(one), places=places)
    return tuple(rows.values())[:_MOST_CANDIDATES]
