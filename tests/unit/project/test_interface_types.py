"""The Python interface as a type checker sees it: names that are not there are errors."""

from __future__ import annotations

from itertools import pairwise
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
    """The stub, and what is found at run time, are two lists: they must not part."""
    words = Path(mf.__file__).with_suffix(".pyi").read_text().split()
    assert sorted(word for before, word in pairwise(words) if before == "as") == sorted(mf.__all__)
