"""The format URDF as the registry has it: what it can hold, and what a file holds that no conversion takes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import ClassVar

from meshforge.common import AssetError
from meshforge.formats import base
from meshforge.formats.urdf.document import VISUAL_SUFFIXES, UrdfDocument, parse_robot
from meshforge.formats.xml import XmlText
from meshforge.symbolic import Asset, Feature, FeatureKind

_TAKEN = ("link", "joint", "material", "visual")
_LEAVES = (
    *("inertial", "collision", "origin", "geometry", "color"),
    *("parent", "child", "axis", "limit", "dynamics", "mimic"),
)


class UrdfFormat(base.Format):
    """The Unified Robot Description Format; has_capsules: whether it is written with them."""

    name = "urdf"
    engines = ("mujoco", "bullet")
    suffixes = (".urdf",)
    is_description = True
    title = "URDF"
    up = "z"
    holds = base.BODY_FEATURES | {
        *(FeatureKind.NON_CONVEX, FeatureKind.JOINTS, FeatureKind.FIXED_JOINTS, FeatureKind.SPEEDS, FeatureKind.MIMICS)
    }
    instead: ClassVar[Mapping[FeatureKind, str]] = {
        FeatureKind.CAPSULES: "written as triangles",
        FeatureKind.ELLIPSOIDS: "written as triangles",
        FeatureKind.BALL_JOINTS: "written as three joints that turn about one point",
    }
    shown_files = VISUAL_SUFFIXES
    has_capsules: ClassVar[bool] = False

    def read(self, path: Path, options: base.ReadOptions) -> Asset:
        from meshforge.formats.urdf import read  # lazy: only URDF needs it

        return read.read_urdf(path, options)

    def write(self, asset: Asset, name: str, mass: base.Mass = "keep") -> base.Output:
        if not isinstance(asset.document, UrdfDocument):
            raise AssetError("this asset was not read from a URDF", where=str(asset.path))
        from meshforge.formats.urdf import edit  # lazy: only URDF needs it

        return edit.write_urdf(asset, asset.document, name, capsules=self.has_capsules)

    def create(self, asset: Asset, name: str) -> base.Output:
        from meshforge.formats.urdf import create  # lazy: only URDF needs it

        return create.create_urdf(asset, name, capsules=self.has_capsules)

    def features(self, asset: Asset) -> Iterator[Feature]:
        if isinstance(asset.document, UrdfDocument):
            data = XmlText.of(asset.document.source).data
            others = [*base.list_others(parse_robot(data, ""), _TAKEN, _LEAVES), *["comment"] * data.count(b"<!--")]
            yield base.feature_of_others(others)


class UrdfWithCapsules(UrdfFormat):
    """URDF with `<capsule>`, which not all readers know."""

    has_capsules = True
    holds = UrdfFormat.holds | {FeatureKind.CAPSULES}
    instead: ClassVar[Mapping[FeatureKind, str]] = {
        kind: text for kind, text in UrdfFormat.instead.items() if kind is not FeatureKind.CAPSULES
    }
