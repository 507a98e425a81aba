"""Every odd or broken input that is kept: read right, or refused with one clear message, and nothing written."""

from __future__ import annotations

import pytest

from tests.corpus_case import ROOT, Case, cases, files_below, told

CASES = cases()


LONGEST = "gltf/bomb_accessor_count_ten_million.gltf"


def mark(case: Case) -> list[pytest.MarkDecorator]:
    return [pytest.mark.long] if case.name == LONGEST else [pytest.mark.slow] if case.is_bomb else []


@pytest.mark.parametrize("case", [pytest.param(case, id=case.name, marks=mark(case)) for case in CASES])
def test_an_odd_input_is_read_right_or_refused_as_expected(case: Case) -> None:
    before = list(files_below(case.path.parent))
    done = told(case)
    assert list(files_below(case.path.parent)) == before
    assert done.code in (0, 2)
    assert "Traceback" not in done.err + done.out
    assert "fault of MeshForge" not in done.err + done.out
    assert done.golden == case.expected


def test_every_expectation_is_of_an_input() -> None:
    inputs = {case.path for case in CASES}
    kept = {path for path in ROOT.glob("*/*") if path.suffix in (".out", ".err")}
    assert {path.with_suffix("") for path in kept} == inputs
