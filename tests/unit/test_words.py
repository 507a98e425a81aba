"""Words of the source: one word for one thing, in the field's own terms; `docs/glossary.md` has them."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

SOURCE = Path(__file__).resolve().parents[2] / "src" / "meshforge"
INSTEAD = {
    "lesson": "inputs digest",
    "mended": "corrected",
    "mend": "fix",
    "surer": "more confident",
    "sureness": "confidence",
    "doubt": "reason",
    "doubts": "reasons",
    "trial": "program run",
    "trials": "program runs",
    "flip": "alternative label",
    "flips": "alternative labels",
    "foreign": "unseen labels",
    "unlike": "outlier score",
    "correction": "manual edit or label fix",
    "corrections": "manual edits or label fixes",
    "survey": "asset index",
    "successors": "hull mapping",
    "heir": "source",
    "owed": "pending",
    "standing": "result status",
    "standings": "result statuses",
    "lookups": "result status",
    "adviser": "next step",
    "told": "text, message or answers",
    "tell": "report",
    "say": "show",
    "said": "text, message or answers",
    "held": "needs review",
    "bar": "threshold",
    "settled": "unambiguous",
    "slip": "likely mistake",
    "slips": "likely mistakes",
    "readings": "candidate programs",
    "opaque": "non-convex",
}
"""Parts of identifiers and of JSON keys that are not used, and what is."""
IN_MESSAGES = re.compile(r"\b(mended|set aside|put off|lesson|slips?|is held|are held|held back|a bar of)\b")
EARLIER = frozenset({"lesson", "set aside"})
"""What files of earlier versions have."""


def _modules() -> Iterator[tuple[Path, ast.Module]]:
    for path in sorted(SOURCE.rglob("*.py")):
        yield path, ast.parse(path.read_text(encoding="utf-8"))


def _identifiers(tree: ast.Module) -> Iterator[tuple[int, str]]:
    for node in ast.walk(tree):
        match node:
            case ast.FunctionDef() | ast.AsyncFunctionDef() | ast.ClassDef():
                yield node.lineno, node.name
            case ast.Name(id=name, ctx=ast.Store()) | ast.Attribute(attr=name, ctx=ast.Store()) | ast.arg(arg=name):
                yield node.lineno, name
            case ast.Dict(keys=keys):
                yield from ((node.lineno, key) for key in map(_read_key, keys) if key)
            case _:
                pass


def _read_key(node: ast.expr | None) -> str | None:
    key = node.value if isinstance(node, ast.Constant) else None
    return key if isinstance(key, str) and key.isidentifier() else None


def _parts(name: str) -> list[str]:
    return [part.lower() for part in re.findall(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])", name)]


def test_identifiers_json_keys_and_modules_use_the_fields_words() -> None:
    found = [
        f"{path.relative_to(SOURCE)}:{line}: {name}: {INSTEAD[part]}, not {part}"
        for path, tree in _modules()
        for line, name in [(1, path.stem), *_identifiers(tree)]
        for part in _parts(name)
        if part in INSTEAD
    ]
    assert not found, "\n".join(found)


def test_messages_use_them_too() -> None:
    found = [
        f"{path.relative_to(SOURCE)}:{node.lineno}: {node.value}"
        for path, tree in _modules()
        for node in ast.walk(tree)
        if isinstance(node, ast.Constant)
        and isinstance(node.value, str)
        and IN_MESSAGES.search(node.value)
        and node.value not in EARLIER
    ]
    assert not found, "\n".join(found)


@pytest.mark.parametrize("name", ["held_assets", "FamilyTrial", "flipsOf"])
def test_a_word_is_found_in_any_case(name: str) -> None:
    assert any(part in INSTEAD for part in _parts(name))
