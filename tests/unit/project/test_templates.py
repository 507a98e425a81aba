from __future__ import annotations

from pathlib import Path

import pytest

from meshforge.common import ProjectError
from meshforge.language import Program
from tests.unit.batch.families import Corner, obj, tree
from tests.unit.project.tables import labelled

BOX: tuple[Corner, Corner] = ((0, 0, 0), (1, 1, 1))
DATA = obj({"knob": BOX}).encode()
OPEN = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n"


def test_a_template_that_was_taken_can_be_named_by_programs(tmp_path: Path) -> None:
    project = labelled(tmp_path)
    assert project.template_names() == ()
    project.add_template("knob.obj", DATA)
    assert (project.folder / "templates/knob.obj").read_bytes() == DATA
    assert project.template_names() == ("knob.obj",)
    assert len(project.templates(["knob.obj"])["knob.obj"].shapes) == 1
    project.accept(Program.parse('labels top\nIs(top) => Replace("knob.obj")\n'))
    assert project.status(workers=0).problem is None


def test_only_mesh_files_count_as_templates_and_those_in_folders_too(tmp_path: Path) -> None:
    project = labelled(tmp_path)
    for name in ("b.STL", "sub/a.obj", "notes.txt", ".hidden.obj", "c.urdf"):
        path = project.folder / "templates" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(DATA)
    assert project.template_names() == ("b.STL", "sub/a.obj")


@pytest.mark.parametrize(
    "name",
    ["../a.obj", "a/b.obj", "a\\b.obj", "/a.obj", "a.txt", "a", "", ".obj", ".a.obj", "a\n.obj", f"{'a' * 300}.obj"],
)
def test_a_name_that_is_none_is_refused(tmp_path: Path, name: str) -> None:
    project = labelled(tmp_path)
    before = tree(tmp_path)
    with pytest.raises(ProjectError, match="is no name for a template"):
        project.add_template(name, DATA)
    assert tree(tmp_path) == before


@pytest.mark.parametrize(
    ("data", "problem"),
    [(b"", ": the file is empty"), (b"nothing", ":1: this is no OBJ file"), (OPEN, "is no convex hull")],
)
def test_what_is_no_template_is_refused_and_the_old_one_stays(tmp_path: Path, data: bytes, problem: str) -> None:
    project = labelled(tmp_path)
    project.add_template("knob.obj", DATA)
    with pytest.raises(ProjectError, match=f"^knob.obj.*{problem}"):
        project.add_template("knob.obj", data)
    assert (project.folder / "templates/knob.obj").read_bytes() == DATA


def test_a_name_that_would_be_taken_from_beside_the_program_is_refused(tmp_path: Path) -> None:
    project = labelled(tmp_path)
    (project.folder / "knob.obj").write_bytes(DATA)
    with pytest.raises(ProjectError, match="beside the program"):
        project.add_template("knob.obj", DATA)
