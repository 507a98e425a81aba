"""One file of a family has a name that is not UTF-8: it fails by name, all others go on."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from meshforge.common import AssetError
from meshforge.formats import read
from meshforge.project import Project
from tests.cup_project import BARE, CUP, cup_project, cup_urdf
from tests.loop.command import Done
from tests.unit.cli.in_process import Run

ODD = b"b\xff\xe9.urdf"
ID = r"b\xff\xe9.urdf"

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="no such file names there")


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Project:
    monkeypatch.chdir(tmp_path)
    cup_project(tmp_path)
    with open(os.fsencode(tmp_path / "assets") + b"/" + ODD, "w", encoding="utf-8") as stream:  # noqa: PTH123 (bytes)
        stream.write(cup_urdf(shown=True))
    return Project.open(tmp_path / "project")


def test_its_id_is_text_and_reading_it_names_it(project: Project) -> None:
    assert sorted(project.assets()) == sorted((ID, BARE, CUP))
    with pytest.raises(AssetError, match="this name is not UTF-8") as caught:
        read(project.path(ID))
    assert ID in str(caught.value)


@pytest.mark.parametrize(
    ("words", "code"),
    [
        ("status project", 0),
        ("label project --with names", 1),
        ("label project --with propagate", 1),
        ("label project --with propagate", 1),
        ("label project --with names --json", 1),
        ("check assets", 1),
        ("check assets --json", 1),
        ("apply project --again --report run.html", 1),
        ("apply project --json", 1),
        ("apply project assets --out out", 1),
        ("convert assets out --to .xml", 1),
        ("prepare project --decompose vhacd", 1),
        ("review project", 1),
        ("review project --json", 1),
    ],
)
def test_every_command_names_it_and_goes_on(project: Project, run: Run, words: str, code: int) -> None:
    done = run(*words.split())
    said = done.out + done.err
    assert done.code == code, said
    assert ID in said.replace(r"\\", "\\") or r"b\udcff\udce9.urdf" in said, said
    assert Path(BARE).stem in said and "fault" not in said, said


def test_the_others_are_written(project: Project, run: Run) -> None:
    run("apply", "project", "--again")
    written = {path.name for path in (project.folder / "edited").glob("*.urdf")}
    assert written == {BARE, CUP}
    rows = [json.loads(line) for line in run("apply", "project", "--json").out.splitlines()]
    assert {row["asset"]: row["status"] for row in rows} == {ID: "failed", BARE: "skipped", CUP: "skipped"}


@pytest.mark.slow
def test_named_outright_it_is_no_fault_of_ours(project: Project) -> None:
    odd = b"assets/" + ODD
    for words in (
        [b"info", odd],
        [b"new", b"p", odd],
        [b"convert", odd, b"o.xml"],
        [b"new", b"p\xff", b"assets/cup.urdf"],
    ):
        printed = subprocess.run([sys.executable, "-m", "meshforge", *words], capture_output=True, text=True)
        done = Done(printed.returncode, printed.stdout, printed.stderr)
        assert done.code == 2 and "not UTF-8" in done.err and "fault" not in done.err, done
