"""The format MJCF as the registry has it, what an MJCF can hold, and what one holds besides bodies, hulls, joints,
masses and visuals."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from pathlib import Path

from meshforge.common import AssetError, require_mujoco
from meshforge.formats.base import BODY_FEATURES, SCENE_FEATURES, Format, Mass, Output, ReadOptions, feature_of
from meshforge.formats.mjcf.document import MjcfDocument, MjcfNode
from meshforge.symbolic import Asset, Feature, FeatureKind

_ROOT = re.compile(r"[^<]*+(?:<(?>\?.*?\?>|!--.*?-->|![^-][^>]*>)[^<]*+)*+<([\w:.-]+)", re.S)
"""An XML text up to the tag of its first element."""

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


class MjcfFormat(Format):
    """MuJoCo's own format for models."""

    name = "mjcf"
    engines = ("mujoco",)
    suffixes = (".xml", ".mjcf")
    is_description = True
    title = "MJCF"
    up = "z"
    holds = BODY_FEATURES | {
        *(FeatureKind.CAPSULES, FeatureKind.ELLIPSOIDS, FeatureKind.PLANES, FeatureKind.OPAQUE),
        *(FeatureKind.JOINTS, FeatureKind.BALL_JOINTS),
    }
    could = SCENE_FEATURES | {
        *(FeatureKind.MIMICS, FeatureKind.PAIRS, FeatureKind.SITES, FeatureKind.SKINS, FeatureKind.KEYFRAMES),
        FeatureKind.COMMENTS,
    }

    def matches_head(self, head: bytes) -> bool:
        root = _ROOT.match(head.decode("utf-8", "replace").replace("\0", ""))
        return root is None or root[1].lower() == "mujoco"

    def read(self, path: Path, options: ReadOptions) -> Asset:
        require_mujoco("an MJCF", str(path))
        from meshforge.formats.mjcf import read  # lazy: only MJCF needs it

        return read.read_mjcf(path)

    def write(self, asset: Asset, name: str, mass: Mass = "keep") -> Output:
        if not isinstance(asset.document, MjcfDocument):
            raise AssetError("this asset was not read from an MJCF", where=str(asset.path))
        require_mujoco("an MJCF", str(asset.path))
        from meshforge.formats.mjcf import edit  # lazy: only MJCF needs it

        return edit.write_mjcf(asset, asset.document, name, mass)

    def create(self, asset: Asset, name: str) -> Output:
        from meshforge.formats.mjcf import create  # lazy: only MJCF needs it

        return create.create_mjcf(asset, name)

    def top(self, asset: Asset) -> Path:
        if not isinstance(asset.document, MjcfDocument):
            return super().top(asset)
        from meshforge.formats.mjcf import references  # lazy: only MJCF needs it

        return references.top_folder(asset.document)

    def features(self, asset: Asset) -> Iterable[Feature]:
        return features_of(asset.document) if isinstance(asset.document, MjcfDocument) else ()


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
