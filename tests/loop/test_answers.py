"""Two tables teach three rules that leave something open; answers from a file settle them."""

from __future__ import annotations

import json
import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from meshforge.language import Program, Rule
from meshforge.project import Project
from meshforge.samples import TABLES
from meshforge.synthesis import Step
from tests.loop.command import meshforge_here as meshforge

TAUGHT = Program.read(TABLES / "tables.mf")
MEANT = replace(TAUGHT, rules=(TAUGHT.rules[0], TAUGHT.rules[1], TAUGHT.rules[4]))
"""Crumbs go, the highest panels become a box, handles on drawers capsules."""
SHOWN = ("table_01.obj", "table_12.obj")
"""The handles of both that touch a drawer are their lowest or their foremost ones, too."""


@pytest.fixture(scope="module")
def tables(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the bundled tables and a project, in which two of them are demonstrated."""
    folder = tmp_path_factory.mktemp("tables")
    (folder / "assets").mkdir()
    for source in TABLES.glob("table_*"):
        shutil.copyfile(source, folder / "assets" / source.name)
    project = Project.create(
        folder / "tables", [folder / "assets"], vocabulary=TAUGHT.labels, orient="+Z: Is(leg) -> Is(panel)"
    )
    project.label("file")
    for asset in SHOWN:
        steps = enumerate(_meant(folder, asset), 1)
        project.demonstrate(asset, [Step(k, names, rule.action) for k, (names, rule) in steps])
    return folder


def _meant(folder: Path, asset: str) -> list[tuple[list[str], Rule]]:
    """What each rule is meant to select on a table, with the rule."""
    mesh = Project.open(folder / "tables").mesh(asset)
    return [(list(trace.selected), rule) for trace, rule in zip(MEANT.run(mesh).trace, MEANT.rules, strict=True)]


def test_questions_are_answered_from_a_file_until_the_program_is_what_is_meant(tables: Path) -> None:
    assert meshforge("synthesize", "tables", "--json", cwd=tables).json["status"] == "ambiguous"
    found, given = meshforge("review", "tables", "--json", cwd=tables, code=1).json, 0
    while (question := found["question"]) and question["kind"] == "candidate":
        right = set(_meant(tables, question["asset"])[question["rule"] - 1][0])
        choices = [set(choice["select"]) for choice in question["choices"]]
        assert right in choices
        (tables / "given.json").write_text(json.dumps([{"id": question["id"], "choice": choices.index(right)}]))
        given += 1
        assert given <= 4
        found = meshforge("review", "tables", "--json", "--answers", "given.json", cwd=tables, code=1).json
    assert Program.read(tables / "tables" / "program.mf") == MEANT
    assert given
