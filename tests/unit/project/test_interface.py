"""The Python interface: quick to import, complete, and it runs as its page says. The Python interface as a type checker
sees it: names that are not there are errors. The page on Python: its examples run, in the order of the page and in one
folder, and it names what there is."""

from __future__ import annotations

import re
import subprocess
import sys
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, assert_type

import pytest

import meshforge as mf
from meshforge.checks import Examination
from meshforge.language import Diff
from meshforge.samples import TABLES
from meshforge.symbolic import SymbolicMesh
from tests.unit.batch.families import write_urdf_table

HEAVY = (
    "numpy",
    "scipy",
    "trimesh",
    "coal",
    "manifold3d",
    "jinja2",
    "lxml",
    "lark",
    "pydantic",
    "pebble",
    "mujoco",
    "PIL",
    "rich",
)


def test_importing_it_loads_nothing_heavy() -> None:
    code = f"import sys, meshforge; print([name for name in {HEAVY} if name in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_loading_an_asset_imports_no_reader_of_another_format_and_no_writer(tmp_path: Path) -> None:
    path = write_urdf_table(tmp_path)
    code = (
        "import sys, meshforge as mf; mf.load(sys.argv[1]);"
        "own = [name.removeprefix('meshforge.formats.') for name in sys.modules];"
        "print([name for name in own if name.split('.')[-1] in ('read', 'edit', 'create')],"
        f"[name for name in {HEAVY[1:]} if name in sys.modules and name not in ('coal', 'manifold3d')])"
    )
    done = subprocess.run([sys.executable, "-c", code, str(path)], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "['urdf.read'] []"


def test_the_whole_loop_in_python(tmp_path: Path) -> None:
    path = write_urdf_table(tmp_path / "assets" / "one")
    write_urdf_table(tmp_path / "assets" / "two")

    table = mf.load(path, labels=path.with_suffix(".labels.json"))
    family = list(mf.load_many(str(tmp_path / "assets/**/*.urdf")))
    assert len(family) == 2
    hull = table.hulls[0]
    assert (hull.name, hull.label, hull.body) == ("body/top", "top", "body")
    assert hull.vertices.shape == (8, 3) and hull.faces.shape == (12, 3)
    assert hull.aabb.size.tolist() == pytest.approx([2, 1, 0.1])
    assert hull.volume == pytest.approx(0.2) and hull.primitive is not None
    assert table.contacts == {(0, 1), (0, 2)} and table.neighbours(0) == {1, 2}

    text = "labels top, leg, misc\n\nIs(misc) => Delete\n"
    program = mf.Program.parse(text)
    assert str(program) == text
    assert program.rules[0].extractor.select(table) == {3}
    result = program.run(table, templates={})
    assert [(t.rule, t.selected, t.made) for t in result.trace] == [(1, ("body/crumb",), ())]
    mf.save(result.mesh, tmp_path / "out/table.urdf")
    assert [h.name for h in mf.load(tmp_path / "out/table.urdf").hulls] == ["body/top", "body/left", "body/right"]

    demos = [mf.Demonstration(table, [mf.Step(rule=1, select={"body/crumb"}, action=mf.Delete())])]
    learned = mf.synthesize(demos, family=family, orient=None, confirm=lambda _: False)
    assert learned.status == "found" and learned.program
    assert str(learned.program.rules[0]) == "Is(misc) => Delete"
    assert (len(learned.candidates), learned.repairs, learned.open_rule) == (1, (), None)


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


PAGE = (Path(__file__).parents[3] / "docs" / "python.md").read_text(encoding="utf-8")


def test_every_example_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("table_01.obj", "table_01.labels.json"):
        (tmp_path / name).write_bytes((TABLES / name).read_bytes())
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"^```python\n(.*?)^```$", PAGE, re.DOTALL | re.MULTILINE)
    assert len(blocks) == 4
    for block in blocks:
        exec(block, {})


def test_every_name_that_the_page_gives_is_one_of_the_interface() -> None:
    assert set(re.findall(r"\bmf\.(\w+)", PAGE)) <= set(mf.__all__)
