"""The Python interface as a type checker sees it: names that are not there are errors."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, assert_type

import meshforge as mf
from meshforge.checks import Examination
from meshforge.language import Diff
from meshforge.symbolic import SymbolicMesh

if TYPE_CHECKING:  # mypy, which checks the tests, reports each ignored error that is none
    mesh = mf.load("table.urdf", labels={"top": "panel"})
    assert_type(mesh, SymbolicMesh)
    assert_type(mf.Is("leg") - mf.All(), Diff)
    assert_type(mf.check(mesh, "unity"), Examination)
    assert_type(mf.__version__, str)
    program = mf.Program(rules=(mf.Rule(mf.Is("leg") & mf.Geo(mf.All(), "+Z"), mf.Delete()),))
    mf.laod("table.urdf")  # type: ignore[attr-defined]
    mf.Geo(mf.All(), "up")  # type: ignore[arg-type]


def test_the_names_for_type_checkers_are_those_of_the_interface() -> None:
    """What `TYPE_CHECKING` imports, and what is found at run time, are two lists: they must not part."""
    text = Path(mf.__file__).read_text()
    block = text.split("if TYPE_CHECKING:\n")[1].split("__all__")[0]
    words = block.replace("(", " ").replace(")", " ").replace(",", " ").split()
    homes = {"from", "import", "__version__:", "str"}
    names = [word for word in words if word not in homes and not word.startswith("meshforge.")]
    assert sorted(names) == sorted(mf.__all__)
