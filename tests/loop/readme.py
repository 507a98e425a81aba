"""The commands of the README and of other pages, as a person would copy them."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

README = Path(__file__).resolve().parents[2] / "README.md"


def commands(about: str, page: Path = README) -> list[list[str]]:
    """The words after `meshforge` of every command in a page's shell blocks that has `about` among them."""
    blocks = re.findall(r"^```sh\n(.*?)^```", page.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)
    lines = "".join(blocks).replace("\\\n", " ").splitlines()
    found = [shlex.split(line, comments=True) for line in lines]
    return [words[1:] for words in found if words[:1] == ["meshforge"] and about in "/".join(words)]
