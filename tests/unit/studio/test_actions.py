"""Actions as the page shows and sends them, against the language itself; those of plug-ins take the same road."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from itertools import combinations, product

import pytest

from meshforge.common import MeshForgeError, ProjectError
from meshforge.language import (
    ACTIONS,
    Action,
    ArgumentType,
    FactorArgument,
    GroupEdit,
    HullGroup,
    WordArgument,
    make_operation,
)
from meshforge.store import parse_action_text
from meshforge.studio.actions import list_action_forms, read_action, view_action
from meshforge.studio.wire.program import ActionCall, ActionForm, Value

FORMS = list_action_forms()
VALUES: dict[str, Value] = {"file": "part.obj", "shape": "capsule", "factor": 2.0, "length": 0.01, "flag": True}


@dataclass(frozen=True, slots=True)
class Vector(ArgumentType):
    """Three numbers in quotes, which the page has no field for."""

    usage = '"x y z"'
    wants = "three numbers in double quotes"

    def read(self, kind: str, text: str) -> tuple[float, ...] | None:
        return tuple(map(float, text.split())) if kind == "text" else None

    def fits(self, value: object) -> bool:
        return isinstance(value, tuple)

    def show(self, value: tuple[float, ...]) -> str:
        return '"' + " ".join(map(repr, value)) + '"'


class Plain(Action):
    __slots__ = ()

    def edit(self, group: HullGroup) -> GroupEdit:
        return GroupEdit(removes=False)


@dataclass(frozen=True, slots=True)
class Contract(Plain):
    """Pulls hulls towards their centres."""

    factor: float = field(metadata={"argument": FactorArgument()})
    kind: str | None = field(default=None, metadata={"argument": WordArgument(("fast", "exact"))})

    def conflict(self) -> str | None:
        return "fast is for factors of at least 1" if self.kind == "fast" else None


@dataclass(frozen=True, slots=True)
class Move(Plain):
    by: tuple[float, ...] = field(metadata={"argument": Vector()})


@pytest.fixture
def plugins(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    for kind in (Contract, Move):
        monkeypatch.setitem(ACTIONS.built_in, kind.__name__, kind)
    yield


def form_of(name: str) -> ActionForm:
    return next(form for form in list_action_forms() if form.name == name)


def filled(form: ActionForm, required: bool) -> ActionCall:
    """An action of a form, with a capsule and else the first choice everywhere."""
    wanted = [a for a in form.arguments if a.kind != "option" and (a.required or not required)]
    return ActionCall(name=form.name, arguments={a.name: VALUES.get(a.kind) or a.choices[0] for a in wanted})


def test_every_action_but_each_has_a_form() -> None:
    assert [form.name for form in FORMS] == [name for name in ACTIONS if name != "Each"]
    keys = [form.key for form in FORMS]
    assert all(keys)
    assert len(set(keys)) == len(keys)
    assert len({form.icon for form in FORMS}) == len(FORMS)


@pytest.mark.parametrize("form", FORMS, ids=lambda form: form.name)
def test_a_form_makes_an_action(form: ActionForm) -> None:
    action, label = read_action(filled(form, required=True), "x")
    assert type(action).__name__ == form.name
    assert label is None
    assert action.makes_hulls == form.makes
    assert form.summary.endswith(".")
    assert form.usage.startswith(form.name)


def test_a_form_with_everything_filled_in_is_an_action_where_its_words_go_together() -> None:
    texts = {form.name: str(read_action(filled(form, required=False), "x")[0]) for form in FORMS}
    assert texts["Add"] == 'Add(+X, "part.obj", keep)'
    assert texts["Replace"] == "Replace(capsule, native, X, clear)"


@pytest.mark.parametrize(
    "text",
    [
        "Delete",
        "Merge as leg",
        "Each(Merge)",
        "Replace(capsule, tight)",
        'Each(Replace("tray, big.obj", longest)) as "table top"',
        'Add(-Z, "a \\"b\\".obj", keep)',
        "Scale(Z, 0.5)",
        "Replace(sphere, radius = 0.05)",
        "Each(Replace(cylinder, native, Z)) as Delete_",
        "Replace(capsule, X, radius = 0.01) as grip",
        "Shrink(0.002)",
        'Merge as "Delete"',
    ],
)
def test_an_action_comes_back_from_the_page_as_it_was(text: str) -> None:
    action, label = parse_action_text(text, "x")
    shown = view_action(action, label)
    assert shown.text == text
    assert shown.text == f"{shown.short} as {text.rpartition(' as ')[2]}" if label else shown.short == text
    sent = shown.model_dump_json(include=set(ActionCall.model_fields))
    assert read_action(ActionCall.model_validate_json(sent), "x") == (action, label)


@pytest.mark.parametrize(
    ("call", "said"),
    [
        ({"name": "Replce", "arguments": {}}, "'Replce' is no action"),
        ({"name": "Replce", "arguments": {"geometry": "box"}}, "Replce takes no geometry"),
        ({"name": "Merge", "arguments": {"factor": 2}}, "Merge takes no factor"),
        ({"name": "Scale", "arguments": {"axis": "Q", "factor": 2}}, "Scale takes all, X, Y or Z as its axis, not 'Q'"),
        ({"name": "Scale", "arguments": {"axis": "X", "factor": -1}}, "a number above 0 as its factor, not -1"),
        ({"name": "Scale", "arguments": {"axis": "X"}}, "'Scale(X)' is no action"),
        ({"name": "Replace", "arguments": {"geometry": "box", "fit": "native"}}, "takes tight, inscribed or volume"),
        ({"name": "Delete", "label": "leg"}, "Delete"),
    ],
)
def test_what_is_no_action_is_refused_with_one_clear_message(call: dict[str, object], said: str) -> None:
    with pytest.raises(ProjectError) as caught:
        read_action(ActionCall.model_validate(call), "step 2")
    assert said in str(caught.value)
    assert caught.value.where == "step 2"


@pytest.mark.parametrize("geometry", ["box", "cylinder", "capsule", "sphere", None])
def test_clashes_are_what_the_language_refuses(geometry: str | None) -> None:
    clashes = {frozenset(((a.name, a.value), (b.name, b.value))) for a, b in form_of("Replace").clashes}
    words = {"fit": ("native", "tight", "inscribed", "volume", "longest"), "axis": ("X", "Y", "Z"), "radius": (None,)}
    for one, other in combinations(words, 2):
        for first, second in product(words[one], words[other]):
            pairs = [("geometry", geometry), (one, first), (other, second)]
            values = {name: 0.01 if name == "radius" else (word or "bar.obj") for name, word in pairs}
            clash = any(frozenset(two) in clashes for two in combinations(pairs, 2))
            assert clash == (not can_make("Replace", values))


def can_make(name: str, values: Mapping[str, object]) -> bool:
    try:
        make_operation(ACTIONS[name], values)
    except MeshForgeError:
        return False
    return True


@pytest.mark.usefixtures("plugins")
def test_an_action_of_a_plugin_takes_the_same_road() -> None:
    form = form_of("Contract")
    assert (form.title, form.key, form.icon) == ("Contract the selection", "", "shapes")
    assert form.summary == "Pulls hulls towards their centres."
    assert [(argument.title, argument.usual) for argument in form.arguments] == [("Factor", 0.9), ("Kind", None)]
    assert [(b.name, b.value) for _, b in form.clashes] == [("kind", "fast")]
    action, _ = read_action(ActionCall(name="Contract", arguments={"factor": 0.5}, each=True), "x")
    assert view_action(action, None).text == "Each(Contract(0.5))"


@pytest.mark.usefixtures("plugins")
def test_an_argument_that_the_page_has_no_field_for_comes_back_as_it_was() -> None:
    assert all(form.name != "Move" for form in list_action_forms())
    action, label = parse_action_text('Move("1.0 2.0 3.0") as leg', "x")
    shown = view_action(action, label)
    assert shown.arguments == {"by": '"1.0 2.0 3.0"'}
    assert read_action(shown, "x") == (action, label)
