"""One asset with its hulls, and what was done to it."""

from __future__ import annotations

from meshforge.asset import Asset
from meshforge.errors import MeshForgeError
from meshforge.formats.visuals import VisualSurfaces
from meshforge.project import Project, action_text
from meshforge.studio.showing.course import Course, Deed
from meshforge.studio.showing.replaying import walk
from meshforge.studio.showing.shapes.hulls import contact_names, hull_views
from meshforge.studio.showing.shapes.upright import numbers, upright
from meshforge.studio.versions import steps_version
from meshforge.studio.wire.asset import AssetView, CorrectionView, NearMiss, OpaqueView, StepView
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Step


def asset_view(project: Project, asset: str, mesh: SymbolicMesh) -> AssetView:
    """An asset as it is prepared; mesh: it. Contacts are those that a program sees, in the canonical frame."""
    source = _source(mesh)
    course, problem = _walked(project, asset, mesh)
    seen = course.start if course else mesh
    shown = upright(project, mesh)
    return AssetView(
        asset=asset,
        path=str(source.path),
        format=source.format,
        up=source.up or "z",
        bodies=tuple(body.name for body in source.bodies),
        hulls=hull_views(mesh),
        opaque=_opaque(source),
        has_visual=_shows_something(source),
        contacts=contact_names(seen),
        near_misses=_near_misses(seen),
        diagonal=seen.diagonal,
        contact_distance=seen.contact_distance,
        upright=numbers(shown.pose),
        unturned=shown.problem,
        steps=_steps(project.steps(asset), course.results if course else (), shown.problem or problem),
        version=steps_version(project, asset),
        corrections=_corrections(project, asset),
        prepared=tuple(map(str, project.preparation(asset).steps)),
        missing=source.missing,
        notes=source.notes,
    )


def _source(mesh: SymbolicMesh) -> Asset:
    if mesh.asset is None:
        raise MeshForgeError("this mesh was made in memory and has no file to tell about")
    return mesh.asset


def _walked(project: Project, asset: str, mesh: SymbolicMesh) -> tuple[Course | None, str | None]:
    """The asset after its own steps; or why it cannot be turned."""
    try:
        return walk(project, asset, mesh), None
    except MeshForgeError as error:
        return None, error.sentence


def _shows_something(source: Asset) -> bool:
    """Whether there is a visual, told without reading its files where that is possible."""
    visuals = source.visuals
    return bool(visuals.visuals if isinstance(visuals, VisualSurfaces) else visuals)


def _opaque(source: Asset) -> tuple[OpaqueView, ...]:
    return tuple(
        OpaqueView(name=o.name, body=o.body, reason=o.reason, surface=o.surface is not None) for o in source.opaque
    )


def _near_misses(mesh: SymbolicMesh) -> tuple[NearMiss, ...]:
    names = [hull.name for hull in mesh.hulls]
    return tuple(NearMiss(a=names[i], b=names[j], gap=gap) for i, j, gap in mesh.near_misses)


def _steps(steps: tuple[Step, ...], deeds: tuple[Deed, ...], problem: str | None) -> tuple[StepView, ...]:
    done = deeds or tuple(Deed(step.rule, error=problem) for step in steps)
    return tuple(
        StepView(
            rule=step.rule,
            select=None if step.select is None else tuple(sorted(step.select)),
            action=action_text(step.action, step.label),
            error=deed.error,
            made=deed.made,
            removed=deed.removed,
        )
        for step, deed in zip(steps, done, strict=True)
    )


def _corrections(project: Project, asset: str) -> tuple[CorrectionView, ...]:
    return tuple(
        CorrectionView(select=tuple(name for name, _ in c.hulls), action=action_text(c.action, c.label))
        for c in project.corrections(asset)
    )
