"""Fits the model of labels anew and writes it where it ships: `metric`, the distance of hulls, on all families of the
calibration set, or `consensus FOLDER`, the weights of evidence, on that and on calibration families of 25 assets, which
`script/make-benchmark --calibration --count 25 --settings separate --out FOLDER` makes; it says first how good such
weights are on categories that they were not fitted on. `confidence` fits how sure a label of some chance is."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import Any

from benchmark.assets import CATEGORIES, SEPARATE, family
from benchmark.labels.confidence import fit_confidence
from benchmark.labels.consensus import draw_cases, fit_weights, try_on_other_fold
from benchmark.labels.metric import fit_metric, rows_of
from benchmark.labels.variety import FOLDS
from meshforge.common import write_atomically
from meshforge.label_model import consensus, posterior, table

_ABOUT = "made by `python -m benchmark.labels {}` on the calibration set of the benchmark"
_SEED = 0


def main() -> None:
    """Write one of the files."""
    parser = argparse.ArgumentParser(prog="python -m benchmark.labels", description=__doc__)
    parser.add_argument("what", choices=("metric", "consensus", "confidence"))
    parser.add_argument("folder", nargs="?", type=Path, help="the calibration families of 25 assets, for consensus")
    given = parser.parse_args()
    if given.what == "metric":
        weights = fit_metric([rows_of(family(name, setting, True)) for name in CATEGORIES for setting in SEPARATE])
        _write(table.METRIC_FILE, "metric", [round(float(weight), 4) for weight in weights])
    elif given.what == "confidence":
        _write(posterior.CONFIDENCE_FILE, "confidence", fit_confidence(print))
    elif given.folder:
        try_on_other_fold(given.folder, _SEED, print)
        rounds = fit_weights([one for fold in FOLDS for one in draw_cases(given.folder, fold, _SEED)])
        _write(consensus.WEIGHTS_FILE, "consensus FOLDER", [[round(float(one), 3) for one in row] for row in rounds])
    else:
        parser.error("consensus: say in which folder the families are")


def _write(file: str, command: str, weights: list[Any]) -> None:
    data = {"about": _ABOUT.format(command), "weights": weights}
    write_atomically(Path(consensus.__file__).parent / file, json.dumps(data, indent=1) + "\n")


if __name__ == "__main__":
    main()
