"""Where the real assets lie that some tests read; they are not part of this project."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

_ROOT = Path(os.environ.get("MESHFORGE_CORPUS") or Path(__file__).resolve().parents[2] / "shared" / "corpus")
ABSENT = "the corpus of real assets is not here (set MESHFORGE_CORPUS to its folder)"


def corpus(*parts: str) -> Path:
    """A file or folder of the corpus; skips the calling test, with the reason, where the corpus is absent."""
    if not _ROOT.is_dir():
        pytest.skip(ABSENT)
    return _ROOT.joinpath(*parts)
