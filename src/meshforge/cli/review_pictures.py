"""Pictures of a question of a review: the hulls in question in colour, in `.meshforge/review` of the project."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path

from meshforge.common import MeshForgeError
from meshforge.project import Project, ProjectReview, run_with_corrections
from meshforge.rendering import render, write_png
from meshforge.signoff import ReviewQuestion
from meshforge.symbolic import SymbolicMesh

_SIZE = (640, 480)
_MOST = 6  # assets of a group that are drawn


def draw_question(project: Project, found: ProjectReview, question: ReviewQuestion) -> list[Path]:
    """Draw what a question is about; those of the question before are taken away. None where it cannot be drawn."""
    folder = project.layout.review_pictures
    shutil.rmtree(folder, ignore_errors=True)
    try:
        return [_write(folder, *one) for one in _pictures(project, found, question)]
    except MeshForgeError:
        return []


Picture = tuple[str, SymbolicMesh, frozenset[str], str]
"""The name of a file, the mesh, the hulls in colour, and the title."""


def _pictures(project: Project, found: ProjectReview, question: ReviewQuestion) -> Iterator[Picture]:
    meshes, program = found.state.meshes, project.program()
    if question.hulls:
        by_asset: dict[str, set[str]] = {}
        for place in question.hulls:
            by_asset.setdefault(place.asset, set()).add(place.hull)
        for number, (asset, hulls) in enumerate([*by_asset.items()][:_MOST], 1):
            yield f"{number}", meshes[asset], frozenset(hulls), asset
    elif question.rule is not None and program:
        mesh = project.mesh_before_rule(question.asset, question.rule, program, meshes)
        for number, choice in enumerate(question.choices, 1):
            yield f"choice-{number}", mesh, frozenset(choice.select or ()), f"{number} on {question.asset}"
    elif question.kind == "result" and program:
        yield "before", meshes[question.asset], frozenset(), f"{question.asset} before"
        after = run_with_corrections(project, question.asset, meshes[question.asset], program).mesh
        yield "after", after, frozenset(), f"{question.asset} after"
    elif question.asset in meshes:
        yield "asset", meshes[question.asset], frozenset(), question.asset


def _write(folder: Path, name: str, mesh: SymbolicMesh, hulls: frozenset[str], title: str) -> Path:
    path, here = folder / f"{name}.png", Path.cwd()
    write_png(path, render(mesh, highlight=hulls or None, size=_SIZE, title=title))
    return path.relative_to(here) if path.is_relative_to(here) else path
