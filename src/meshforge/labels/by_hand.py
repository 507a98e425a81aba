"""Labels by hand: the command that gives them, for messages that propose it."""

from __future__ import annotations

import shlex
from collections.abc import Collection
from pathlib import Path

from meshforge.common import quote_path


def label_command(folder: Path, asset: str, hull: str, vocabulary: Collection[str]) -> str:
    """Return the command that labels a hull of an asset of the project in a folder, as one types it here; LABEL stands
    for its label, and without a vocabulary `a,b,c` for that."""
    quoted = shlex.quote(f"{hull}=LABEL")
    words = "" if vocabulary else " --vocabulary a,b,c"
    what = quoted if quoted.startswith("'") else f"'{quoted}'"
    return f"meshforge label {quote_path(folder)} {shlex.quote(asset)} {what}{words}"
