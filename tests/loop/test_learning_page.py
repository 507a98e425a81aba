"""The walk through docs/learning.md, as a newcomer types it."""

from __future__ import annotations

import json
import re
import shlex
from pathlib import Path

from meshforge.language import Program
from tests.loop.command import meshforge_here as meshforge

PAGE = Path(__file__).parents[2] / "docs" / "learning.md"


def commands() -> list[list[str]]:
    """The commands of the last section, without those that only begin it."""
    section = PAGE.read_text("utf-8").split("## Try it")[1]
    lines = "\n".join(re.findall(r"```sh\n(.*?)```", section, re.S)).replace("\\\n", " ").splitlines()
    return [shlex.split(line)[1:] for line in lines if line.startswith("meshforge")]


def test_five_rules_are_taught_with_one_demonstration_and_one_answer(tmp_path: Path) -> None:
    for words in commands():
        meshforge(*words, cwd=tmp_path)
    (tmp_path / "answers.json").write_text(json.dumps([{"question": "5:table_03.obj", "choice": 2}]), "utf-8")
    meshforge("synthesize", "desks", "--answers", "answers.json", cwd=tmp_path)
    page = PAGE.read_text("utf-8")
    assert '[{"question": "5:table_03.obj", "choice": 2}]' in page
    shown = page.split("Answer 2, and")[1].split("```")[1].strip()
    learned = Program.read(tmp_path / "desks" / "program.mf")
    assert [str(rule) for rule in learned.rules] == [str(rule) for rule in Program.parse(header(learned) + shown).rules]


def header(program: Program) -> str:
    return f"labels {', '.join(program.labels)}\n\n"
