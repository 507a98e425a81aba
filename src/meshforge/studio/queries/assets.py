"""One asset as the page shows it: its hulls and steps, how it is turned upright, and pictures of it."""

import json
from collections.abc import Collection, Iterable
from contextlib import suppress
from itertools import islice

import numpy as np

from meshforge import rendering
from meshforge.batch import software_version, text_digest
from meshforge.common import MeshForgeError
from meshforge.formats import VisualSurfaces, format_named
from meshforge.geometry import Floats, Pose
from meshforge.language import Orient, Program, Replay, RuleTrace, orient_mesh
from meshforge.project import Project
from meshforge.studio.actions import view_action
from meshforge.studio.edits.base import steps_version
from meshforge.studio.queries.packets import contact_names, frame_packet, hull_views
from meshforge.studio.queries.programs import replay_steps
from meshforge.studio.wire.asset import AssetView, ManualEditView, NearMiss, NonConvexView, StepView
from meshforge.symbolic import Asset, Label, SymbolicMesh
from meshforge.synthesis import Step

Z_FROM_Y = Pose(np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]), np.zeros(3))
"""Turns the Y axis to Z."""

THUMBNAIL_SIZE = (240, 180)

RULE_PICTURE_SIZE = (720, 540)

_LOOKED_AT = 3  # assets, to see what is up
_LEVEL = 0.01  # how far the lowest point is off the ground, as a share of the height

_DRAW_VERSION = "1"
"""To be raised when thumbnails are drawn in another way."""


def build_asset_view(project: Project, asset: str, mesh: SymbolicMesh) -> AssetView:
    """Return an asset as it is prepared; mesh: its mesh. Contacts are those in the canonical frame."""
    source = mesh.asset
    if source is None:
        raise MeshForgeError("this mesh was made in memory and has no file")
    replay, problem = _try_replay(project, asset, mesh)
    seen = replay.start if replay else mesh
    pose, unturned = compute_upright(project, mesh)
    return AssetView(
        asset=asset,
        bodies=tuple(body.name for body in source.bodies),
        hulls=hull_views(mesh),
        non_convex=tuple(map(NonConvexView.model_validate, source.non_convex)),
        has_visual=_has_visual(source),
        contacts=contact_names(seen),
        near_misses=tuple(
            NearMiss(a=seen.hulls[i].name, b=seen.hulls[j].name, gap=gap) for i, j, gap in seen.near_misses
        ),
        upright=to_numbers(pose),
        y_up=is_y_up(mesh, None if unturned else project.orientation),
        unturned=unturned,
        steps=_step_views(project.steps(asset), replay.trace if replay else (), unturned or problem),
        version=steps_version(project, asset),
        manual_edits=tuple(
            ManualEditView(select=tuple(name for name, _ in c.hulls), action=view_action(c.action, c.label))
            for c in project.manual_edits(asset)
        ),
        prepared=tuple(map(str, project.preparation(asset).steps)),
    )


def _try_replay(project: Project, asset: str, mesh: SymbolicMesh) -> tuple[Replay | None, str | None]:
    """The asset after its own steps; or why it cannot be turned."""
    try:
        return replay_steps(project, asset, mesh), None
    except MeshForgeError as error:
        return None, error.sentence


def _has_visual(source: Asset) -> bool:
    visuals = source.visuals
    return bool(visuals.visuals if isinstance(visuals, VisualSurfaces) else visuals)


def _step_views(steps: tuple[Step, ...], results: tuple[RuleTrace, ...], problem: str | None) -> tuple[StepView, ...]:
    done = results or tuple(RuleTrace(step.rule, error=problem) for step in steps)
    return tuple(
        StepView(
            select=None if step.select is None else tuple(sorted(step.select)),
            action=view_action(step.action, step.label),
            error=result.error,
            made=result.made,
            removed=result.removed,
        )
        for step, result in zip(steps, done, strict=True)
    )


