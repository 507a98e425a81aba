"""Codes of findings: every rule has one, every code is of a rule that is found, and pages and `explain` show them."""

import ast
import re
from collections.abc import Iterator
from typing import get_args

import pytest

from meshforge.checks import VALIDATORS
from meshforge.checks.goals.base import GoalOutcome
from meshforge.checks.legality import _REMEDIES as FAULTS
from meshforge.checks.physics.mechanism import _REMEDIES as MASSES
from meshforge.engines import CODES, ENGINES
from script.codes import PAGE, write_page
from script.structure import read_modules
from tests.unit.cli.in_process import Run

RULES = {rule for row in CODES.values() for rule in row.rules}
BY_NAME: dict[str, set[str]] = {
    "limits:f'{engine.name}-{limit.rule}'": {f"{e.name}-{limit.rule}" for e in ENGINES.values() for limit in e.limits},
    "mechanism:f'physics-{rule}'": {f"physics-{rule}" for rule in MASSES},
    "legality:fault": set(FAULTS),
    "build_files:f'goal-{result.outcome}'": {f"goal-{one}" for one in get_args(GoalOutcome)} - {"goal-passed"},
    "examination:name": set(),  # of a plug-in that fails
}
"""Rules whose names are computed, by the module and the expression."""


def find_rules() -> Iterator[tuple[str, str]]:
    """Where each finding is made in the source, and the expression of its rule."""
    for name, module in read_modules().items():
        for node in ast.walk(module.tree):
            if isinstance(node, ast.Call) and ast.unparse(node.func) == "Finding" and node.args:
                yield name.rpartition(".")[2], ast.unparse(node.args[0])


def rules_of(module: str, expression: str) -> set[str]:
    """The rules that an expression may give; of those that begin with an engine, those that have a code."""
    if f"{module}:{expression}" in BY_NAME:
        return BY_NAME[f"{module}:{expression}"]
    if constant := re.fullmatch(r"'([\w-]+)'", expression):
        return {constant[1]}
    suffix = re.fullmatch(r"f'\{[\w.]+\}(-[a-z-]+)'", expression)
    assert suffix, f"{module}: what rules is {expression}?"
    found = {f"{engine}{suffix[1]}" for engine in (*ENGINES, *VALIDATORS)} & RULES
    assert found, f"{module}: no code for {expression}"
    return found


def test_every_rule_has_a_code_and_every_code_is_of_rules_that_are_found() -> None:
    found = set[str]().union(*(rules_of(*place) for place in find_rules()))
    assert found - RULES == set(), "without a code"
    assert RULES - found == set(), "in codes.toml, and nowhere found"
    assert list(CODES) == sorted(CODES) and all(re.fullmatch(r"MF[1-6]\d\d", code) for code in CODES)
    assert sum(len(row.rules) for row in CODES.values()) == len(RULES), "two codes for one rule"


def test_the_page_is_that_of_the_table() -> None:
    assert PAGE.read_text("utf-8") == write_page(), "python -m script.codes writes it"


@pytest.mark.parametrize("name", ["MF204", "mf204", "mujoco-joins"])
def test_a_code_or_a_rule_is_explained(run: Run, name: str) -> None:
    row = CODES["MF204"]
    texts = f"  why: {row.why}\n  what to do: {row.remedy}\n  example: {row.example}\n"
    head = "MF204: The engine makes one hull of a collision mesh of several\n  rules: mujoco-joins, bullet-joins\n"
    assert run("explain", name).out == head + texts


def test_without_a_code_all_are_listed_and_an_unknown_one_names_the_nearest(run: Run) -> None:
    assert [line.split()[0] for line in run("explain").out.splitlines()] == list(CODES)
    for name, near in (("MF-204", "MF204"), ("shape-gaps", "shape-gap")):
        done = run("explain", name)
        assert (done.code, done.out) == (2, "") and f"Did you mean {near!r}?" in done.err
