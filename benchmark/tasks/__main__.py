"""Tries tasks on their meshes: unedited, by the reference program, by the wrong one.

Usage: python -m benchmark.tasks NAME ... [--set SET] [--data FOLDER] [--calibration] [--picture FOLDER]
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from pathlib import Path
from time import perf_counter

from benchmark.assets import CATEGORIES, SETS, Sample
from benchmark.assets.pictures import upright
from benchmark.assets.storage import read
from benchmark.tasks import EditResult, Task, task, tasks
from meshforge.rendering import draw_before_after, make_contact_sheet, write_png


def main() -> None:
    """Try what is asked for."""
    parser = argparse.ArgumentParser(prog="python -m benchmark.tasks", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"such as {CATEGORIES[0]}-easy; default: all")
    parser.add_argument("--set", choices=SETS, default="separate", help="decomposed how; default: separate")
    parser.add_argument("--data", type=Path, help="assets made there by script/make-benchmark --out")
    parser.add_argument("--calibration", action="store_true", help="the meshes of the calibration set")
    parser.add_argument("--picture", type=Path, help="a folder for a picture of each task, before and after")
    given = parser.parse_args()
    for one in [task(name) for name in given.names] or tasks():
        settings = SETS[given.set]
        made = read(given.data, one.category) if given.data else one.samples(given.calibration, settings)
        rows = [row for row in made if row.setting in settings]
        tell_results(one, rows)
        if given.picture:
            picture(one, rows, given.picture / f"{one.name}.png")


def tell_results(one: Task, rows: Sequence[Sample]) -> None:
    """Tell how the meshes fare."""
    print(f"{one.name}: {one.says}")
    for about, made in (
        ("unedited", lambda row: EditResult(row.mesh)),
        ("reference", lambda row: one.run(one.program, row.mesh)),
        ("wrong", lambda row: one.run(one.wrong, row.mesh)),
    ):
        _tell_row(one, rows, about, made)
    simpler = sum(bool(one.impure(row)) for row in rows)
    print(f"  {simpler} of {len(rows)} meshes have hulls of several parts that matter")


def _tell_row(one: Task, rows: Sequence[Sample], about: str, made: Callable[[Sample], EditResult]) -> None:
    start, failures = perf_counter(), dict[str, str]()
    for row in rows:
        if why := one.failure(row, made(row)):
            failures[row.name] = why
    pure = [row for row in rows if not one.impure(row)]
    passed = sum(row.name not in failures for row in pure)
    ms = 1e3 * (perf_counter() - start) / max(len(rows), 1)
    print(f"  {about}: {len(rows) - len(failures)} of {len(rows)} pass, {passed} of {len(pure)} pure; {ms:.0f} ms each")
    for name, why in failures.items():
        impure = "" if any(row.name == name for row in pure) else " (impure)"
        print(f"      {name}{impure}: {why}")


def picture(one: Task, rows: Sequence[Sample], path: Path) -> None:
    """Write a sheet: each mesh before and after the reference program."""
    path.parent.mkdir(parents=True, exist_ok=True)
    images, titles = [], []
    for row in rows:
        edited = one.run(one.program, row.mesh)
        if edited.mesh:
            images.append(
                draw_before_after(
                    upright(row), upright(row, edited.mesh), size=(260, 260), vocabulary=one.program.labels
                )
            )
            titles.append(f"{row.name} {row.asset.kind}")
    write_png(path, make_contact_sheet(images, 3, titles))


if __name__ == "__main__":
    main()
