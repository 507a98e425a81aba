"""The format URDF as the registry has it: what a URDF can hold, what one holds besides hulls, joints, masses and
visuals, and making one from an asset of another format."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import ClassVar

from meshforge.common import AssetError
from meshforge.formats.base import (
    BODY_FEATURES,
    Format,
    Mass,
    Output,
    ReadOptions,
    feature_of,
    feature_of_others,
    list_others,
)
from meshforge.formats.urdf.document import VISUAL_SUFFIXES, UrdfDocument, parse_robot
from meshforge.formats.xml import XmlText
from meshforge.symbolic import Asset, Feature, FeatureKind

_TAKEN = ("link", "joint", "material", "visual")
_LEAVES = (
    *("inertial", "collision", "origin", "geometry", "color"),
    *("parent", "child", "axis", "limit", "dynamics", "mimic"),
)


class UrdfFormat(Format):
    """The Unified Robot Description Format."""

    name = "urdf"
    engines = ("mujoco", "bullet")
    suffixes = (".urdf",)
    is_description = True
    title = "URDF"
    up = "z"
    holds = BODY_FEATURES | {FeatureKind.OPAQUE, FeatureKind.JOINTS, FeatureKind.FIXED_JOINTS, FeatureKind.SPEEDS}
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
    yield feature_of(
        FeatureKind.MIMICS, (j.attributes.get("name", "") for j in robot.each("joint") if j.first("mimic"))
    )
    yield feature_of_others([*list_others(robot, _TAKEN, _LEAVES), *["comment"] * data.count(b"<!--")])
