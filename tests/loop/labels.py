"""Labels of real assets, by the position of a hull in its file; looked up in pictures of these assets."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path

from meshforge.formats import read


def write_labels(path: Path, parts: Mapping[str, tuple[int, ...]], rest: str) -> None:
    """Write the labels file beside an asset, in its short form; hulls that no part lists are `rest`."""
    of_hull = {k: label for label, hulls in parts.items() for k in hulls}
    labels = {geom.name: of_hull.get(k, rest) for k, geom in enumerate(read(path).geoms)}
    path.with_suffix(".labels.json").write_text(json.dumps({"hulls": labels}))
