"""What an asset has besides its hulls: the kinds of things, and those that any asset can be asked for."""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from enum import Enum

from meshforge.symbolic.asset import Asset

_UNNAMED = re.compile(r"(.*/)?geom\d+(#\d+)?(@\d+)?")


class FeatureKind(Enum):
    """A kind of thing that a file may hold; its words for one and for many."""

    NAMES = "hull name", "hull names"
    BODIES = "body", "bodies"
    BOXES = "box", "boxes"
    SPHERES = "sphere", "spheres"
    CYLINDERS = "cylinder", "cylinders"
    CAPSULES = "capsule", "capsules"
    ELLIPSOIDS = "ellipsoid", "ellipsoids"
    NON_CONVEX = "opaque piece", "opaque pieces"
    PLANES = "endless plane", "endless planes"
    SHAPELESS = "piece without a surface", "pieces without a surface"
    JOINTS = "joint", "joints"
    BALL_JOINTS = "ball joint", "ball joints"
    FIXED_JOINTS = "name of a fixed joint", "names of fixed joints"
    SPEEDS = "speed limit", "speed limits"
    MIMICS = "coupling", "couplings"
    PAIRS = "excluded pair", "excluded pairs"
    MASSES = "mass", "masses"
    VISUALS = "visual", "visuals"
    COLORS = "colour", "colours"
    MESH_MATERIALS = "mesh file with materials", "mesh files with materials"
    OTHERS = "other element", "other elements"

    @property
    def one(self) -> str:
        return self.value[0]

    @property
    def many(self) -> str:
        return self.value[1]


@dataclass(frozen=True, slots=True)
class Feature:
    """Things of one kind that an asset has; count: where they have no names; reason: why no file could hold them."""

    kind: FeatureKind
    names: tuple[str, ...] = ()
    unnamed: int = 0
    reason: str = ""

    @staticmethod
    def of(kind: FeatureKind, names: Iterable[str | None]) -> "Feature":
        """Return the feature of things, each name once; what has none is counted, and so is a name that comes again."""
        each = list(names)
        named = tuple(dict.fromkeys(name for name in each if name))
        return Feature(kind, named, len(each) - len(named))

    @property
    def count(self) -> int:
        return len(self.names) + self.unnamed


PRIMITIVE_FEATURES = {
    "box": FeatureKind.BOXES,
    "sphere": FeatureKind.SPHERES,
    "cylinder": FeatureKind.CYLINDERS,
    "capsule": FeatureKind.CAPSULES,
    "ellipsoid": FeatureKind.ELLIPSOIDS,
}
"""The kinds of native shapes, by the name of the shape."""


def features_of(asset: Asset) -> list[Feature]:
    """Return what an asset has, whatever its format; kinds that it has none of are left out."""
    return [feature for feature in (*_features_of_geoms(asset), *_features_of_mechanism(asset)) if feature.count]


def _features_of_geoms(asset: Asset) -> Iterator[Feature]:
    yield Feature(FeatureKind.NAMES, tuple(g.name for g in asset.geoms if not _UNNAMED.fullmatch(g.name)))
    if len(asset.bodies) > 1:
        yield Feature(FeatureKind.BODIES, tuple(body.name for body in asset.bodies))
    for kind, what in PRIMITIVE_FEATURES.items():
        yield Feature(what, tuple(g.name for g in asset.geoms if g.shape.kind == kind))
    yield Feature(FeatureKind.NON_CONVEX, tuple(o.name for o in asset.non_convex if o.surface and not o.plane))
    yield Feature(FeatureKind.PLANES, tuple(o.name for o in asset.non_convex if o.plane))
    bare = [o for o in asset.non_convex if not o.surface and not o.plane]
    for reason in dict.fromkeys(o.reason for o in bare):
        yield Feature(FeatureKind.SHAPELESS, tuple(o.name for o in bare if o.reason == reason), reason=reason)


def _features_of_mechanism(asset: Asset) -> Iterator[Feature]:
    joints = asset.mechanism.joints
    moving = [joint for joint in joints if joint.kind not in ("fixed", "ball")]
    yield Feature.of(FeatureKind.JOINTS, (joint.name for joint in moving))
    yield Feature.of(FeatureKind.BALL_JOINTS, (joint.name for joint in joints if joint.kind == "ball"))
    fixed = [joint.name for joint in joints if joint.kind == "fixed" and joint.name]
    yield Feature(FeatureKind.FIXED_JOINTS, tuple(fixed))
    yield Feature.of(FeatureKind.SPEEDS, (joint.name for joint in moving if joint.velocity is not None))
    yield Feature.of(FeatureKind.MIMICS, (joint.name for joint in joints if joint.coupling))
    yield Feature(FeatureKind.PAIRS, tuple(":".join(pair) for pair in asset.mechanism.apart))
    yield Feature(FeatureKind.MASSES, tuple(inertial.body for inertial in asset.mechanism.inertials))
