"""The commands of the README and of other pages, as a person would copy them."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

README = Path(__file__).resolve().parents[2] / "README.md"


def read_blocks(language: str, page: Path = README) -> list[str]:
    """The text of every block of a page that is marked as of a language, `""` for those of none."""
    found = re.findall(r"^```(\w*)\n(.*?)^```$", page.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)
    return [text for marked, text in found if marked == language]


def parse_commands(text: str) -> list[list[str]]:
    """The words after `meshforge` of every command in lines of a shell."""
    lines = text.replace("\\\n", " ").splitlines()
    found = [shlex.split(line, comments=True) for line in lines]
    return [words[1:] for words in found if words[:1] == ["meshforge"]]


def commands(about: str, page: Path) -> list[list[str]]:
    """The words after `meshforge` of every command in a page's shell blocks that has `about` among them."""
    return [words for words in parse_commands("".join(read_blocks("sh", page))) if about in "/".join(words)]
