"""The format MJCF as the registry has it, what an MJCF can hold, and what one holds besides bodies, hulls, joints,
masses and visuals."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import ClassVar, Literal

from meshforge.common import AssetError
from meshforge.formats.base import Format, Mass, Output, ReadOptions
from meshforge.formats.mjcf.create import create_mjcf
from meshforge.formats.mjcf.document import MjcfDocument, MjcfNode
from meshforge.formats.mjcf.edit import write_mjcf
from meshforge.formats.mjcf.read import read_mjcf
from meshforge.formats.mjcf.references import top_folder
from meshforge.symbolic import Asset, Feature, FeatureKind

_ROOT = re.compile(r"[^<]*+(?:<(?>\?.*?\?>|!--.*?-->|![^-][^>]*>)[^<]*+)*+<([\w:.-]+)", re.S)
"""An XML text up to the tag of its first element."""

HOLDS = frozenset(
    {
        FeatureKind.NAMES,
        FeatureKind.BODIES,
        FeatureKind.BOXES,
        FeatureKind.SPHERES,
        FeatureKind.CYLINDERS,
        FeatureKind.CAPSULES,
        FeatureKind.ELLIPSOIDS,
        FeatureKind.PLANES,
        FeatureKind.JOINTS,
        FeatureKind.BALL_JOINTS,
        FeatureKind.MASSES,
        FeatureKind.VISUALS,
        FeatureKind.COLORS,
    }
)
COULD = frozenset(
    {
        FeatureKind.MIMICS,
        FeatureKind.TEXTURES,
        FeatureKind.MATERIALS,
        FeatureKind.CONTACT,
        FeatureKind.PAIRS,
        FeatureKind.CAMERAS,
        FeatureKind.LIGHTS,
        FeatureKind.SITES,
        FeatureKind.COMMENTS,
        FeatureKind.SKINS,
        FeatureKind.KEYFRAMES,
    }
)
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
_COMMENT = re.compile(rb"<!--")


class MjcfFormat(Format):
    """MuJoCo's own format for models."""

    name: ClassVar[str] = "mjcf"
    suffixes: ClassVar[tuple[str, ...]] = (".xml", ".mjcf")
    is_description: ClassVar[bool] = True
    title: ClassVar[str] = "MJCF"
    up: ClassVar[Literal["y", "z"] | None] = "z"
    holds: ClassVar[frozenset[FeatureKind]] = HOLDS
    could: ClassVar[frozenset[FeatureKind]] = COULD
    instead: ClassVar[Mapping[FeatureKind, str]] = {FeatureKind.OPAQUE: "written as surfaces that do not collide"}

    def matches_head(self, head: bytes) -> bool:
        root = _ROOT.match(head.decode("utf-8", "replace").replace("\0", ""))
        return root is None or root[1].lower() == "mujoco"

    def read(self, path: Path, options: ReadOptions) -> Asset:
        return read_mjcf(path)

    def write(self, asset: Asset, name: str, mass: Mass = "keep") -> Output:
        if not isinstance(asset.document, MjcfDocument):
            raise AssetError("this asset was not read from an MJCF", where=str(asset.path))
        return write_mjcf(asset, asset.document, name, mass)

    def create(self, asset: Asset, name: str) -> Output:
        return create_mjcf(asset, name)

    def top(self, asset: Asset) -> Path:
        return top_folder(asset.document) if isinstance(asset.document, MjcfDocument) else super().top(asset)

    def features(self, asset: Asset) -> Iterable[Feature]:
        return features_of(asset.document) if isinstance(asset.document, MjcfDocument) else ()


def features_of(document: MjcfDocument) -> Iterator[Feature]:
    """The features of an MJCF that its asset does not tell, as its elements say; those that classes set count once."""
    root = document.tree.root
    for tag, what in _SECTIONS.items():
        yield _feature_of(what, [node for section in root.children if section.tag == tag for node in section.children])
    bodies = [node for world in root.children if world.tag == "worldbody" for node in world.walk()]
    for tag, what in _ELEMENTS.items():
        yield _feature_of(what, [node for node in bodies if node.tag == tag])
    yield _feature_of(
        FeatureKind.CONTACT,
        [n for n in root.walk() if n.tag == "geom" and any(key in n.attributes for key in _CONTACT)],
    )
    yield _feature_of(FeatureKind.DYNAMICS, [n for n in root.walk() if n.tag == "joint" and _has_springs(n)])
    assets = [node for section in root.children if section.tag == "asset" for node in section.children]
    yield _feature_of(FeatureKind.MATERIALS, [node for node in assets if node.tag == "material"])
    yield _feature_of(FeatureKind.TEXTURES, [node for node in assets if node.tag == "texture"])
    yield Feature(
        FeatureKind.SETTINGS, tuple(dict.fromkeys(node.tag for node in root.children if node.tag in _SETTINGS))
    )
    yield Feature(FeatureKind.OTHERS, tuple(dict.fromkeys(node.tag for node in root.children if node.tag in _OTHERS)))
    yield Feature(FeatureKind.COMMENTS, unnamed=sum(len(_COMMENT.findall(source.raw)) for source in document.sources))


def _has_springs(node: MjcfNode) -> bool:
    return any(key in node.attributes for key in _DYNAMICS)


def _feature_of(what: FeatureKind, nodes: Iterable[MjcfNode]) -> Feature:
    names = [node.attributes.get("name", "") for node in nodes]
    return Feature(what, tuple(name for name in names if name), sum(not name for name in names))
