"""The package of docs/plugins.md, installed as one of its own: every command of the page, and what it adds in use."""

import json
import os
import shlex
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.loop import command
from tests.loop.command import Done
from tests.loop.command import meshforge_here as meshforge
from tests.plugin_packages import build_example, page_commands, page_files, unpack
from tests.unit.batch.families import obj, table_boxes, write_table
from tests.unit.plugins.test_failures import forget_plugins


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A folder with `table.obj`, its labels, and the programs of the page, where the example is installed."""
    site = unpack(build_example(tmp_path / "wheels"), tmp_path / "site")
    monkeypatch.syspath_prepend(site)
    put_on_path(site, monkeypatch)
    forget_plugins()
    work = tmp_path / "work"
    write_table(work / "table.obj")
    (work / "contract.mf").write_text(page_files()["contract.mf"].replace("top, leg", "top, leg, misc"))
    (work / "smaller.mf").write_text(page_files()["smaller.mf"])
    yield work
    monkeypatch.undo()
    forget_plugins()


def put_on_path(site: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    known = os.environ.get("PYTHONPATH", "").split(os.pathsep)
    source = Path(__file__).parents[3] / "src"
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(site), str(source), *filter(None, known)]))


@pytest.mark.slow
def test_every_command_of_the_page_runs(folder: Path) -> None:
    done = {words: run_line(words, folder) for words in page_commands()}
    info = json.loads(meshforge("info", "table.hulls", "--json", cwd=folder).out)
    assert (info["format"], len(info["hulls"])) == ("hull list", 6)
    edited = json.loads((folder / "edited" / "table.hulls").read_text())["hulls"]
    before = json.loads((folder / "table.hulls").read_text())["hulls"]
    assert set(edited) == {
        "top",
        "crumb",
        *(f"{side}_{part}" for side in ("left", "right") for part in ("low", "high")),
    }
    assert edited["top"] == before["top"]
    assert "crumb" not in (folder / "tidy" / "table.obj").read_text()
    labelled = json.loads((folder / "tables" / "labels" / "table.obj.json").read_text())["hulls"]
    assert (labelled["top"]["label"], labelled["top"]["source"], labelled["top"]["confidence"]) == (
        "top",
        "plugin",
        0.8,
    )
    assert "body has 6 hulls, more than 4" in (folder / "page.html").read_text()
    assert "body has 6 hulls, more than 4" in done["meshforge check table.obj --check few-hulls"].out


def run_line(words: str, folder: Path) -> Done:
    """A command of the page; tables have more than four hulls, which its check finds."""
    code = 1 if words.startswith("meshforge check ") else 0
    return meshforge(*shlex.split(words)[1:], cwd=folder, code=code)


@pytest.mark.slow
def test_a_plug_ins_action_is_demonstrated_learned_and_run_in_workers(folder: Path) -> None:
    write_table(folder / "two" / "table.obj", 1.5)
    meshforge("new", "home", "table.obj", "two/table.obj", cwd=folder)
    meshforge("label", "home", "--vocabulary", "top,leg,misc", cwd=folder)
    legs = "left_low,left_high,right_low,right_high"
    meshforge("demonstrate", "home", "table.obj", f"{legs} => Contract(0.5)", cwd=folder)
    learned = meshforge("synthesize", "home", cwd=folder)
    assert "Is(leg) => Contract(0.5)" in (folder / "home" / "program.mf").read_text(), learned
    rows = meshforge("apply", "home", "--workers", "2", "--json", cwd=folder).lines
    assert [row["status"] for row in rows] == ["edited", "edited"]
    assert all(len(row["rules"][0]["made"]) == 4 for row in rows)


@pytest.mark.slow
def test_a_plug_ins_extractor_is_learned_where_asked_for_reviewed_and_run_in_workers(folder: Path) -> None:
    boxes = table_boxes()
    for name, place in (("table", 5.0), ("two", -5.0)):
        moved = {**boxes, "crumb": ((place,) * 3, (place + 0.1,) * 3)}
        (folder / f"{name}.obj").write_text(obj(moved))
        labels = {hull: "top" if hull == "top" else "leg" for hull in boxes}
        (folder / f"{name}.labels.json").write_text(json.dumps({"hulls": labels}))
    meshforge("new", "home", "table.obj", "two.obj", cwd=folder)
    meshforge("label", "home", "--vocabulary", "top,leg", cwd=folder)
    for name in ("table", "two"):
        meshforge("demonstrate", "home", f"{name}.obj", "crumb => Delete", cwd=folder)
    program = folder / "home" / "program.mf"
    meshforge("synthesize", "home", cwd=folder)
    assert "Smaller" not in program.read_text()
    tried = meshforge("synthesize", "home", "--with", "Smaller", "--dry-run", cwd=folder)
    assert "Smaller(Is(leg), 0.01) => Delete" in tried.out
    assert "Smaller" not in program.read_text()
    meshforge("synthesize", "home", "--with", "Smaller", cwd=folder)
    assert "Smaller(Is(leg), 0.01) => Delete" in program.read_text()
    meshforge("review", "home", "--json", cwd=folder)
    assert "Smaller(Is(leg), 0.01) => Delete" in program.read_text()
    rows = meshforge("apply", "home", "--workers", "2", "--json", cwd=folder).lines
    assert [(row["status"], row["rules"][0]["selected"]) for row in rows] == [("edited", ["crumb"])] * 2


@pytest.mark.slow
def test_pip_installs_the_package_and_the_list_names_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    wheel, site = build_example(tmp_path / "wheels"), tmp_path / "site"
    words = ["install", "--quiet", "--no-deps", "--no-index", "--disable-pip-version-check", "--target", site, wheel]
    subprocess.run([sys.executable, "-m", "pip", *map(str, words)], check=True, cwd=tmp_path)
    put_on_path(site, monkeypatch)
    rows = command.meshforge("plugins", "--json", cwd=tmp_path).json
    assert [(row["kind"], row["name"]) for row in rows] == [
        ("formats", "hulls"),
        ("extractors", "Smaller"),
        ("actions", "Contract"),
        ("labelers", "flat"),
        ("checks", "few-hulls"),
        ("goals", "low"),
    ]
    assert all((r["package"], r["version"], r["loads"]) == ("meshforge-example", "1.0", True) for r in rows)
