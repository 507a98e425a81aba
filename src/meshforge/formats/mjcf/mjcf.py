"""The format MJCF, as the registry has it."""

from __future__ import annotations

from pathlib import Path
from typing import ClassVar

from meshforge.asset import Asset
from meshforge.formats.base import Format, Mass, Output, ReadOptions
from meshforge.formats.mjcf.read import read_mjcf


class MjcfFormat(Format):
    """MuJoCo's own format for models."""

    name: ClassVar[str] = "mjcf"
    suffixes: ClassVar[tuple[str, ...]] = (".xml", ".mjcf")

    def read(self, path: Path, options: ReadOptions) -> Asset:
        return read_mjcf(path)

    def write(self, asset: Asset, name: str, mass: Mass = "keep") -> Output:
        raise self._cannot_create(asset)
