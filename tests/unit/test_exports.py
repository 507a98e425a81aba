"""Packages offer names that are imported when they are first used, so that a command imports only what it needs."""

from __future__ import annotations

import os
import subprocess
import sys
from importlib import import_module
from pathlib import Path
from zipfile import ZipFile

import pytest

import meshforge
from meshforge.common.exports import find_homes
from meshforge.samples import TABLES

SOURCE = Path(meshforge.__file__).parent
LAZY = sorted(
    ".".join(("meshforge", *file.parent.relative_to(SOURCE).parts))
    for file in SOURCE.rglob("__init__.py")
    if "export_lazily(" in file.read_text("utf-8")
)
TABLE = str(TABLES / "table_03.obj")


@pytest.mark.parametrize("name", LAZY)
def test_every_name_that_a_package_offers_is_there_and_no_other(name: str) -> None:
    package = import_module(name)
    for offered in package.__all__:
        assert getattr(package, offered) is not None
    assert set(find_homes(name)) <= set(package.__all__)
    with pytest.raises(AttributeError, match=f"module '{name}' has no attribute 'nothing'"):
        package.nothing  # noqa: B018


@pytest.mark.parametrize("name", LAZY)
def test_no_name_is_that_of_a_module_which_would_take_its_place(name: str) -> None:
    folder = SOURCE.joinpath(*name.split(".")[1:])
    modules = {path.stem for path in folder.iterdir() if path.suffix == ".py" or path.is_dir()}
    import_module(name)
    assert not modules & set(find_homes(name))


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


def test_names_are_found_in_a_zip_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    block = "if TYPE_CHECKING:\n    from zipped_package.home import (\n        answer,\n    )\nelse:\n"
    imports = "from typing import TYPE_CHECKING\n\nfrom meshforge.common.exports import export_lazily\n\n"
    with ZipFile(tmp_path / "package.zip", "w") as file:
        file.writestr("zipped_package/__init__.py", f"{imports}{block}    __getattr__ = export_lazily(__name__)\n")
        file.writestr("zipped_package/home.py", "answer = 42\n")
    monkeypatch.syspath_prepend(str(tmp_path / "package.zip"))
    assert import_module("zipped_package").answer == 42
