"""Standing an asset up in a format whose files have another axis for up."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from meshforge.asset import Asset, Body, Opaque, Surface
from meshforge.formats.base import Format
from meshforge.formats.visuals import VisualSurfaces
from meshforge.geometry import Pose

_Z_FROM_Y = Pose([[1, 0, 0], [0, 0, -1], [0, 1, 0]], [0, 0, 0])


def stood_up(asset: Asset, source: Format | None, target: Format) -> tuple[Asset, tuple[str, ...]]:
    """The asset as it stands upright in the target format, and what is to be said about that.

    A format that does not say what is up takes coordinates as they are.
    """
    up, wanted = asset.up or (source.up if source else None), target.up
    if source is None or up == wanted:
        return asset, ()
    if up is None:
        return asset, (f"coordinates are as they were: {target.title} is {wanted}-up, {source.title} does not say",)
    if wanted is None:
        return asset, (f"coordinates are as they were, {up}-up: {target.title} does not say what is up",)
    turn = _Z_FROM_Y if up == "y" else _Z_FROM_Y.inverse()
    said = f"the asset is turned about X to stand upright: {source.title} is {up}-up, {target.title} {wanted}-up"
    return turned(asset, turn), (said,)


def turned(asset: Asset, turn: Pose) -> Asset:
    """The asset in another root frame, new_T_old; frames of bodies are turned along, so that a root stays one."""
    back = turn.inverse()
    return replace(
        asset,
        bodies=tuple(Body(body.name, turn @ body.pose @ back) for body in asset.bodies),
        geoms=tuple(replace(geom, shape=geom.shape.move(turn)) for geom in asset.geoms),
        opaque=tuple(_opaque(piece, turn) for piece in asset.opaque),
        visuals=_visuals(asset.visuals, turn),
        mechanism=asset.mechanism.move(turn),
    )


def _opaque(piece: Opaque, turn: Pose) -> Opaque:
    surface = _surface(piece.surface, turn) if piece.surface else None
    return replace(piece, surface=surface, plane=turn @ piece.plane if piece.plane else None)


def _visuals(visuals: Sequence[Surface], turn: Pose) -> Sequence[Surface]:
    if isinstance(visuals, VisualSurfaces):
        return VisualSurfaces(tuple(visual.move(turn) for visual in visuals.visuals))
    return tuple(_surface(surface, turn) for surface in visuals)


def _surface(surface: Surface, turn: Pose) -> Surface:
    return replace(surface, vertices=turn.apply(surface.vertices))
