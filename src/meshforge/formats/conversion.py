"""What happens to an asset on its way into another format: it is turned upright, and a report says what that format
does not hold."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from meshforge.common import AssetError, join_names
from meshforge.formats.base import Format, Loss, Output
from meshforge.formats.looks import LOOK_SUFFIXES
from meshforge.formats.references import find_companions
from meshforge.formats.visuals import Visual, VisualSurfaces
from meshforge.geometry import Pose
from meshforge.symbolic import Asset, Body, Feature, FeatureKind, Opaque, Surface, features_of

_WITH_MATERIALS = (".dae", ".glb", ".gltf", ".mtl")
_WORDING = {
    FeatureKind.OTHERS: "{title} has no place for them",
    FeatureKind.SETTINGS: "{title} has no place for them",
    FeatureKind.VISUALS: "{title} does not tell visuals from hulls",
    FeatureKind.FIXED_JOINTS: "{title} has no named fixed joints",
}

_Z_FROM_Y = Pose([[1, 0, 0], [0, 0, -1], [0, 1, 0]], [0, 0, 0])


@dataclass(frozen=True, slots=True)
class ConversionReport:
    """What the output of another format holds besides the hulls, what it does not, and what else is to be known."""

    held: tuple[Feature, ...] = ()
    lost: tuple[Loss, ...] = ()
    remarks: tuple[str, ...] = ()

    @property
    def sentences(self) -> tuple[str, ...]:
        return (*self.remarks, *map(str, self.lost))

    def refuse_lost_collision(self, where: str, remedy: str) -> None:
        """Raise AssetError where non-convex pieces, which collided, do not any more."""
        if lost := [loss for loss in self.lost if loss.kind is FeatureKind.OPAQUE]:
            names = join_names([name for loss in lost for name in loss.names], 3)
            raise AssetError(f"{names} would collide no more: {lost[0].why}", where=where, remedy=remedy)


def report_conversion(
    asset: Asset, source: Format | None, target: Format, output: Output, remarks: Iterable[str] = ()
) -> ConversionReport:
    """The report on an asset of the format `source` (None: of memory) that `target` has made the output of."""
    own = [*output.lost, *_find_renamed(output, target), *_find_faded_materials(asset, target)]
    features = [_subtract_losses(feature, own) for feature in (*features_of(asset), *_visual_features(asset))]
    # a creator sees the asset, not the document: what only that holds is never converted
    beyond = [_subtract_pictures(f, asset, target) for f in (source.features(asset) if source else ()) if f.count]
    lost = [f for f in features if f.count and f.kind not in target.holds]
    return ConversionReport(
        held=tuple(f for f in features if f.count and f.kind in target.holds),
        lost=(*(_explain_loss(f, target) for f in (*lost, *beyond) if f.count), *_merge_losses(own)),
        remarks=(*remarks, *output.notes),
    )


def _subtract_losses(feature: Feature, losses: Sequence[Loss]) -> Feature:
    """A feature without the things that losses are about."""
    like = [loss for loss in losses if loss.kind is feature.kind]
    names = {name for loss in like for name in loss.names}
    unnamed = max(0, feature.unnamed - sum(loss.unnamed for loss in like))
    return Feature(feature.kind, tuple(n for n in feature.names if n not in names), unnamed, feature.reason)


def _subtract_pictures(feature: Feature, asset: Asset, target: Format) -> Feature:
    """A feature of a document without the pictures that visuals take along."""
    if not target.has_pictures or isinstance(asset.visuals, VisualSurfaces):
        return feature
    shown = [surface.texture for surface in asset.visuals if surface.texture is not None]
    if not shown:
        return feature
    match feature.kind:
        case FeatureKind.MATERIALS:
            why = f"MeshForge converts only their base colours and the pictures of these to {target.title}"
            return replace(feature, reason=why)
        case FeatureKind.TEXTURES:
            count = len({texture.picture for texture in shown})
        case FeatureKind.TEXTURE_COORDINATES:
            count = len(shown)
        case _:
            return feature
    return Feature(feature.kind, (), max(0, feature.count - count), feature.reason)


def _explain_loss(feature: Feature, target: Format) -> Loss:
    """The loss of a feature that a format does not hold."""
    what = feature.kind
    if feature.reason:
        why = feature.reason
    elif what is FeatureKind.MATERIALS and FeatureKind.COLORS in target.holds:
        why = f"MeshForge converts only their plain colours to {target.title}"
    elif what in target.could | target.holds:
        why = f"MeshForge does not convert {what.many} to {target.title}"
    else:
        why = _WORDING.get(what, "{title} has no {many}").format(title=target.title, many=what.many)
    return Loss(what, feature.names, why, target.instead.get(what), feature.unnamed)


def _find_renamed(output: Output, target: Format) -> list[Loss]:
    """Hulls that the file holds under other names."""
    if not output.names or FeatureKind.NAMES not in target.holds:
        return []
    now = join_names(list(output.names.values()), 3)
    why = f"{'it reads' if len(output.names) == 1 else 'they read'} back as {now}"
    return [Loss(FeatureKind.NAMES, tuple(output.names), why, "written otherwise")]


def _visual_features(asset: Asset) -> Iterator[Feature]:
    """Visuals and their colours."""
    visuals = asset.visuals
    shown: Sequence[Surface | Visual] = visuals.visuals if isinstance(visuals, VisualSurfaces) else visuals
    yield _body_feature(FeatureKind.VISUALS, [visual.body for visual in shown])
    yield _body_feature(FeatureKind.COLORS, [visual.body for visual in shown if visual.rgba is not None])


def _find_faded_materials(asset: Asset, target: Format) -> list[Loss]:
    """Mesh files of visuals whose own materials the target does not show, though it has the shapes."""
    if FeatureKind.VISUALS not in target.holds or not isinstance(asset.visuals, VisualSurfaces):
        return []
    in_part: dict[Path, bool] = {}
    for visual in asset.visuals.visuals:
        if isinstance(visual.what, Path) and visual.what.suffix.lower() not in target.shown_files:
            has_look = target.has_pictures and visual.rgba is None and visual.what.suffix.lower() in LOOK_SUFFIXES
            in_part[visual.what] = in_part.get(visual.what, True) and has_look
    parts = {file: (file, *find_companions(file).values()) for file in in_part}
    faded = [file for file in in_part if any(part.suffix.lower() in _WITH_MATERIALS for part in parts[file])]
    bare = tuple(file.name for file in faded if not in_part[file])
    rest = tuple(file.name for file in faded if in_part[file])
    losses = [
        Loss(FeatureKind.MESH_MATERIALS, bare, f"{target.title} gets the shapes alone", "shown without these"),
        Loss(
            FeatureKind.MESH_MATERIALS,
            rest,
            "MeshForge converts nothing else of materials",
            "shown with base colours and their pictures",
        ),
    ]
    return [loss for loss in losses if loss.names]


def _merge_losses(losses: Sequence[Loss]) -> list[Loss]:
    """Losses of like things for a like reason as one."""
    alike: dict[tuple[FeatureKind, str, str | None], list[Loss]] = {}
    for loss in losses:
        alike.setdefault((loss.kind, loss.why, loss.instead), []).append(loss)
    return [
        Loss(what, tuple(n for one in each for n in one.names), why, instead, sum(one.unnamed for one in each))
        for (what, why, instead), each in alike.items()
    ]


def _body_feature(what: FeatureKind, bodies: list[str | None]) -> Feature:
    """A feature of things without names, named by the bodies that have them."""
    names = tuple(dict.fromkeys(body for body in bodies if body))
    return Feature(what, names, len(bodies) - len(names))


def turn_upright(asset: Asset, source: Format | None, target: Format) -> tuple[Asset, tuple[str, ...]]:
    """The asset as it stands upright in the target format, and remarks on that for the user.

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
    remark = f"the asset is turned about X to stand upright: {source.title} is {up}-up, {target.title} {wanted}-up"
    return turn_asset(asset, turn), (remark,)


