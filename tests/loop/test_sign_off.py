"""The bundled tables from a new project to signed off, by replies from files as a script gives them."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from meshforge.cli.demo import create_tables
from meshforge.formats import load
from meshforge.samples import TABLES
from meshforge.signoff import THRESHOLD
from tests.loop.mistaken_tables import MEANT, OTHERS, SHOWN, create_project, reply_to
from tests.unit.cli.in_process import Run

MOST_REPLIES = 30


def sign_off(run: Run, folder: str, reply: Callable[[dict[str, Any]], dict[str, Any]]) -> int:
    """Reply until nothing is asked any more, and apply what is sure; how many assets are signed off then."""
    assert run("status", folder, "--signed-off").code == 1
    asked, done = list[str](), run("review", folder, "--json")
    while question := done.json["question"]:
        asked.append(f"{question['kind']} {question['asset']}")
        assert len(asked) <= MOST_REPLIES, asked
        assert all(Path(picture).exists() for picture in question["pictures"])
        said = reply(question)
        Path("said.json").write_text(json.dumps([{"id": question["id"], **said}] if said else []))
        done = run("review", folder, "--json", "--answers", "said.json")
    assert done.code == 0 and done.json["needs_review"] == [], done.json
    assert run("status", folder, "--signed-off").code == 1  # sure, but not written yet
    assert run("apply", folder, "--min-confidence", str(THRESHOLD), "--workers", "1").code == 0
    status = run("status", folder, "--json", "--signed-off")
    assert status.code == 0
    return int(status.json["signed_off"])


@pytest.mark.long
def test_tables_with_right_labels_are_signed_off_by_the_first_choice_of_each_question(run: Run) -> None:
    folder = str(create_tables(Path("demo")).folder)
    assert sign_off(run, folder, lambda question: {"choice": 0}) == 14
    assert run("info", "table_01.obj", "--project", folder, "--json").json["probability"] >= THRESHOLD


@pytest.mark.long
def test_tables_with_wrong_labels_are_signed_off_by_right_replies_and_come_out_right(tmp_path: Path, run: Run) -> None:
    project = create_project(tmp_path)
    assert sign_off(run, "tables", lambda question: reply_to(question, project)) == len(SHOWN) + len(OTHERS)
    assert project.program() == MEANT
    templates = project.templates(MEANT.templates)
    for name in OTHERS:
        right = MEANT.run(load(TABLES / name), templates).mesh
        assert len(load(project.folder / "edited" / name).hulls) == len(right.hulls), name
