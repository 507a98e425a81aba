"""The language as the page gets it, against the language itself."""

from __future__ import annotations

from meshforge.language import OPERATORS, parse_extractor
from meshforge.studio.queries.programs import build_language_view

VIEW = build_language_view()


def test_every_operator_is_listed_with_its_operands() -> None:
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
