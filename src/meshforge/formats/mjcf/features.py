"""What an MJCF holds besides bodies, hulls, joints, masses and visuals."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from meshforge.formats.base import feature_of
from meshforge.formats.mjcf.document import MjcfDocument, MjcfNode
from meshforge.symbolic import Feature, FeatureKind

_SECTIONS = {
    "actuator": FeatureKind.ACTUATORS,
    "sensor": FeatureKind.SENSORS,
    "tendon": FeatureKind.TENDONS,
    "equality": FeatureKind.MIMICS,
    "contact": FeatureKind.PAIRS,
    "keyframe": FeatureKind.KEYFRAMES,
    "deformable": FeatureKind.SKINS,
}
_ELEMENTS = {
    "site": FeatureKind.SITES,
    "camera": FeatureKind.CAMERAS,
    "light": FeatureKind.LIGHTS,
    "flexcomp": FeatureKind.SKINS,
}
_SETTINGS = ("option", "size", "visual", "statistic")
_OTHERS = ("extension", "custom")
_CONTACT = ("contype", "conaffinity", "condim", "friction", "solref", "solimp", "solmix", "margin", "gap", "priority")
_DYNAMICS = ("stiffness", "springref", "springdamper", "springlength", "armature")


def features_of(document: MjcfDocument) -> Iterator[Feature]:
    """The features of an MJCF that its asset does not have, as its elements say; those that classes set count once."""
    root = document.tree.root
    for tag, what in _SECTIONS.items():
        yield _feature_of(what, [node for section in root.children if section.tag == tag for node in section.children])
    bodies = [node for world in root.children if world.tag == "worldbody" for node in world.walk()]
    for tag, what in _ELEMENTS.items():
        yield _feature_of(what, [node for node in bodies if node.tag == tag])
    for what, tag, keys in ((FeatureKind.CONTACT, "geom", _CONTACT), (FeatureKind.DYNAMICS, "joint", _DYNAMICS)):
        yield _feature_of(what, [n for n in root.walk() if n.tag == tag and any(key in n.attributes for key in keys)])
    assets = [node for section in root.children if section.tag == "asset" for node in section.children]
    yield _feature_of(FeatureKind.MATERIALS, [node for node in assets if node.tag == "material"])
    yield _feature_of(FeatureKind.TEXTURES, [node for node in assets if node.tag == "texture"])
    for what, tags in ((FeatureKind.SETTINGS, _SETTINGS), (FeatureKind.OTHERS, _OTHERS)):
        yield Feature(what, tuple(dict.fromkeys(node.tag for node in root.children if node.tag in tags)))
    yield Feature(FeatureKind.COMMENTS, unnamed=sum(source.raw.count(b"<!--") for source in document.sources))


def _feature_of(what: FeatureKind, nodes: Iterable[MjcfNode]) -> Feature:
    return feature_of(what, (node.attributes.get("name", "") for node in nodes))
