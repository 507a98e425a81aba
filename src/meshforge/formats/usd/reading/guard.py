"""What is looked at before the library opens a file: bytes that would cost it more than the file is worth."""

from __future__ import annotations

from pathlib import Path


def refuse_harmful(path: Path) -> None:
    """Raise AssetError where a file plainly is damaged, or made to cost more than it holds."""
