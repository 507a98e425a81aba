"""Libraries that are loaded when they are first used, and folders for what those that read files read from memory."""

import atexit
import shutil
import tempfile
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import mujoco as mujoco
    import pxr as pxr
else:

    class _LazyLibrary:
        """Stands for a library, and for its modules."""

        def __init__(self, name: str) -> None:
            self._name = name

        def __getattr__(self, name: str) -> Any:
            try:
                found = getattr(import_module(self._name), name)
            except AttributeError:
                found = import_module(f"{self._name}.{name}")
            setattr(self, name, found)
            return found

    mujoco, pxr = _LazyLibrary("mujoco"), _LazyLibrary("pxr")  # 0.2 s, only MJCF needs it; 0.3 s, and optional


def make_folder() -> Path:
    """Return a new folder, removed when the process ends."""
    folder = Path(tempfile.mkdtemp(prefix="meshforge-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder
