"""Judges an edited mesh by the checks of its task."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from benchmark.criteria import parts, physical, structural
from benchmark.criteria.case import Case

_PHYSICAL = (
    physical.stands,
    physical.supports,
    physical.contains,
    physical.graspable,
    physical.passes,
    physical.swings,
)
_FAILURES: Mapping[str, Callable[..., str | None]] = {
    **{kind.__name__: kind for kind in _PHYSICAL},
    "structural": structural.failure,
    "parts": parts.failure,
}
CRITERIA = tuple(_FAILURES)
"""Each says why a case does not do, None where it does."""


def judge(case: Case, checks: Sequence[Mapping[str, Any]]) -> str | None:
    """Why a case does not do: the first check that fails, in words; None where all hold."""
    for check in checks:
        fields = dict(check)
        kind = fields.pop("kind")
        assert kind in CRITERIA, f"there is no criterion {kind!r}"
        why = _FAILURES[kind](case, **fields)
        if why:
            return f"{kind}: {why}"
    return None
