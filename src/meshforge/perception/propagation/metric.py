"""What counts in telling parts apart: a weight for each column of `described`, learned on families of other assets."""

from __future__ import annotations

import json
from functools import cache
from importlib.resources import files

import numpy as np

from meshforge.geometry import Floats

FILE = "metric.json"


@cache
def weights() -> Floats:
    """The weights (columns,) of the distance between two rows, which is the weighted sum of their differences."""
    read = json.loads(files("meshforge.perception.propagation").joinpath(FILE).read_text("utf-8"))
    found = np.array(read["weights"], dtype=float)
    found.flags.writeable = False
    return found
