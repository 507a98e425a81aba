"""What is looked at before the library opens a file: bytes that would crash it, or cost more than they are worth."""

from __future__ import annotations

from meshforge.errors import AssetError
from meshforge.formats.usd.reading.guard.crate import CRATE, refuse_harmful_crate
from meshforge.formats.usd.reading.guard.package import PACKAGE, layers_of
from meshforge.formats.usd.reading.guard.remedy import REMEDY
from meshforge.formats.usd.reading.guard.text import TEXT, refuse_deep_text

__all__ = ["REMEDY", "TEXT", "refuse_harmful"]


def refuse_harmful(data: bytes, where: str) -> None:
    """Raise AssetError where the bytes of a layer or package plainly are damaged, or made to do harm."""
    if data.startswith(PACKAGE):
        for layer in layers_of(data, where):
            if layer.startswith(PACKAGE):
                raise AssetError("a package in a package is not read", where=where, remedy="Unpack it first.")
            refuse_harmful(layer, where)
    elif data.startswith(CRATE):
        refuse_harmful_crate(data, where)
    elif data.lstrip().startswith(TEXT):
        refuse_deep_text(data, where)
    else:
        raise AssetError("this is no USD file, neither text nor crate nor package", where=where, remedy=REMEDY)
