"""What a stage holds besides hulls, bodies, joints, masses and visuals, and what one made of another format holds."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from typing import Any

from meshforge.asset import Asset, Feature, What
from meshforge.formats.usd.library import usd
from meshforge.formats.usd.reading.stage import Scene

HOLDS = frozenset(
    {
        What.NAMES,
        What.BODIES,
        What.BOXES,
        What.SPHERES,
        What.CYLINDERS,
        What.CAPSULES,
        What.OPAQUE,
        What.PLANES,
        What.JOINTS,
        What.BALL_JOINTS,
        What.FIXED_JOINTS,
        What.MASSES,
        What.VISUALS,
        What.COLORS,
    }
)
COULD = frozenset(
    {
        What.MATERIALS,
        What.TEXTURES,
        What.TEXTURE_COORDINATES,
        What.VERTEX_COLORS,
        What.CONTACT,
        What.PAIRS,
        What.ACTUATORS,
        What.DYNAMICS,
        What.CAMERAS,
        What.LIGHTS,
        What.ANIMATIONS,
        What.SKINS,
        What.COMMENTS,
    }
)
_TYPES = {
    "Material": What.MATERIALS,
    "Camera": What.CAMERAS,
    "SkelRoot": What.SKINS,
    "PhysicsScene": What.SETTINGS,
    "PhysicsCollisionGroup": What.PAIRS,
    "PhysicsDistanceJoint": What.OTHERS,
}
_LIGHTS = "Light"


def features_of(asset: Asset) -> list[Feature]:
    """The features of a USD file that its asset does not tell."""
    with usd(str(asset.path)):
        return list(_features(Scene.open(asset.path)))


def _features(scene: Scene) -> Iterator[Feature]:
    found: dict[What, list[str]] = {}
    count: Counter[What] = Counter()
    for prim in scene.prims():
        what = _TYPES.get(str(prim.GetTypeName()))
        if what is None and str(prim.GetTypeName()).endswith(_LIGHTS):
            what = What.LIGHTS
        if what is not None:
            found.setdefault(what, []).append(prim.GetName())
        count.update(_of_attributes(prim))
    for what, names in found.items():
        yield Feature(what, tuple(dict.fromkeys(names)), len(names) - len(set(names)))
    for what, number in count.items():
        yield Feature(what, unnamed=number)


def _of_attributes(prim: Any) -> Iterator[What]:
    """What the attributes of a prim are, each kind once."""
    attributes = prim.GetAuthoredAttributes()
    if any(attribute.GetNumTimeSamples() > 1 for attribute in attributes):
        yield What.ANIMATIONS
    names = {attribute.GetName() for attribute in attributes}
    if prim.GetTypeName() == "Shader" and prim.GetAttribute("info:id").Get() == "UsdUVTexture":
        yield What.TEXTURES
    if "primvars:st" in names:
        yield What.TEXTURE_COORDINATES
    if any("physics:dynamicFriction" in name or name.startswith("physxMaterial") for name in names):
        yield What.CONTACT
    if any(name.startswith("drive:") for name in names):
        yield What.ACTUATORS
