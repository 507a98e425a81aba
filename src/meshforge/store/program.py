"""program.mf, the record of what it was learned from, and the templates that it names."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from meshforge.batch import read_template
from meshforge.common import MeshForgeError, ProjectError, join_names, relative_name, write_atomically
from meshforge.formats import MESH_SUFFIXES
from meshforge.language import Program
from meshforge.store.layout import JsonFile

if TYPE_CHECKING:
    from meshforge.project import Project


def list_templates(project: Project) -> tuple[str, ...]:
    """The names of templates as actions write them, sorted."""
    _, folder = project.layout.templates
    paths = (path for path in folder.rglob("*") if path.is_file() and not path.name.startswith("."))
    return tuple(sorted(relative_name(path, folder) for path in paths if path.suffix.lower() in MESH_SUFFIXES))


def add_template(project: Project, name: str, data: bytes) -> None:
    """Keep the contents of a file as a template. Raises ProjectError: no plain name, or no convex hulls in it."""
    beside, folder = project.layout.templates
    _check_name(name)
    if (beside / name).exists():
        remedy = "Give the template another name."
        raise ProjectError("a file of that name beside the program would be taken instead", where=name, remedy=remedy)
    with TemporaryDirectory() as draft:
        path = Path(draft) / name
        path.write_bytes(data)
        try:
            read_template(path, name)
        except MeshForgeError as error:
            remedy = "A template is a mesh file whose parts are convex; `meshforge decompose FILE -o OUT` makes one."
            where = (error.where or name).replace(str(path), name)
            raise ProjectError(error.problem, where=where, remedy=remedy) from error
    with project.lock():
        write_atomically(folder / name, data)


def _check_name(name: str) -> None:
    plain = name.isprintable() and not set(name) & set('/\\:*?"<>|') and not name.startswith(".")
    if not plain or Path(name).suffix.lower() not in MESH_SUFFIXES or len(name.encode()) > 200:
        remedy = f"It ends in {join_names(MESH_SUFFIXES)} and has no folders in it."
        raise ProjectError(f"{name!r} is no name for a template", remedy=remedy)


class ProgramRecord(JsonFile):
    """What a program was learned from, and what the lesson came to; question: the id of the one that stayed open."""

    program: str
    lesson: str
    status: str = "found"
    question: str | None = None


def write_program(project: Project, program: Program) -> None:
    """Keep a program as the project's; one that it takes the place of stays as `program.previous.mf`."""
    path, text = project.layout.program, str(program)
    with project.lock():
        old = path.read_text(encoding="utf-8") if path.exists() else text
        if old != text:
            write_atomically(path.with_name("program.previous.mf"), old)
        write_atomically(path, text)
