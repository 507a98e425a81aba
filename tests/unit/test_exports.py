"""Packages offer names that are imported when they are first used, so that a command imports only what it needs."""

import ast
import compileall
import os
import shutil
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

import meshforge
from meshforge.samples import TABLES
from script.stubs import read_offers

SOURCE = Path(meshforge.__file__).parent
LAZY = sorted(
    ".".join(("meshforge", *file.parent.relative_to(SOURCE).parts))
    for file in SOURCE.rglob("__init__.py")
    if "export_lazily(" in file.read_text("utf-8")
)
TABLE = str(TABLES / "table_03.obj")


def read_tree(name: str) -> ast.Module:
    return ast.parse(SOURCE.joinpath(*name.split(".")[1:], "__init__.py").read_text("utf-8"))


@pytest.mark.parametrize("name", LAZY)
def test_every_name_that_a_package_offers_is_there_and_no_other(name: str) -> None:
    package = import_module(name)
    for offered in package.__all__:
        assert getattr(package, offered) is not None
    with pytest.raises(AttributeError, match=f"module '{name}' has no attribute 'nothing'"):
        package.nothing  # noqa: B018


@pytest.mark.parametrize("name", LAZY)
def test_no_name_is_that_of_a_module_which_would_take_its_place(name: str) -> None:
    folder = SOURCE.joinpath(*name.split(".")[1:])
    modules = {path.stem for path in folder.iterdir() if path.suffix == ".py" or path.is_dir()}
    assert not modules & {one.name for node in read_offers(read_tree(name), name) for one in node.names}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("words", "absent"),
    [
        (["info", TABLE], ("scipy", "rich", "pebble", "lark", "meshforge.batch", "meshforge.project")),
        (["check", TABLE], ("scipy", "rich", "pebble", "coal", "meshforge.project")),
        (["render", TABLE, "--out", "table.png"], ("scipy", "rich", "pebble", "coal", "meshforge.batch")),
        (["fmt", str(TABLES / "tables.mf"), "--check"], ("scipy", "rich", "pebble", "meshforge.formats")),
    ],
    ids=lambda words: words[0],
)
def test_a_command_imports_no_more_than_it_needs(words: list[str], absent: tuple[str, ...], tmp_path: Path) -> None:
    code = (
        f"import sys\nfrom meshforge.cli import main\nsys.argv[1:] = {words}\n"
        f"try:\n    main()\nexcept SystemExit:\n    pass\n"
        f"print('ABSENT', [name for name in {absent} if name in sys.modules])"
    )
    path = os.pathsep.join([str(SOURCE.parent), os.environ.get("PYTHONPATH", "")])
    done = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        check=True,
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": path},
    )
    assert done.stdout.splitlines()[-1] == "ABSENT []"


@pytest.mark.slow
def test_names_are_found_without_any_source(tmp_path: Path) -> None:
    """As in a program that was frozen: compiled modules and data, no `.py`."""
    tree = tmp_path / "meshforge"
    shutil.copytree(SOURCE, tree, ignore=shutil.ignore_patterns("__pycache__", "static", "*.pyi"))
    assert compileall.compile_dir(tree, quiet=1, legacy=True)
    for path in tree.rglob("*.py"):
        path.unlink()
    code = (
        "import meshforge as mf, meshforge.batch as batch\n"
        "from meshforge.cli import main\n"
        "print([getattr(mf, name) is not None for name in mf.__all__].count(False), len(batch.__all__) > 50)\n"
        f"import sys; sys.argv[1:] = ['info', {TABLE!r}]; main()"
    )
    environment = {**os.environ, "PYTHONPATH": str(tmp_path)}
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=tmp_path, env=environment)
    first, second, *_ = done.stdout.splitlines() or [done.stderr]
    assert (first, done.returncode) == ("0 True", 0), done.stderr
    assert "table_03.obj: obj, 36 hulls" in second
