"""Pictures of a question of a review, in `.meshforge/review` of the project: the hulls in question in colour, what each
choice selects, or the asset before and after."""

from __future__ import annotations

import shutil
from collections.abc import Iterator, Mapping
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from meshforge.cli.console import progress
from meshforge.common import MeshForgeError
from meshforge.language import Orient, Program, to_canonical_frame
from meshforge.project import Project, ProjectReview, run_with_manual_edits
from meshforge.rendering import Up, draw_before_after, make_contact_sheet, render, write_png
from meshforge.signoff import HullPlace, ReviewQuestion
from meshforge.signoff.question import RIGHT
from meshforge.symbolic import SymbolicMesh

if TYPE_CHECKING:
    from PIL.Image import Image

_SIZE, _SMALL_SIZE = (720, 560), (480, 374)


def draw_question(project: Project, found: ProjectReview, question: ReviewQuestion) -> list[Path]:
    """Draw what a question is about: one picture of each choice, or one of all; those of the question before are taken
    away. Return their paths, as one types them here; none where it cannot be drawn."""
    folder = project.layout.review_pictures
    shutil.rmtree(folder, ignore_errors=True)
    with progress(None, "drawing"), suppress(MeshForgeError):
        return [_write(folder / f"{name}.png", picture) for name, picture in _draw(project, found, question)]
    return []


def _write(path: Path, picture: Image) -> Path:
    here = Path.cwd()
    write_png(path, picture)
    return path.relative_to(here) if path.is_relative_to(here) else path


def _draw(project: Project, found: ProjectReview, question: ReviewQuestion) -> Iterator[tuple[str, Image]]:
    name, asset, meshes = question.id, question.asset, found.state.meshes
    program, words = found.outcome.program if found.outcome else None, project.vocabulary
    if question.hulls:
        yield name, _draw_sheet(meshes, question.hulls)
    elif asset not in meshes:
        return
    elif question.kind in ("candidate", "label") and program and question.rule:
        mesh, up = project.mesh_before_rule(asset, question.rule, program, meshes), _up(project.orientation)
        for number, choice in enumerate(question.choices, 1):
            chosen, title = frozenset(choice.select or ()), f"choice {number}"
            yield f"{name}-choice-{number}", render(mesh, highlight=chosen, size=_SIZE, title=title, up=up)
    elif question.kind == "result" and program and question.choice(RIGHT):
        yield name, _draw_result(project, asset, meshes[asset], program)
    elif question.kind == "orientation":
        for choice in question.choices:
            orient = choice.orient or found.state.frame.orient
            mesh, up = to_canonical_frame(meshes[asset], orient, project.settings.thresholds.contact)[0], _up(orient)
            picture = render(mesh, color_by="label", size=_SIZE, title=choice.text, vocabulary=words, up=up)
            yield f"{name}-{choice.id}", picture
    else:
        yield name, render(meshes[asset], color_by="label", size=_SIZE, title=asset, vocabulary=words)


def _draw_sheet(meshes: Mapping[str, SymbolicMesh], hulls: tuple[HullPlace, ...]) -> Image:
    """Hulls of several assets, each asset as it lies, on one sheet."""
    chosen = {place.asset: frozenset(one.hull for one in hulls if one.asset == place.asset) for place in hulls}
    return make_contact_sheet(
        [render(meshes[asset], highlight=names, size=_SMALL_SIZE, title=asset) for asset, names in chosen.items()]
    )


def _draw_result(project: Project, asset: str, mesh: SymbolicMesh, program: Program) -> Image:
    before, pose = to_canonical_frame(mesh, program.orient, program.contact)
    after = run_with_manual_edits(project, asset, mesh, program).mesh
    turned = after.with_hulls(hull.move(pose) for hull in after.hulls)
    up = _up(program.orient)
    return draw_before_after(before, turned, size=_SMALL_SIZE, vocabulary=project.vocabulary, up=up)


def _up(orient: Orient | None) -> Up | None:
    """Z where the orientation names it; otherwise the file says which axis is up."""
    return "Z" if orient and orient.names_z else None
