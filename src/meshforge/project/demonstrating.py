"""demonstrations/ID.json: the steps that a person did on an asset."""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from meshforge.errors import ProjectError, nearest
from meshforge.project.json_files import read_json, write_json
from meshforge.project.steps import DemonstrationFile, step_lines, steps_of
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Demonstration, Step

if TYPE_CHECKING:
    from meshforge.project.project import Project


def demonstrations(project: Project) -> dict[str, Demonstration]:
    """All demonstrations, by asset."""
    ids = [asset for asset in project.assets() if project.layout.demonstration(asset).exists()]
    return {asset: Demonstration(project.mesh(asset), project.steps(asset), asset) for asset in ids}


def steps(path: Path) -> tuple[Step, ...]:
    """The steps in a demonstrations file, none where there is no such file."""
    kept = read_json(path, DemonstrationFile)
    return steps_of(kept.steps, path) if kept else ()


def demonstrate(project: Project, asset: str, done: tuple[Step, ...]) -> None:
    """Keep the steps on an asset; no steps take the file away.

    Raises DemonstrationError for steps that are not numbered in order, ProjectError for a hull that cannot be there.
    """
    path = project.layout.demonstration(asset)
    mesh = project.mesh(asset)
    _check(asset, mesh, Demonstration(mesh, done, asset).steps)
    with project.lock():
        if not done:
            path.unlink(missing_ok=True)
            return
        kept = read_json(path, DemonstrationFile)
        lines = step_lines(done)
        fresh = DemonstrationFile(asset=asset, steps=lines)
        write_json(path, kept.model_copy(update={"asset": asset, "steps": lines}) if kept else fresh)


def _check(asset: str, mesh: SymbolicMesh, done: tuple[Step, ...]) -> None:
    """Every name is a hull of the mesh, or, after the first step, one that an edit of such a hull can have made."""
    for rule, name in astray(done, mesh.index):
        like = nearest(name, mesh.index)
        raise ProjectError(
            f"rule {rule}: there is no hull {name!r}", where=asset, remedy=f"Did you mean {like!r}?" if like else None
        )


def astray(done: Iterable[Step], hulls: Container[str]) -> Iterator[tuple[int, str]]:
    """The rules and names of steps that cannot be meant: no such hull, and none that an edit could have made it of."""
    for step in done:
        for name in sorted(step.select or ()):
            stem = name.rpartition("~")[0] if step.rule > 1 else name
            if name not in hulls and stem not in hulls:
                yield step.rule, name
