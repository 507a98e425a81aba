"""program.mf, the record of what it was learned from, and the templates that it names."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory

from meshforge.batch import read_template
from meshforge.common import MeshForgeError, ProjectError, join_names, relative_name, write_atomically
from meshforge.formats import MESH_SUFFIXES
from meshforge.language import Program
from meshforge.store.layout import JsonFile, Layout


def list_templates(layout: Layout) -> tuple[str, ...]:
    """The names of templates as actions write them, sorted."""
    _, folder = layout.templates
    paths = (path for path in folder.rglob("*") if path.is_file() and not path.name.startswith("."))
    return tuple(sorted(relative_name(path, folder) for path in paths if path.suffix.lower() in MESH_SUFFIXES))


def check_template(layout: Layout, name: str, data: bytes) -> None:
    """Raises ProjectError where the contents of a file cannot be a template: no plain name, or no convex hulls."""
    beside, _ = layout.templates
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


def _check_name(name: str) -> None:
    plain = name.isprintable() and not set(name) & set('/\\:*?"<>|') and not name.startswith(".")
    if not plain or Path(name).suffix.lower() not in MESH_SUFFIXES or len(name.encode()) > 200:
        remedy = f"It ends in {join_names(MESH_SUFFIXES)} and has no folders in it."
        raise ProjectError(f"{name!r} is no name for a template", remedy=remedy)


class ProgramRecord(JsonFile):
    """What a program was learned from, and the outcome of learning; question: the id of the one that stayed open."""

    program: str
    lesson: str
    status: str = "found"
    question: str | None = None


def write_program(path: Path, program: Program) -> None:
    """Write a program; the one that it replaces stays as `program.previous.mf`."""
    text = str(program)
    old = path.read_text(encoding="utf-8") if path.exists() else text
    if old != text:
        write_atomically(path.with_name("program.previous.mf"), old)
    write_atomically(path, text)
