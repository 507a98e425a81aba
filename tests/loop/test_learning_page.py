"""The walk through docs/learning.md, as a newcomer types it."""

from __future__ import annotations

import json
import re
import shlex
from pathlib import Path

import pytest

from meshforge.language import Program
from tests.loop.command import meshforge_here as meshforge

PAGE = Path(__file__).parents[2] / "docs" / "learning.md"


def commands() -> list[list[str]]:
    """The commands of the last section, without those that only begin it."""
    section = PAGE.read_text("utf-8").split("## Try it")[1]
    lines = "\n".join(re.findall(r"```sh\n(.*?)```", section, re.S)).replace("\\\n", " ").splitlines()
    return [shlex.split(line)[1:] for line in lines if line.startswith("meshforge")]


@pytest.mark.long
def test_five_rules_are_taught_with_one_demonstration_and_three_clicks(tmp_path: Path) -> None:
    for words in commands():
        meshforge(*words, cwd=tmp_path, code=int(words[0] == "review"))
    for kind, asset in (("selection", "table_12.obj"), ("candidate", "table_09.obj"), ("candidate", "table_02.obj")):
        question = meshforge("review", "desks", "--json", cwd=tmp_path, code=1).json["question"]
        assert (question["kind"], question["asset"]) == (kind, asset)
        (tmp_path / "said.json").write_text(json.dumps([{"id": question["id"], "choice": 0}]), "utf-8")
        meshforge("review", "desks", "--answers", "said.json", cwd=tmp_path, code=1)
    shown = PAGE.read_text("utf-8").split("Now all rules are what you meant")[1].split("```")[1].strip()
    learned = Program.read(tmp_path / "desks" / "program.mf")
    assert [str(rule) for rule in learned.rules] == [str(rule) for rule in Program.parse(header(learned) + shown).rules]


def header(program: Program) -> str:
    return f"labels {', '.join(program.labels)}\n\n"
