"""An asset on its way into another format: turned upright, couplings followed to their drivers, losses reported."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from math import floor
from pathlib import Path

from meshforge.common import CollisionLossError, GeometryError, join_names, pluralize
from meshforge.formats.base import Format, Loss, Output, SceneFormat
from meshforge.formats.references import find_companions
from meshforge.formats.visuals import Visual, VisualSurfaces
from meshforge.geometry import Pose, convex_hull, volume_inside
from meshforge.symbolic import Asset, Body, Coupling, Feature, FeatureKind, Joint, NonConvexPiece, Surface, features_of

_WITH_MATERIALS = (".dae", ".glb", ".gltf", ".mtl")

_Z_FROM_Y = Pose([[1, 0, 0], [0, 0, -1], [0, 1, 0]], [0, 0, 0])


@dataclass(frozen=True, slots=True)
class ConversionReport:
    """What the output of another format holds besides the hulls, what it does not, and what else is to be known.

    marked: whether the source says what collides.
    """

    kept: tuple[Feature, ...] = ()
    lost: tuple[Loss, ...] = ()
    remarks: tuple[str, ...] = ()
    marked: bool = True

    @property
    def sentences(self) -> tuple[str, ...]:
        return (*self.remarks, *map(str, self.lost))

    def refuse_lost_collision(self, where: str, remedy: str) -> None:
        """Raise CollisionLossError where non-convex pieces, which collided, do not any more."""
        if lost := [loss for loss in self.lost if loss.kind is FeatureKind.NON_CONVEX and self.marked]:
            names = join_names([name for loss in lost for name in loss.names], 3)
            raise CollisionLossError(f"{names} would collide no more: {lost[0].why}", where=where, remedy=remedy)


def report_conversion(
    asset: Asset, source: Format | None, target: Format, output: Output, remarks: Iterable[str] = ()
) -> ConversionReport:
    """Return the report on an asset of the format `source` (None: of memory) that `target` has made the output of."""
    own = [*output.lost, *_find_faded_materials(asset, target)]
    if output.names and FeatureKind.NAMES in target.holds:
        now = join_names(list(output.names.values()), 3)
        why = f"{'it reads' if len(output.names) == 1 else 'they read'} back as {now}"
        own.insert(len(output.lost), Loss(FeatureKind.NAMES, tuple(output.names), why, "written otherwise"))
    visuals = asset.visuals
    shown: Sequence[Surface | Visual] = visuals.visuals if isinstance(visuals, VisualSurfaces) else visuals
    of_visuals = (
        Feature.of(FeatureKind.VISUALS, (visual.body for visual in shown)),
        Feature.of(FeatureKind.COLORS, (visual.body for visual in shown if visual.rgba is not None)),
    )
    features = [f for feature in (*features_of(asset), *of_visuals) if (f := _subtract_losses(feature, own)).count]
    # a creator sees the asset, not the document: what only that holds is never converted
    beyond = [feature for feature in (source.features(asset) if source else ()) if feature.count]
    lost: dict[tuple[FeatureKind, str, str | None], list[Loss]] = {}
    for loss in own:
        lost.setdefault((loss.kind, loss.why, loss.instead), []).append(loss)
    merged = (
        Loss(kind, tuple(n for one in each for n in one.names), why, instead, sum(one.unnamed for one in each))
        for (kind, why, instead), each in lost.items()
    )
    unheld = (_explain_loss(f, target) for f in (*(f for f in features if f.kind not in target.holds), *beyond))
    return ConversionReport(
        kept=tuple(f for f in features if f.kind in target.holds),
        lost=(*unheld, *merged),
        remarks=(*remarks, *output.notes),
        marked=not (isinstance(source, SceneFormat) and source.is_unmarked(asset)),
    )


def _subtract_losses(feature: Feature, losses: Sequence[Loss]) -> Feature:
    like = [loss for loss in losses if loss.kind is feature.kind]
    names = {name for loss in like for name in loss.names}
    unnamed = max(0, feature.unnamed - sum(loss.unnamed for loss in like))
    return Feature(feature.kind, tuple(n for n in feature.names if n not in names), unnamed, feature.reason)


def _explain_loss(feature: Feature, target: Format) -> Loss:
    instead, many = target.instead.get(feature.kind), feature.kind.many
    why = f"{target.title} has no {many}" if instead else f"MeshForge does not convert {many} to {target.title}"
    return Loss(feature.kind, feature.names, feature.reason or why, instead, feature.unnamed)


def _find_faded_materials(asset: Asset, target: Format) -> list[Loss]:
    """Mesh files of visuals whose own materials the target does not show, though it has the shapes."""
    if FeatureKind.VISUALS not in target.holds or not isinstance(asset.visuals, VisualSurfaces):
        return []
    files = {v.what for v in asset.visuals.visuals if isinstance(v.what, Path)}
    others = sorted(file for file in files if file.suffix.lower() not in target.shown_files)
    faded = [
        file.name
        for file in others
        if any(part.suffix.lower() in _WITH_MATERIALS for part in (file, *find_companions(file).values()))
    ]
    instead = "shown with one picture or base colour a mesh" if target.has_pictures else "shown without these"
    why = f"MeshForge does not convert the rest of materials to {target.title}"
    return [Loss(FeatureKind.MESH_MATERIALS, tuple(faded), why, instead)] if faded else []


def turn_upright(asset: Asset, source: Format | None, target: Format) -> tuple[Asset, tuple[str, ...]]:
    """Return the asset as it stands upright in the target format, and remarks on that for the user.

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


