"""VRML 2.0, which CoACD writes, a shape a hull: read, and written back as it is; edits go to other formats."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from meshforge.asset import Asset
from meshforge.errors import AssetError
from meshforge.formats.base import Output
from meshforge.formats.meshfile import Soup, joined
from meshforge.formats.meshfile.vrml import parse_vrml
from meshforge.formats.plain.parts import Part
from meshforge.formats.plain.plain import Edit, PlainFormat


class Wrl(PlainFormat):
    """VRML files, to be read only."""

    name = "wrl"
    title = "VRML"
    suffixes = (".wrl",)
    writable = False

    def parse_soup(self, data: bytes, path: Path) -> Soup:
        return joined(parse_vrml(data, str(path)))

    def apply_edit(self, edit: Edit) -> bytes:
        raise _read_only(str(edit.path))

    def format_parts(self, parts: Sequence[Part]) -> bytes:
        raise _read_only(None)

    def create(self, asset: Asset, name: str) -> Output:
        raise _read_only(str(asset.path))


def _read_only(where: str | None) -> AssetError:
    return AssetError("VRML files are read, not written", where=where, remedy="Write an .obj, which keeps the names.")
