"""The limits of the source's structure: they are kept, and what breaks one is found."""

from __future__ import annotations

from pathlib import Path

import pytest

from script import structure
from script.structure import Module


def modules(folder: Path, **texts: str) -> dict[str, Module]:
    """Modules of a package `meshforge`, by their last names; `_` stands for a dot."""
    found = {}
    for key, text in texts.items():
        name = f"meshforge.{key.replace('_', '.')}"
        path = folder / f"{key}.py"
        path.write_text(text)
        found[name] = Module(name, path)
    return found


def test_a_cycle_by_a_lazy_and_a_type_only_import_is_found(tmp_path: Path) -> None:
    found = modules(
        tmp_path,
        a="def f():\n    from meshforge.b import g\n",
        b="from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from meshforge.c import C\n",
        c="import meshforge.a\n",
        d="from meshforge import a\n",
    )
    graph = structure.import_graph(found)
    assert structure.find_cycles(graph) == [["meshforge.a", "meshforge.b", "meshforge.c"]]
    assert graph["meshforge.d"] == {"meshforge.a"}


@pytest.mark.parametrize("name", ["told", "_found_hulls", "merging", "Painted"])
def test_participles_are_known(name: str) -> None:
    assert structure.is_participle(name)


def test_participles_are_found_in_functions_methods_classes_and_modules_but_not_in_properties(tmp_path: Path) -> None:
    text = "def told(): ...\nclass Painted:\n    def made(self): ...\n    @property\n    def kept(self): ...\n"
    found = structure.find_participles(modules(tmp_path, merging=text))
    assert found == [
        "meshforge.merging",
        "meshforge.merging:Painted",
        "meshforge.merging:told",
        "meshforge.merging:Painted.made",
    ]


def test_nine_parameters_are_too_many_but_for_a_command(tmp_path: Path) -> None:
    names = ", ".join("abcdefgh")
    text = f"def eight({names}): ...\ndef nine({names}, *, i): ...\nclass C:\n    def m(self, {names}): ...\n"
    text += f"def command({names}, i: Annotated[int, typer.Option()]): ...\n"
    found = structure.find_long_signatures(modules(tmp_path, a=text))
    assert found == ["meshforge.a:nine takes 9 parameters"]


def test_a_lazy_import_has_to_say_why(tmp_path: Path) -> None:
    text = "import os\ndef f():\n    import json\n    import ast  # lazy: seldom needed\n"
    (line,) = structure.find_silent_lazy_imports(modules(tmp_path, a=text))
    assert line.startswith("meshforge.a, line 3")