def _turn_opaque(piece: Opaque, turn: Pose) -> Opaque:
    surface = _turn_surface(piece.surface, turn) if piece.surface else None
    return replace(piece, surface=surface, plane=turn @ piece.plane if piece.plane else None)


def turn_asset(asset: Asset, turn: Pose) -> Asset:
    """The asset in another root frame, new_T_old; frames of bodies are turned along, so that a root stays one."""
    back = turn.inverse()
    return replace(
        asset,
        bodies=tuple(Body(body.name, turn @ body.pose @ back) for body in asset.bodies),
        geoms=tuple(replace(geom, shape=geom.shape.move(turn)) for geom in asset.geoms),
        opaque=tuple(_turn_opaque(piece, turn) for piece in asset.opaque),
        visuals=_turn_visuals(asset.visuals, turn),
        mechanism=asset.mechanism.move(turn),
    )


def _turn_visuals(visuals: Sequence[Surface], turn: Pose) -> Sequence[Surface]:
    if isinstance(visuals, VisualSurfaces):
        return VisualSurfaces(tuple(visual.move(turn) for visual in visuals.visuals))
    return tuple(_turn_surface(surface, turn) for surface in visuals)


def _turn_surface(surface: Surface, turn: Pose) -> Surface:
    return replace(surface, vertices=turn.apply(surface.vertices))
