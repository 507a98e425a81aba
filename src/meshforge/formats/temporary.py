"""Folders for what is read from memory by libraries that read files; they last as long as the process."""

from __future__ import annotations

import atexit
import shutil
import tempfile
from pathlib import Path


def make_folder() -> Path:
    """A new folder, removed when the process ends."""
    folder = Path(tempfile.mkdtemp(prefix="meshforge-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder
