"""What an MJCF holds besides bodies, hulls, joints, masses and visuals, and what one made of another format holds."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from meshforge.asset import Feature, What
from meshforge.formats.mjcf.document import MjcfDocument
from meshforge.formats.mjcf.files.sources import Node

HOLDS = frozenset(
    {
        What.NAMES,
        What.BODIES,
        What.BOXES,
        What.SPHERES,
        What.CYLINDERS,
        What.CAPSULES,
        What.ELLIPSOIDS,
        What.PLANES,
        What.JOINTS,
        What.BALL_JOINTS,
        What.MASSES,
        What.VISUALS,
        What.COLORS,
    }
)
COULD = frozenset(
    {
        What.MIMICS,
        What.TEXTURES,
        What.MATERIALS,
        What.CONTACT,
        What.PAIRS,
        What.CAMERAS,
        What.LIGHTS,
        What.SITES,
        What.COMMENTS,
        What.SKINS,
        What.KEYFRAMES,
    }
)
_SECTIONS = {
    "actuator": What.ACTUATORS,
    "sensor": What.SENSORS,
    "tendon": What.TENDONS,
    "equality": What.MIMICS,
    "contact": What.PAIRS,
    "keyframe": What.KEYFRAMES,
    "deformable": What.SKINS,
}
_ELEMENTS = {"site": What.SITES, "camera": What.CAMERAS, "light": What.LIGHTS, "flexcomp": What.SKINS}
_SETTINGS = ("option", "size", "visual", "statistic")
_OTHERS = ("extension", "custom")
_CONTACT = ("contype", "conaffinity", "condim", "friction", "solref", "solimp", "solmix", "margin", "gap", "priority")
_DYNAMICS = ("stiffness", "springref", "springdamper", "springlength", "armature")
_COMMENT = re.compile(rb"<!--")


def features_of(document: MjcfDocument) -> Iterator[Feature]:
    """The features of an MJCF that its asset does not tell, as its elements say; those that classes set count once."""
    root = document.tree.root
    for tag, what in _SECTIONS.items():
        yield _named(what, [node for section in root.children if section.tag == tag for node in section.children])
    bodies = [node for world in root.children if world.tag == "worldbody" for node in world.walk()]
    for tag, what in _ELEMENTS.items():
        yield _named(what, [node for node in bodies if node.tag == tag])
    yield _named(
        What.CONTACT, [n for n in root.walk() if n.tag == "geom" and any(key in n.attributes for key in _CONTACT)]
    )
    yield _named(What.DYNAMICS, [n for n in root.walk() if n.tag == "joint" and _springs(n)])
    assets = [node for section in root.children if section.tag == "asset" for node in section.children]
    yield _named(What.MATERIALS, [node for node in assets if node.tag == "material"])
    yield _named(What.TEXTURES, [node for node in assets if node.tag == "texture"])
    yield Feature(What.SETTINGS, tuple(dict.fromkeys(node.tag for node in root.children if node.tag in _SETTINGS)))
    yield Feature(What.OTHERS, tuple(dict.fromkeys(node.tag for node in root.children if node.tag in _OTHERS)))
    yield Feature(What.COMMENTS, unnamed=sum(len(_COMMENT.findall(source.raw)) for source in document.sources))


def _springs(node: Node) -> bool:
    return any(key in node.attributes for key in _DYNAMICS)


def _named(what: What, nodes: Iterable[Node]) -> Feature:
    names = [node.attributes.get("name", "") for node in nodes]
    return Feature(what, tuple(name for name in names if name), sum(not name for name in names))
