"""Pictures of a question of a review, in `.meshforge/review` of the project: the hulls in question in colour, what each
choice selects, or the asset before and after."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

from meshforge.cli.console import progress
from meshforge.cli.mesh_pictures import MeshPictures
from meshforge.common import MeshForgeError
from meshforge.project import Project, ProjectReview
from meshforge.signoff import CandidateQuestion, OrientationQuestion, ResultQuestion, ReviewQuestion
from meshforge.signoff.question import RIGHT


def draw_question(project: Project, found: ProjectReview, question: ReviewQuestion) -> list[Path]:
    """Draw what a question is about: one picture of each choice, or one of all; those of the question before are taken
    away. None where it cannot be drawn."""
    pictures = MeshPictures(project, lambda: found.state.meshes, project.layout.review_pictures)
    pictures.clear()
    with progress(None, "drawing"), suppress(MeshForgeError):
        return _draw(pictures, found, question)
    return []


def _draw(pictures: MeshPictures, found: ProjectReview, question: ReviewQuestion) -> list[Path]:
    name, program = question.id, found.outcome.program if found.outcome else None
    if question.hulls:
        return [pictures.draw_sheet(_hulls_by_asset(question), name)]
    if question.asset not in found.state.meshes:
        return []
    if isinstance(question, CandidateQuestion) and program and question.rule:
        mesh = pictures.mesh_before_rule(question.asset, question.rule, program)
        return [
            pictures.draw(mesh, frozenset(choice.select or ()), f"{name}-choice-{number}", f"choice {number}")
            for number, choice in enumerate(question.choices, 1)
        ]
    if isinstance(question, ResultQuestion) and program and question.choice(RIGHT):
        return [pictures.draw_result(question.asset, program, name)]
    if isinstance(question, OrientationQuestion):
        now = found.state.frame.orient
        return [
            pictures.draw_turned(question.asset, choice.orient or now, f"{name}-{choice.id}", choice.text)
            for choice in question.choices
        ]
    return [pictures.draw_labels(question.asset, name)]


def _hulls_by_asset(question: ReviewQuestion) -> dict[str, frozenset[str]]:
    assets = dict.fromkeys(place.asset for place in question.hulls)
    return {asset: frozenset(place.hull for place in question.hulls if place.asset == asset) for asset in assets}
