"""VRML 2.0, which CoACD writes, a shape a hull: read, and written back as it is; edits go to other formats."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from meshforge.common import AssetError
from meshforge.formats.base import Output
from meshforge.formats.meshfile.surface import Soup, join_surfaces
from meshforge.formats.meshfile.vrml import parse_vrml
from meshforge.formats.plain.base import MeshFileEdit, PlainFormat
from meshforge.formats.plain.parts import MeshPart
from meshforge.symbolic import Asset


class WrlFormat(PlainFormat):
    """VRML files, to be read only."""

    name = "wrl"
    title = "VRML"
    suffixes = (".wrl",)
    writable = False

    def parse_soup(self, data: bytes, path: Path) -> Soup:
        return join_surfaces(parse_vrml(data, str(path)))

    def apply_edit(self, edit: MeshFileEdit) -> bytes:
        raise _read_only_error(str(edit.path))

    def format_parts(self, parts: Sequence[MeshPart]) -> bytes:
        raise _read_only_error(None)

    def create(self, asset: Asset, name: str) -> Output:
        raise _read_only_error(str(asset.path))


def _read_only_error(where: str | None) -> AssetError:
    return AssetError("VRML files are read, not written", where=where, remedy="Write an .obj, which keeps the names.")
