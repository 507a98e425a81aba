"""The page of all codes, `docs/codes.md`, of `src/meshforge/engines/codes.toml`: `python -m script.codes` writes it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from meshforge.engines import CODES, RuleCode

PAGE = Path(__file__).resolve().parents[1] / "docs" / "codes.md"
_HEAD = """\
# Codes

<!-- Written by `python -m script.codes` of src/meshforge/engines/codes.toml. -->

Everything that `meshforge check`, `goal` and `apply` find has a code, which stays the same over versions: builds can
look for it. `meshforge explain MF204`, or a rule's name, prints a section of this page; `meshforge explain` lists all
codes. Rules of [plug-ins](plugins.md) have names of their own and no code.
"""
_GROUPS = {
    "MF1": "Hulls",
    "MF2": "Engines",
    "MF3": "Fit and clearance",
    "MF4": "Physics",
    "MF5": "Goals and edits",
    "MF6": "Files",
}


def write_page() -> str:
    """The text of the page."""
    return "\n".join([_HEAD, *(line for group in _GROUPS for line in _list_group(group))])


def _list_group(group: str) -> Iterator[str]:
    yield f"## {group}xx: {_GROUPS[group]}\n"
    yield from (_describe(row) for row in CODES.values() if row.code.startswith(group))


def _describe(row: RuleCode) -> str:
    rules = ", ".join(f"`{rule}`" for rule in row.rules)
    lines = [f"Rules: {rules}.", f"Why: {row.why}", f"What to do: {row.remedy}", f"Example: {row.example}"]
    return f"### {row.code}: {row.title}\n\n" + "\n".join(f"- {line}" for line in lines) + "\n"


if __name__ == "__main__":
    PAGE.write_text(write_page(), encoding="utf-8")
