"""The language as the page gets it, against the language itself."""

from __future__ import annotations

import pytest

from meshforge.language import ACTIONS, OPERATORS, parse_extractor
from meshforge.studio.queries.programs import build_language_view
from meshforge.studio.wire.program import ActionForm
from tests.program_parts import parse_action

VIEW = build_language_view()
VALUES = {"file": '"part.obj"', "factor": "2", "length": "0.01", "shape": "capsule"}


def written(form: ActionForm, required: bool) -> str:
    """An action filled into its form, with a capsule and else the first choice everywhere."""
    wanted = [a for a in form.arguments if a.kind != "option" and (a.required or not required)]
    given = [VALUES.get(a.kind) or a.choices[0] for a in wanted]
    return f"{form.name}({', '.join(given)})" if given else form.name


def test_every_action_but_each_has_a_form() -> None:
    assert [form.name for form in VIEW.actions] == [name for name in ACTIONS if name != "Each"]


@pytest.mark.parametrize("form", VIEW.actions, ids=lambda form: form.name)
def test_a_form_makes_text_that_parses(form: ActionForm) -> None:
    action = parse_action(written(form, required=True))
    assert type(action).__name__ == form.name
    assert action.makes_hulls == form.makes
    assert form.summary.endswith(".")
    assert form.usage.startswith(form.name)


def test_a_form_with_everything_filled_in_parses_where_its_words_go_together() -> None:
    texts = {form.name: written(form, required=False) for form in VIEW.actions}
    assert texts["Add"] == 'Add(+X, "part.obj", keep)'
    assert texts["Replace"] == "Replace(capsule, native, X)"
    for text in texts.values():
        parse_action(text)


def test_every_operator_is_told_with_its_operands() -> None:
    assert [operator.name for operator in VIEW.operators] == list(OPERATORS)
    usage = {operator.name: operator.usage for operator in VIEW.operators}
    assert usage["All"] == "All"
    assert usage["Is"] == "Is(label)"
    for text in usage.values():
        operands = text.replace("label", "leg").replace("direction", "+X").replace("extractor", "All")
        for name in ("selected", "anchor", "base", "left", "right"):
            operands = operands.replace(name, "All")
        parse_extractor(operands)
    assert all(operator.summary for operator in VIEW.operators)
