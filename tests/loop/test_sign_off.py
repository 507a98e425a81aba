"""The bundled tables from new to signed off, by replies from a file alone."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from meshforge.cli.demo import create_tables
from tests.unit.cli.in_process import runner

MOST_REPLIES = 30


@pytest.mark.slow
def test_the_tables_are_signed_off_by_replies_from_a_file(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    meshforge = runner(monkeypatch, capsys)
    project = create_tables(tmp_path / "demo")
    folder, said = str(project.folder), tmp_path / "said.json"
    found = meshforge("review", folder, "--json")
    for _ in range(MOST_REPLIES):
        question = found.json["question"]
        if question is None:
            break
        said.write_text(json.dumps([{"id": question["id"], "choice": 0}]))
        found = meshforge("review", folder, "--json", "--answers", str(said))
    assert found.code == 0 and found.json["held"] == []
    assert meshforge("status", folder, "--signed-off").code == 1  # sure, but not written yet
    assert meshforge("apply", folder, "--sure", "0.95").code == 0
    status = meshforge("status", folder, "--json", "--signed-off")
    assert status.code == 0 and status.json["signed_off"] == 14
    assert meshforge("info", "table_01.obj", "--project", folder, "--json").json["probability"] >= 0.95
