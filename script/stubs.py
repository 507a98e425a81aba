"""The `__init__.pyi` of packages that import their names when they are first used: what type checkers read of them.

`python -m script.stubs` writes them beside the `__init__.py`; with --check it names those that are not as they would
be written, and exits 1.
"""

from __future__ import annotations

import ast
import sys
from collections.abc import Iterator
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[1] / "src"
_HEAD = "# Written by `python -m script.stubs`.\n"


def read_offers(tree: ast.Module, package: str) -> list[ast.ImportFrom]:
    """What a package imports when it is first used, as the imports that would do so at once."""
    calls = (node.value for node in tree.body if isinstance(node, ast.Assign) and isinstance(node.value, ast.Call))
    return [
        ast.ImportFrom(
            home if home.startswith("meshforge.") else f"{package}.{home}",
            [ast.alias(name, name) for name in names.split()],
            0,
        )
        for call in calls
        if isinstance(call.func, ast.Name) and call.func.id == "export_lazily"
        for home, names in ast.literal_eval(call.args[1]).items()
    ]


def list_stubs() -> Iterator[tuple[Path, str]]:
    """The file and the text of each stub."""
    for path in sorted(SOURCE.rglob("__init__.py")):
        tree = ast.parse(path.read_text("utf-8"))
        offers = read_offers(tree, ".".join(path.relative_to(SOURCE).parts[:-1]))
        eager = [node for node in tree.body if isinstance(node, ast.ImportFrom) and _is_offered(node)]
        if offers:
            head = _HEAD + "__version__: str\n__all__: list[str]\n" * (path.parent.parent == SOURCE)
            yield path.with_suffix(".pyi"), head + "".join(map(_format_import, [*eager, *offers]))


def _is_offered(node: ast.ImportFrom) -> bool:
    return str(node.module).startswith("meshforge.") and node.module != "meshforge.common.exports"


def _format_import(node: ast.ImportFrom) -> str:
    return "".join(f"from {node.module} import {one.name} as {one.name}\n" for one in node.names)


def main(words: list[str]) -> int:
    """Write all stubs, or name those that are not as they would be; 1 where one is not."""
    stale = [(path, text) for path, text in list_stubs() if not path.exists() or path.read_text("utf-8") != text]
    for path, text in stale:
        if "--check" in words:
            print(f"{path.relative_to(SOURCE.parent)}: not as python -m script.stubs writes it", file=sys.stderr)
        else:
            path.write_text(text, "utf-8")
    return int(bool(stale) and "--check" in words)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
