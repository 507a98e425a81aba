"""Layers as bytes: text, crate or package, the same for the same layer."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

CRATE = b"PXR-USDC"


def is_crate(data: bytes) -> bool:
    """Whether bytes are a layer in the binary form."""
    return data.startswith(CRATE)


def layer_bytes(layer: Any, *, crate: bool) -> bytes:
    """A layer as a file of its own."""
    if not crate:
        text: str = layer.ExportToString()
        return text.encode()
    with tempfile.TemporaryDirectory(prefix="meshforge-") as folder:
        path = Path(folder) / "layer.usdc"
        layer.Export(str(path))
        return path.read_bytes()


def wants_crate(suffix: str, source: bytes | None) -> bool:
    """Whether a file of a suffix is binary; `.usd` is what its source was, and binary where it is new."""
    if suffix == ".usd":
        return source is None or is_crate(source)
    return suffix != ".usda"
