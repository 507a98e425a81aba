"""The templates of a project: what is there, and taking in more."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from meshforge.batch import read_template
from meshforge.errors import MeshForgeError, ProjectError
from meshforge.files import relative_name, write_atomically
from meshforge.formats import MESH_SUFFIXES
from meshforge.words import listed

if TYPE_CHECKING:
    from meshforge.project.project import Project


def names(project: Project) -> tuple[str, ...]:
    """The names of templates as actions write them, sorted."""
    _, folder = project.layout.templates
    paths = (path for path in folder.rglob("*") if path.is_file() and not path.name.startswith("."))
    return tuple(sorted(relative_name(path, folder) for path in paths if path.suffix.lower() in MESH_SUFFIXES))


def add(project: Project, name: str, data: bytes) -> None:
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
        remedy = f"It ends in {listed(MESH_SUFFIXES)} and has no folders in it."
        raise ProjectError(f"{name!r} is no name for a template", remedy=remedy)
