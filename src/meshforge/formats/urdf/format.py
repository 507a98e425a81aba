"""The format URDF as the registry has it: what a URDF can hold, what one holds besides hulls, joints, masses and
visuals, and making one from an asset of another format."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import ClassVar

from meshforge.common import AssetError
from meshforge.formats.base import BODY_FEATURES, Format, Mass, Output, ReadOptions, feature_of_tags
from meshforge.formats.urdf.document import VISUAL_SUFFIXES, UrdfDocument, parse_robot
from meshforge.formats.xml import Element, XmlText
from meshforge.symbolic import Asset, Feature, FeatureKind

_KNOWN_TAGS = ("link", "joint", "material")
_JOINT_SETTINGS = ("safety_controller", "calibration")


class UrdfFormat(Format):
    """The Unified Robot Description Format."""

    name = "urdf"
    engines = ("mujoco", "bullet")
    suffixes = (".urdf",)
    is_description = True
    title = "URDF"
    up = "z"
    holds = BODY_FEATURES | {FeatureKind.OPAQUE, FeatureKind.JOINTS, FeatureKind.FIXED_JOINTS, FeatureKind.SPEEDS}
    could = frozenset(
        {FeatureKind.MIMICS, FeatureKind.CONTACT, FeatureKind.COMMENTS, FeatureKind.MATERIALS, FeatureKind.TEXTURES}
    )
    instead: ClassVar[Mapping[FeatureKind, str]] = {
        FeatureKind.CAPSULES: "written as triangles",
        FeatureKind.ELLIPSOIDS: "written as triangles",
        FeatureKind.BALL_JOINTS: "written as three joints that turn about one point",
    }
    shown_files = VISUAL_SUFFIXES

    def read(self, path: Path, options: ReadOptions) -> Asset:
        from meshforge.formats.urdf import read  # lazy: only URDF needs it

        return read.read_urdf(path, options)

    def write(self, asset: Asset, name: str, mass: Mass = "keep") -> Output:
        if not isinstance(asset.document, UrdfDocument):
            raise AssetError("this asset was not read from a URDF", where=str(asset.path))
        from meshforge.formats.urdf import edit  # lazy: only URDF needs it

        return edit.write_urdf(asset, asset.document, name)

    def create(self, asset: Asset, name: str) -> Output:
        from meshforge.formats.urdf import create  # lazy: only URDF needs it

        return create.create_urdf(asset, name)

    def features(self, asset: Asset) -> Iterable[Feature]:
        return features_of(asset.document) if isinstance(asset.document, UrdfDocument) else ()


def features_of(document: UrdfDocument) -> Iterator[Feature]:
    """The features of a URDF that its asset does not have."""
    data = XmlText.of(document.source).data
    robot = parse_robot(data, "")
    joints = list(robot.each("joint"))
    yield Feature(FeatureKind.MIMICS, tuple(_name_of(joint) for joint in joints if joint.first("mimic")))
    textures = (e.attributes.get("filename", "") for e in robot.walk() if e.tag == "texture")
    yield Feature(FeatureKind.TEXTURES, tuple(dict.fromkeys(textures)))
    yield Feature(FeatureKind.CONTACT, tuple(_name_of(link) for link in robot.each("link") if link.first("contact")))
    others = [child.tag for child in robot.children if child.tag not in _KNOWN_TAGS]
    others += [part.tag for joint in joints for part in joint.children if part.tag in _JOINT_SETTINGS]
    yield feature_of_tags(FeatureKind.OTHERS, others)
    yield Feature(FeatureKind.COMMENTS, unnamed=data.count(b"<!--"))


def _name_of(element: Element) -> str:
    return element.attributes.get("name", "")
