"""Learns the metric of propagation anew, on all families of the calibration set, and writes it where it ships."""

from __future__ import annotations

import json
from pathlib import Path

from benchmark.assets import CATEGORIES, SEPARATE, family
from benchmark.labels.metric import fit_metric, rows_of
from meshforge.common import write_atomically
from meshforge.labels.propagation import propagate

_ABOUT = "made by `python -m benchmark.labels` on the calibration set of the benchmark"


def main() -> None:
    """Write the file."""
    weights = fit_metric([rows_of(family(name, setting, True)) for name in CATEGORIES for setting in SEPARATE])
    data = {"about": _ABOUT, "weights": [round(float(weight), 4) for weight in weights]}
    write_atomically(Path(propagate.__file__).parent / propagate.METRIC_FILE, json.dumps(data, indent=1) + "\n")


if __name__ == "__main__":
    main()
