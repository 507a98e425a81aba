"""The format MJCF, as the registry has it."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import ClassVar, Literal

from meshforge.asset import Asset, Feature, What
from meshforge.errors import AssetError
from meshforge.formats.base import Format, Mass, Output, ReadOptions
from meshforge.formats.mjcf.document import MjcfDocument
from meshforge.formats.mjcf.features import COULD, HOLDS, features_of
from meshforge.formats.mjcf.making.create import create_mjcf
from meshforge.formats.mjcf.reading.read import read_mjcf
from meshforge.formats.mjcf.writing.copies import top
from meshforge.formats.mjcf.writing.write import write_mjcf

_ROOT = re.compile(r"[^<]*+(?:<(?>\?.*?\?>|!--.*?-->|![^-][^>]*>)[^<]*+)*+<([\w:.-]+)", re.S)
"""An XML text up to the tag of its first element."""


class MjcfFormat(Format):
    """MuJoCo's own format for models."""

    name: ClassVar[str] = "mjcf"
    suffixes: ClassVar[tuple[str, ...]] = (".xml", ".mjcf")
    is_description: ClassVar[bool] = True
    title: ClassVar[str] = "MJCF"
    up: ClassVar[Literal["y", "z"] | None] = "z"
    holds: ClassVar[frozenset[What]] = HOLDS
    could: ClassVar[frozenset[What]] = COULD
    instead: ClassVar[Mapping[What, str]] = {What.OPAQUE: "written as surfaces that do not collide"}

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
        return top(asset.document) if isinstance(asset.document, MjcfDocument) else super().top(asset)

    def features(self, asset: Asset) -> Iterable[Feature]:
        return features_of(asset.document) if isinstance(asset.document, MjcfDocument) else ()
