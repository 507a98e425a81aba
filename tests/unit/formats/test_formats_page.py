"""The page on formats names tests that exist, and its table of what conversions keep is that of the code.

`python -m tests.unit.formats.test_formats_page` writes the table anew.
"""

import ast
import re
from pathlib import Path

import pytest

from meshforge.formats import Format, list_formats, list_marked_formats
from meshforge.symbolic import FeatureKind

ROOT = Path(__file__).parents[3]
PAGE = ROOT / "docs" / "formats.md"
_START, _END = "<!-- {}: made by tests/unit/formats/test_formats_page.py -->\n", "<!-- end of {} -->"
_MATRICES = {
    "matrix": [known for known in list_formats() if known.writable],
    "named matrix": [known for names in ("unreal", "godot", "unity") for known in list_marked_formats(names)],
}


def matrix(formats: list[Format]) -> str:
    """What each format takes over from others, a row for each kind of thing that any of them takes."""
    rows = [["", *(known.title for known in formats)], ["---"] * (len(formats) + 1)]
    for what in FeatureKind:
        cells = ["●" if what in known.holds else known.instead.get(what, "") for known in formats]
        if "●" in cells:
            rows.append([what.many, *cells])
    return "".join(f"| {' | '.join(row)} |\n" for row in rows)


@pytest.mark.parametrize("name", _MATRICES)
def test_the_page_tells_what_conversions_keep(name: str) -> None:
    assert f"{_START.format(name)}\n{matrix(_MATRICES[name])}\n{_END.format(name)}" in PAGE.read_text()


@pytest.mark.slow
def test_every_test_that_the_page_names_exists() -> None:
    named: list[tuple[str, str]] = []
    for file, test in re.findall(r"`([\w/.]*)::(\w+)`", PAGE.read_text()):
        named.append((file or named[-1][0], test))
    known = {file: _tests(ROOT / file) for file, _ in named}
    assert len(named) > 80
    assert [place for place in named if place[1] not in known[place[0]]] == []


def _tests(file: Path) -> set[str]:
    return {node.name for node in ast.parse(file.read_text()).body if isinstance(node, ast.FunctionDef)}


if __name__ == "__main__":
    for title, made in _MATRICES.items():
        start, end = _START.format(title), _END.format(title)
        head, _, tail = PAGE.read_text().partition(start)
        PAGE.write_text(f"{head}{start}\n{matrix(made)}\n{end}{tail.partition(end)[2]}")
