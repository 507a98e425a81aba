"""Actions between the language and the page: their forms, how they are shown, and what the page sends of them; and the
operators of extractors."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields
from itertools import combinations, product
from typing import Any, assert_never, cast

from meshforge import language
from meshforge.batch import action_text
from meshforge.common import MeshForgeError, ProjectError
from meshforge.language import Action, ArgumentType
from meshforge.store import parse_action_text
from meshforge.studio.wire import program as wire

_KINDS: Mapping[type[ArgumentType], tuple[wire.ArgumentKind, wire.Value]] = {
    language.WordArgument: ("words", ""),
    language.DirectionArgument: ("words", ""),
    language.FlagArgument: ("flag", True),
    language.FileArgument: ("file", "part.obj"),
    language.PrimitiveOrFileArgument: ("shape", "box"),
    language.FactorArgument: ("factor", 0.9),
    language.LengthArgument: ("length", 0.002),
    language.OptionArgument: ("option", 0.002),
    language.TextArgument: ("text", ""),
    language.ShareArgument: ("share", 0.5),
    language.LabelArgument: ("label", ""),
    language.BaseArgument: ("base", ""),
}
"""What the page calls each kind of argument, and a value of it; of words, the first is one."""

Choice = tuple[wire.Value | None, wire.Value]
"""A value of an argument, after what the page calls it: itself, or None for any that is none of the choices."""


def list_action_forms() -> tuple[wire.ActionForm, ...]:
    """Return a form for each action, those of plug-ins among them; `Each` is a switch of all."""
    forms = (_try_form(kind) for kind in language.ACTIONS.loadable().values() if kind is not language.Each)
    return tuple(form for form in forms if form)


def list_operator_views() -> tuple[wire.Operator, ...]:
    """Return the leaves of extractors, of plug-ins those whose arguments the page knows, and the set operators."""
    kinds = (kind for kind in language.EXTRACTORS.loadable().values() if _has_fields(kind))
    return (*map(_view_leaf, kinds), *map(_view_set_operator, language.SET_OPERATORS))


def _view_leaf(kind: type[language.Leaf]) -> wire.Operator:
    kinds, texts = kind.arguments(), {one.name: one.metadata for one in fields(cast(Any, kind))}
    needed = list(kinds)[: kind.min_arguments()]
    operands = [_field(name, argument, name in needed, texts[name]) for name, argument in kinds.items()]
    return _view_operator(kind.__name__, kind.summary(), operands, issubclass(kind, language.BaseExtractor))


def _view_set_operator(kind: type[language.Union | language.Intersect | language.Diff]) -> wire.Operator:
    sides = [
        wire.Argument(name=name, kind="extractor", title=name.capitalize(), wants="an extractor", words={})
        for name in ("left", "right")
    ]
    return _view_operator(kind.__name__, (kind.__doc__ or "").splitlines()[0], sides)


def _view_operator(name: str, summary: str, operands: Sequence[wire.Argument], base: bool = False) -> wire.Operator:
    names = ", ".join(one.name for one in operands)
    usage = f"{name}({names})" if names else name
    return wire.Operator(name=name, usage=usage, summary=summary, base=base, arguments=tuple(operands))


def _has_fields(kind: type[language.Operation]) -> bool:
    return all(type(argument) in _KINDS for argument in kind.arguments().values())


def view_action(action: Action, label: str | None) -> wire.ActionView:
    """Return an action, and the label that it gives, as the page shows it."""
    inner = action.action if isinstance(action, language.Each) else action
    kinds = inner.arguments()
    return wire.ActionView(
        name=type(inner).__name__,
        arguments={
            name: value if type(kinds[name]) in _KINDS else kinds[name].show(value)
            for name, value in inner.values().items()
        },
        each=inner is not action,
        label=label,
        text=action_text(action, label),
        short=str(action),
        icon=inner.icon,
    )


def read_action(call: wire.ActionCall, where: str) -> tuple[Action, str | None]:
    """Return the action that the page sends, and its label. Raises ProjectError, about `where`, for none."""
    given = {name: value for name, value in call.arguments.items() if value not in ("", False)}
    text = f"{call.name}({', '.join(_show_arguments(call.name, given, where))})" if given else call.name
    text = f"Each({text})" if call.each else text
    return parse_action_text(f"{text} as {language.show_label(call.label)}" if call.label else text, where)


def _show_arguments(name: str, given: Mapping[str, wire.Value], where: str) -> list[str]:
    kind = language.ACTIONS.get(name)
    kinds = kind.arguments() if kind else {}
    for one, value in given.items():
        if one not in kinds:
            raise ProjectError(f"{name} takes no {one}", where=where, remedy=f"Write {kind.usage()}." if kind else None)
        if type(kinds[one]) in _KINDS and not kinds[one].fits(value):
            raise ProjectError(f"{name} takes {kinds[one].wants} as its {one}, not {value!r}", where=where)
    return [
        argument.show(given[one]) if type(argument) in _KINDS else str(given[one])
        for one, argument in kinds.items()
        if one in given
    ]


def _try_form(kind: type[Action]) -> wire.ActionForm | None:
    """The form of an action; None for one of a plug-in that the page has no fields for, or that cannot be made."""
    kinds, texts = kind.arguments(), {one.name: one.metadata for one in fields(cast(Any, kind))}
    if not _has_fields(kind):
        return None
    required = list(kinds)[: kind.min_arguments()]
    example = _try_make(kind, {name: _list_values(kinds[name])[0][1] for name in required})
    if example is None:
        return None
    return wire.ActionForm(
        name=kind.__name__,
        title=kind.title(),
        summary=kind.summary(),
        key=kind.key,
        icon=kind.icon,
        usage=kind.usage(),
        makes=example.makes_hulls,
        arguments=tuple(_field(name, argument, name in required, texts[name]) for name, argument in kinds.items()),
        clashes=tuple(_find_clashes(kind, kinds, required)),
    )


def _field(name: str, argument: ArgumentType, required: bool, texts: Mapping[str, Any]) -> wire.Argument:
    kind = _KINDS[type(argument)][0]
    return wire.Argument(
        name=name,
        kind=kind,
        title=texts.get("title", name.capitalize()),
        wants=argument.wants,
        choices=argument.choices,
        words=texts.get("words", {}),
        omitted=texts.get("omitted", "usual"),
        required=required,
        usual=_list_values(argument)[0][1] if required and kind != "file" else None,
    )


def _list_values(argument: ArgumentType) -> list[Choice]:
    kind, usual = _KINDS[type(argument)]
    words: list[Choice] = [(word, word) for word in argument.choices]
    match kind:
        case "words":
            return words
        case "shape":
            return [*words, (None, _KINDS[language.FileArgument][1])]
        case "flag":
            return [(True, True)]
        case "file" | "factor" | "length" | "option" | "text" | "share" | "label" | "base" | "extractor":
            return [(None, usual)]
        case _:
            assert_never(kind)


def _find_clashes(
    kind: type[Action], kinds: Mapping[str, ArgumentType], required: Sequence[str]
) -> Iterator[tuple[wire.ArgumentValue, wire.ArgumentValue]]:
    """Pairs of values that no action of this kind has together, as making it with them shows."""
    values = {name: _list_values(argument) for name, argument in kinds.items()}
    for one, other in combinations(kinds, 2):
        rest = {name: values[name] for name in required if name not in (one, other)}
        for (word, value), (other_word, other_value) in product(values[one], values[other]):
            if not _goes_together(kind, {one: value, other: other_value}, rest):
                yield wire.ArgumentValue(name=one, value=word), wire.ArgumentValue(name=other, value=other_word)


def _goes_together(kind: type[Action], pair: Mapping[str, wire.Value], rest: Mapping[str, list[Choice]]) -> bool:
    """Whether two values go together with some values of the other required arguments."""
    others = product(*([value for _, value in values] for values in rest.values()))
    return any(_try_make(kind, {**pair, **dict(zip(rest, more, strict=True))}) for more in others)


def _try_make(kind: type[Action], values: Mapping[str, Any]) -> Action | None:
    try:
        return language.make_operation(kind, values)
    except MeshForgeError:
        return None
