"""The format MJCF as the registry has it, and what an MJCF can hold. Reading, writing and making files are imported
when they are asked for."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import ClassVar

from meshforge.common import AssetError
from meshforge.formats import mjcf
from meshforge.formats.base import BODY_FEATURES, SCENE_FEATURES, Format, Mass, Output, ReadOptions
from meshforge.symbolic import Asset, Feature, FeatureKind

_ROOT = re.compile(r"[^<]*+(?:<(?>\?.*?\?>|!--.*?-->|![^-][^>]*>)[^<]*+)*+<([\w:.-]+)", re.S)
"""An XML text up to the tag of its first element."""


class MjcfFormat(Format):
    """MuJoCo's own format for models."""

    name = "mjcf"
    suffixes = (".xml", ".mjcf")
    is_description = True
    title = "MJCF"
    up = "z"
    holds = BODY_FEATURES | {
        *(FeatureKind.CAPSULES, FeatureKind.ELLIPSOIDS, FeatureKind.PLANES, FeatureKind.JOINTS, FeatureKind.BALL_JOINTS)
    }
    could = SCENE_FEATURES | {
        *(FeatureKind.MIMICS, FeatureKind.PAIRS, FeatureKind.SITES, FeatureKind.SKINS, FeatureKind.KEYFRAMES),
        FeatureKind.COMMENTS,
    }
    instead: ClassVar[Mapping[FeatureKind, str]] = {FeatureKind.OPAQUE: "written as surfaces that do not collide"}

    def matches_head(self, head: bytes) -> bool:
        root = _ROOT.match(head.decode("utf-8", "replace").replace("\0", ""))
        return root is None or root[1].lower() == "mujoco"

    def read(self, path: Path, options: ReadOptions) -> Asset:
        return mjcf.read_mjcf(path)

    def write(self, asset: Asset, name: str, mass: Mass = "keep") -> Output:
        if not isinstance(asset.document, mjcf.MjcfDocument):
            raise AssetError("this asset was not read from an MJCF", where=str(asset.path))
        return mjcf.write_mjcf(asset, asset.document, name, mass)

    def create(self, asset: Asset, name: str) -> Output:
        return mjcf.create_mjcf(asset, name)

    def top(self, asset: Asset) -> Path:
        return mjcf.top_folder(asset.document) if isinstance(asset.document, mjcf.MjcfDocument) else super().top(asset)

    def features(self, asset: Asset) -> Iterable[Feature]:
        return mjcf.features_of(asset.document) if isinstance(asset.document, mjcf.MjcfDocument) else ()
