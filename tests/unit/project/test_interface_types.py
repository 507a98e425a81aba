"""The Python interface as a type checker sees it: names that are not there are errors."""

from __future__ import annotations

from pathlib import Path

import pytest
from mypy import api

import meshforge as mf

SNIPPET = """
import meshforge as mf

mesh = mf.load("table.urdf", labels={"top": "panel"})
reveal_type(mesh)
reveal_type(mesh["top"].vertices)
reveal_type(mf.Is("leg") - mf.All())
reveal_type(mf.check(mesh, "unity"))
reveal_type(mf.__version__)
program = mf.Program(rules=(mf.Rule(mf.Is("leg") & mf.Geo(mf.All(), "+Z"), mf.Delete()),))
mf.laod("table.urdf")
mf.Geo(mf.All(), "up")
"""


@pytest.mark.long
def test_a_name_that_is_misspelt_is_an_error_for_mypy(tmp_path: Path) -> None:
    (tmp_path / "snippet.py").write_text(SNIPPET)
    root = Path(mf.__file__).parents[2]
    words = ["--config-file", str(root / "pyproject.toml"), "--cache-dir", str(tmp_path / "cache")]
    told, errors, code = api.run([*words, "--no-error-summary", str(tmp_path / "snippet.py")])
    lines = [line.split("snippet.py:")[-1] for line in told.splitlines()]
    assert (errors, code) == ("", 1)
    assert [line for line in lines if "error:" in line] == [
        '11: error: Module has no attribute "laod"  [attr-defined]',
        "12: error: Argument 2 to \"Geo\" has incompatible type \"Literal['up']\"; expected \"Literal['+X', '-X',"
        " '+Y', '-Y', '+Z', '-Z']\"  [arg-type]",
    ]
    revealed = [line.split('"')[1].split(".")[-1] for line in lines if "Revealed type" in line]
    assert [revealed[0], *revealed[2:]] == ["SymbolicMesh", "Diff", "Examination", "str"]
    assert "ndarray" in next(line for line in lines if line.startswith("6: note"))


def test_the_names_for_type_checkers_are_those_of_the_interface() -> None:
    """What `TYPE_CHECKING` imports, and what is found at run time, are two lists: they must not part."""
    text = Path(mf.__file__).read_text()
    block = text.split("if TYPE_CHECKING:\n")[1].split("__all__")[0]
    words = block.replace("(", " ").replace(")", " ").replace(",", " ").split()
    homes = {"from", "import", "__version__:", "str"}
    names = [word for word in words if word not in homes and not word.startswith("meshforge.")]
    assert sorted(names) == sorted(mf.__all__)
