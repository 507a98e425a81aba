"""Judges an edited mesh by the checks of its task."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from importlib import import_module
from typing import Any

from benchmark.criteria.case import Case

CRITERIA = ("stands", "supports", "contains", "graspable", "passes", "swings", "structural", "parts")
"""Each a module with `failure(case, **fields)`: why the case does not do, None where it does."""


def judge(case: Case, checks: Sequence[Mapping[str, Any]]) -> str | None:
    """Why a case does not do: the first check that fails, in words; None where all hold."""
    for check in checks:
        fields = dict(check)
        kind = fields.pop("kind")
        assert kind in CRITERIA, f"there is no criterion {kind!r}"
        failure: Callable[..., str | None] = import_module(f"benchmark.criteria.{kind}").failure
        why = failure(case, **fields)
        if why:
            return f"{kind}: {why}"
    return None
