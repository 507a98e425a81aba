"""USD: stages as text, crate or package, with the physics schemas of OpenUSD."""

from __future__ import annotations

from typing import TYPE_CHECKING

from meshforge.common.exports import export_lazily

if TYPE_CHECKING:
    from meshforge.formats.usd.create import create_usd
    from meshforge.formats.usd.edit import write_usd
    from meshforge.formats.usd.features import features_of
    from meshforge.formats.usd.read import read_usd
    from meshforge.formats.usd.stage import UsdDocument
else:
    __getattr__ = export_lazily(__name__, __file__)

__all__ = [
    "UsdDocument",
    "create_usd",
    "features_of",
    "read_usd",
    "write_usd",
]