def turn_asset(asset: Asset, turn: Pose) -> Asset:
    """Return the asset in another root frame, new_T_old; frames of bodies turn along, so that a root stays one."""

    def turn_surface(surface: Surface) -> Surface:
        return replace(surface, vertices=turn.apply(surface.vertices))

    back, visuals = turn.inverse(), asset.visuals
    return replace(
        asset,
        bodies=tuple(Body(body.name, turn @ body.pose @ back) for body in asset.bodies),
        geoms=tuple(replace(geom, shape=geom.shape.move(turn)) for geom in asset.geoms),
        non_convex=tuple(
            replace(o, surface=o.surface and turn_surface(o.surface), plane=o.plane and turn @ o.plane)
            for o in asset.non_convex
        ),
        visuals=VisualSurfaces(tuple(visual.move(turn) for visual in visuals.visuals))
        if isinstance(visuals, VisualSurfaces)
        else tuple(map(turn_surface, visuals)),
        mechanism=asset.mechanism.move(turn),
    )


def note_hulled(pieces: Sequence[NonConvexPiece], engines: str) -> list[str]:
    """Return a note on pieces of which engines make hulls: which, and the share of its hull that each fills."""
    if not pieces:
        return []
    found = [_measure_fill(piece.surface) for piece in pieces if piece.surface]
    shares = sorted({floor(100 * share) for share in found if share is not None})  # as the reader says it
    full = f" ({'% to '.join(map(str, dict.fromkeys((shares[0], shares[-1]))))}% full)" if shares else ""
    which = f"{pluralize(len(pieces), 'non-convex piece')} ({join_names([piece.name for piece in pieces], 3)})"
    each = "each of " * (len(pieces) > 1)
    return [f"{each}{which} is written as it is: {engines} will collide with its hull{full}"]


def _measure_fill(surface: Surface) -> float | None:
    """The share of its convex hull that a surface encloses; None where it is open, or its hull has no volume."""
    volume = volume_inside(surface.vertices, surface.faces)
    try:
        return volume and min(1.0, volume / convex_hull(surface.vertices[surface.faces].reshape(-1, 3)).volume)
    except GeometryError:
        return None


@dataclass(slots=True)
class CouplingPlan:
    """The coupling of each joint by its name, and what cannot be written."""

    by_joint: dict[str, Coupling] = field(default_factory=dict)
    lost: list[Loss] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)


def plan_couplings(joints: Sequence[Joint], title: str, *, polynomials: bool = False) -> CouplingPlan:
    """Return the couplings that a format gets; polynomials: whether it has those that are not linear."""
    plan = CouplingPlan()
    moving = {joint.name: joint for joint in joints if joint.kind in ("revolute", "prismatic") and joint.name}
    for joint in joints:
        if joint.coupling is None:
            continue
        found, way = joint.coupling, [joint.name]
        why = "" if moving.get(joint.name) is joint else "it neither turns nor slides, or has no name"
        while not why:
            driver = moving.get(found.joint)
            if driver is None:
                why = f"there is no joint {found.joint!r} that turns or slides"
            elif driver.name in way:
                why = f"{' -> '.join([*way, driver.name])} is a ring"
            elif not (found.is_linear or polynomials):
                why = f"it follows a polynomial, and {title} has linear couplings only"
            elif driver.coupling is None or not (found.is_linear and driver.coupling.is_linear):
                break
            else:
                (offset, factor), (before, inner) = found.coefficients, driver.coupling.coefficients
                found = Coupling(driver.coupling.joint, (offset + factor * before, factor * inner))
                way.append(driver.name)
        if why:
            plan.lost.append(Loss(FeatureKind.MIMICS, (joint.name,) if joint.name else (), why, unnamed=not joint.name))
            continue
        plan.by_joint[joint.name] = found
        if len(way) > 1:
            plan.notes.append(f"joint {way[0]!r} follows {found.joint!r} itself, no longer through {way[1]!r}")
    return plan
