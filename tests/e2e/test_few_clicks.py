"""How much work five rules are, from labelled assets to a learned program, in the browser."""

from __future__ import annotations

from pathlib import Path

import pytest
from playwright.sync_api import Browser

from tests.e2e.walk import demonstrate_tables, learned, visiting
from tests.studio_project import FEW, demo_project

MOST = 44
"""Clicks and keys for five rules, shown on two assets, as the README says."""


@pytest.mark.parametrize("latency", [pytest.param(0, marks=pytest.mark.long), 400], ids=["quick", "typed-ahead"])
def test_five_rules_take_few_clicks_and_keys(tmp_path: Path, latency: int, browser: Browser) -> None:
    project = demo_project(tmp_path, demonstrated=False, orient="", tables=FEW)
    with visiting(tmp_path, project, browser, latency=latency) as (studio, person):
        demonstrate_tables(person)
        program = learned(studio)
        rules = [line.split("=>")[1].strip() for line in program.splitlines() if "=>" in line]
        assert rules == ["Delete", "Replace(box)", "Each(Merge)", 'Each(Replace("tray.obj"))', "Each(Replace(capsule))"]
    print(f"\nfive rules, two demonstrations: {person.actions} clicks and keys (at most {MOST})")
    assert person.actions <= MOST