def compute_upright(project: Project, mesh: SymbolicMesh, orient: Orient | None = None) -> tuple[Pose, str | None]:
    """Return shown_T_incoming of an asset of a project: turned by an orientation, by default that of the project, then
    so that Z points up; and why the orientation does not turn it, None where it does.

    Z is up already where the orientation names it; otherwise the file or the project says which axis is up.
    """
    orient = orient or project.orientation
    try:
        pose, problem = orient_mesh(mesh, orient)[1], None
    except MeshForgeError as error:
        pose, problem, orient = Pose.identity(), error.sentence, None
    return (Z_FROM_Y @ pose if is_y_up(mesh, orient) else pose), problem


def is_y_up(mesh: SymbolicMesh, orient: Orient | None) -> bool:
    """Return whether Y still points up after an orientation: file or project say so, and no landmark says what Z is."""
    return not (orient and orient.names_z) and rendering.up_axis(mesh) == "Y"


def find_unclear_up(project: Project, assets: Iterable[str]) -> str | None:
    """Return the first asset of which neither its format nor the project says what points up; of some, as others of a
    family lie alike. None where each stands on the plane z = 0, and not on y = 0."""
    settings = project.settings
    if settings.up or settings.orient:
        return None
    for asset in islice(assets, _LOOKED_AT):
        with suppress(MeshForgeError):
            mesh = project.mesh(asset)
            known = format_named(mesh.asset.format) if mesh.asset else None
            if known and known.up is None and mesh.aabb:
                on_y, on_z = np.abs(mesh.aabb.min[1:]) < _LEVEL * mesh.aabb.size[1:]
                if on_y or not on_z:
                    return asset
    return None


def to_numbers(pose: Pose) -> tuple[float, ...] | None:
    """Return the 16 numbers of a pose row by row, None for the identity."""
    matrix: Floats = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = pose.rotation, pose.translation
    return None if np.array_equal(matrix, np.eye(4)) else tuple(matrix.ravel().tolist())


def draw_thumbnail(mesh: SymbolicMesh, pose: Pose | None = None, size: tuple[int, int] = THUMBNAIL_SIZE) -> bytes:
    """Return a picture of a mesh, encoded as `rendering.render_thumbnail` describes, as a PNG file.

    pose: shown_T_incoming of `compute_upright`; for an output, that of the asset as it comes.
    """
    return _to_png(rendering.render_thumbnail(mesh, pose, size))


def _to_png(pixels: rendering.ThumbnailPixels) -> bytes:
    from PIL import Image  # lazy: 0.1 s, only drawing needs it

    return rendering.encode_png(Image.fromarray(pixels, "RGBA"))


def draw_rule_picture(
    project: Project, asset: str, mesh: SymbolicMesh, rule: int, program: Program | None, show: Collection[str] = ()
) -> bytes:
    """Return a packet of an asset before a rule: the names of the hulls in order, and a picture encoded as a thumbnail.

    mesh: the asset as it comes; program: None for one without rules, which only turns the asset. show: names of hulls
    that are to be seen in it, from whichever side that is, or through others.
    Raises MeshForgeError where the asset cannot be turned, or an action fails.
    """
    plan = program or Program(orient=project.orientation)
    seen = project.mesh_before_rule(asset, rule, plan, {asset: mesh})
    pose = Z_FROM_Y if is_y_up(mesh, plan.orient) else None
    header = json.dumps({"names": [hull.name for hull in seen.hulls]})
    return frame_packet(header.encode(), _to_png(rendering.render_revealing(seen, show, pose, RULE_PICTURE_SIZE)))


def picture_digest(geometry: str, labels: Iterable[Label | None], orient: str, up: str = "") -> str:
    """Return a digest of all that decides how an asset is drawn: its hulls, and labels that turn it.

    geometry: the digest in AssetStatus; labels: of its hulls in order; orient, up: those of the settings.
    """
    landmarks = [label.name if label and label.name in orient else "" for label in labels]
    return text_digest("\n".join([_DRAW_VERSION, software_version(), geometry, orient, up.strip("Z"), *landmarks]))


def output_picture_digest(picture: str, output: str) -> str:
    """Return a digest of all that decides how an output is drawn. picture: of the asset; output: that of its files."""
    return text_digest(f"{picture} {output}")
