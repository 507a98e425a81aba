"""The format SDF as the registry has it: what it can hold, and what a file holds that no conversion takes."""

from collections.abc import Iterator
from pathlib import Path

from meshforge.common import AssetError
from meshforge.formats import base
from meshforge.formats.sdf.document import VISUAL_SUFFIXES, SdfDocument, is_main_file, parse_root
from meshforge.symbolic import Asset, Feature, FeatureKind

_TAKEN = ("world", "model", "link", "collision", "visual", "joint", "axis", "axis2", "dynamics", "material")
_LEAVES = (
    *("pose", "include", "inertial", "geometry", "parent", "child", "xyz", "limit", "damping", "friction", "mimic"),
    *("ambient", "diffuse", "transparency", "placement_frame"),
)


class SdfFormat(base.Format):
    """The Simulation Description Format, of Gazebo."""

    name = "sdf"
    suffixes = (".sdf",)
    is_description = True
    title = "SDF"
    up = "z"
    holds = base.BODY_FEATURES | {
        *(FeatureKind.CAPSULES, FeatureKind.ELLIPSOIDS, FeatureKind.NON_CONVEX, FeatureKind.PLANES),
        *(FeatureKind.JOINTS, FeatureKind.BALL_JOINTS, FeatureKind.FIXED_JOINTS, FeatureKind.SPEEDS),
        FeatureKind.MIMICS,
    }
    shown_files = VISUAL_SUFFIXES

    def is_main(self, path: Path) -> bool:
        return is_main_file(path)

    def read(self, path: Path, options: base.ReadOptions) -> Asset:
        from meshforge.formats.sdf import read  # lazy: only SDF needs it

        return read.read_sdf(path, options)

    def write(self, asset: Asset, name: str, mass: base.Mass = "keep") -> base.Output:
        if not isinstance(asset.document, SdfDocument):
            raise AssetError("this asset was not read from an SDF", where=str(asset.path))
        from meshforge.formats.sdf import edit  # lazy: only SDF needs it

        return edit.write_sdf(asset, asset.document, name, mass)

    def create(self, asset: Asset, name: str) -> base.Output:
        from meshforge.formats.sdf import create  # lazy: only SDF needs it

        return create.SdfCreator(asset, name).build_output()

    def features(self, asset: Asset) -> Iterator[Feature]:
        if isinstance(asset.document, SdfDocument):
            texts = [source.text.data for source in asset.document.sources]
            others = [tag for text in texts for tag in base.list_others(parse_root(text, "")[0], _TAKEN, _LEAVES)]
            yield base.feature_of_others([*others, *["comment"] * sum(text.count(b"<!--") for text in texts)])
