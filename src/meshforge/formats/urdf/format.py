"""The format URDF as the registry has it, what a URDF can hold, and what one holds besides hulls, joints, masses and
visuals."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import ClassVar, Literal

from meshforge.common import AssetError
from meshforge.formats.base import Format, Mass, Output, ReadOptions
from meshforge.formats.urdf.create import VISUAL_SUFFIXES, create_urdf
from meshforge.formats.urdf.document import UrdfDocument, parse_robot
from meshforge.formats.urdf.edit import write_urdf
from meshforge.formats.urdf.read import read_urdf
from meshforge.formats.xml import Element, XmlText
from meshforge.symbolic import Asset, Feature, FeatureKind

HOLDS = frozenset(
    {
        FeatureKind.NAMES,
        FeatureKind.BODIES,
        FeatureKind.BOXES,
        FeatureKind.SPHERES,
        FeatureKind.CYLINDERS,
        FeatureKind.OPAQUE,
        FeatureKind.JOINTS,
        FeatureKind.FIXED_JOINTS,
        FeatureKind.SPEEDS,
        FeatureKind.MASSES,
        FeatureKind.VISUALS,
        FeatureKind.COLORS,
    }
)
COULD = frozenset(
    {FeatureKind.MIMICS, FeatureKind.CONTACT, FeatureKind.COMMENTS, FeatureKind.MATERIALS, FeatureKind.TEXTURES}
)
INSTEAD = {
    FeatureKind.CAPSULES: "written as triangles",
    FeatureKind.ELLIPSOIDS: "written as triangles",
    FeatureKind.BALL_JOINTS: "written as three joints that turn about one point",
}

_KNOWN_TAGS = ("link", "joint", "material")
_COMMENT = re.compile(rb"<!--")


class UrdfFormat(Format):
    """The Unified Robot Description Format."""

    name: ClassVar[str] = "urdf"
    suffixes: ClassVar[tuple[str, ...]] = (".urdf",)
    is_description: ClassVar[bool] = True
    title: ClassVar[str] = "URDF"
    up: ClassVar[Literal["y", "z"] | None] = "z"
    holds: ClassVar[frozenset[FeatureKind]] = HOLDS
    could: ClassVar[frozenset[FeatureKind]] = COULD
    instead: ClassVar[Mapping[FeatureKind, str]] = INSTEAD
    shown_files: ClassVar[tuple[str, ...]] = VISUAL_SUFFIXES

    def read(self, path: Path, options: ReadOptions) -> Asset:
        return read_urdf(path, options)

    def write(self, asset: Asset, name: str, mass: Mass = "keep") -> Output:
        if not isinstance(asset.document, UrdfDocument):
            raise AssetError("this asset was not read from a URDF", where=str(asset.path))
        return write_urdf(asset, asset.document, name)

    def create(self, asset: Asset, name: str) -> Output:
        return create_urdf(asset, name)

    def features(self, asset: Asset) -> Iterable[Feature]:
        return features_of(asset.document) if isinstance(asset.document, UrdfDocument) else ()


def features_of(document: UrdfDocument) -> Iterator[Feature]:
    """The features of a URDF that its asset does not tell."""
    data = XmlText.of(document.source).data
    robot = parse_robot(data, "")
    joints = list(robot.each("joint"))
    yield Feature(FeatureKind.MIMICS, tuple(_name_of(joint) for joint in joints if joint.first("mimic")))
    yield Feature(
        FeatureKind.TEXTURES, tuple(dict.fromkeys(e.attributes.get("filename", "") for e in _textures(robot)))
    )
    yield Feature(FeatureKind.CONTACT, tuple(_name_of(link) for link in robot.each("link") if link.first("contact")))
    others = [child.tag for child in robot.children if child.tag not in _KNOWN_TAGS]
    others += [
        part.tag for joint in joints for part in joint.children if part.tag in ("safety_controller", "calibration")
    ]
    kinds = tuple(dict.fromkeys(others))
    yield Feature(FeatureKind.OTHERS, kinds, len(others) - len(kinds))
    yield Feature(FeatureKind.COMMENTS, unnamed=len(_COMMENT.findall(data)))


def _textures(robot: Element) -> Iterator[Element]:
    return (element for element in robot.walk() if element.tag == "texture")


def _name_of(element: Element) -> str:
    return element.attributes.get("name", "")
