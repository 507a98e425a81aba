"""What a stage holds besides hulls, bodies, joints, masses and visuals."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from typing import Any

from meshforge.formats.base import feature_of_tags
from meshforge.formats.usd.stage import UsdStage, usd
from meshforge.symbolic import Asset, Feature, FeatureKind

_TYPES = {
    "Material": FeatureKind.MATERIALS,
    "Camera": FeatureKind.CAMERAS,
    "SkelRoot": FeatureKind.SKINS,
    "PhysicsScene": FeatureKind.SETTINGS,
    "PhysicsCollisionGroup": FeatureKind.PAIRS,
    "PhysicsDistanceJoint": FeatureKind.OTHERS,
}
_LIGHTS = "Light"


def features_of(asset: Asset) -> list[Feature]:
    """The features of a USD file that its asset does not have."""
    with usd(str(asset.path)):
        return list(_list_features(UsdStage.open(asset.path)))


def _list_features(scene: UsdStage) -> Iterator[Feature]:
    found: dict[FeatureKind, list[str]] = {}
    count: Counter[FeatureKind] = Counter()
    for prim in scene.prims():
        what = _TYPES.get(str(prim.GetTypeName()))
        if what is None and str(prim.GetTypeName()).endswith(_LIGHTS):
            what = FeatureKind.LIGHTS
        if what is not None:
            found.setdefault(what, []).append(prim.GetName())
        count.update(_features_of_attributes(prim))
    for what, names in found.items():
        yield feature_of_tags(what, names)
    for what, number in count.items():
        yield Feature(what, unnamed=number)


def _features_of_attributes(prim: Any) -> Iterator[FeatureKind]:
    """What the attributes of a prim are, each kind once."""
    attributes = prim.GetAuthoredAttributes()
    if any(attribute.GetNumTimeSamples() > 1 for attribute in attributes):
        yield FeatureKind.ANIMATIONS
    names = {attribute.GetName() for attribute in attributes}
    if prim.GetTypeName() == "Shader" and prim.GetAttribute("info:id").Get() == "UsdUVTexture":
        yield FeatureKind.TEXTURES
    if "primvars:st" in names:
        yield FeatureKind.TEXTURE_COORDINATES
    if any("physics:dynamicFriction" in name or name.startswith("physxMaterial") for name in names):
        yield FeatureKind.CONTACT
    if any(name.startswith("drive:") for name in names):
        yield FeatureKind.ACTUATORS
