from pathlib import Path

import pytest

from meshforge.common import MeshForgeError
from meshforge.language import Program
from meshforge.project import Project
from tests.unit.batch.families import Corner, obj
from tests.unit.project.tables import labelled

BOX: tuple[Corner, Corner] = ((0, 0, 0), (1, 1, 1))
DATA = obj({"knob": BOX}).encode()
OPEN = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n"


def write_template(project: Project, name: str, data: bytes) -> None:
    path = project.folder / "templates" / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data)


def test_a_template_that_was_copied_there_can_be_named_by_programs(tmp_path: Path) -> None:
    project = labelled(tmp_path)
    assert project.template_names() == ()
    write_template(project, "knob.obj", DATA)
    assert project.template_names() == ("knob.obj",)
    assert len(project.templates(["knob.obj"])["knob.obj"].shapes) == 1
    project.accept(Program.parse('labels top\nIs(top) => Replace("knob.obj")\n'))
    assert project.status(workers=0).problem is None


def test_only_mesh_files_count_as_templates_and_those_in_folders_too(tmp_path: Path) -> None:
    project = labelled(tmp_path)
    for name in ("b.STL", "sub/a.obj", "notes.txt", ".hidden.obj", "c.urdf"):
        write_template(project, name, DATA)
    assert project.template_names() == ("b.STL", "sub/a.obj")


@pytest.mark.parametrize(
    ("data", "problem"),
    [(b"", ": the file is empty"), (b"nothing", ":1: this is no OBJ file"), (OPEN, "is no convex hull")],
)
def test_what_is_no_template_is_refused_where_it_is_named(tmp_path: Path, data: bytes, problem: str) -> None:
    project = labelled(tmp_path)
    write_template(project, "knob.obj", data)
    with pytest.raises(MeshForgeError, match=f"knob.obj.*{problem}"):
        project.templates(["knob.obj"])
