"""Families of real assets: their surfaces, labels and checks.

python -m benchmark.real add PATH --name NAME            prints the block of family.toml for a file of the corpus
python -m benchmark.real look FAMILY [ASSET ...] --out FOLDER [--pieces | --regions]   pictures to label by
python -m benchmark.real check FAMILY                    digests, labels everywhere, no geometry twice, eight assets
python -m benchmark.real record FAMILY                   writes the digests of the decompositions
python -m benchmark.real ceiling FAMILY [--out FOLDER]   how unedited meshes, the reference and wrong edits fare
python -m benchmark.real mutants FAMILY                  which nearly right programs its criteria let through
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from benchmark.real.ceiling import describe_mutants, describe_rows, draw_edits, judge_family
from benchmark.real.examination import find_faults
from benchmark.real.family import Family, describe_source, family
from benchmark.real.pictures import describe_piece, draw_pieces, draw_regions, order_pieces
from benchmark.real.regions import label_surface, read_regions
from benchmark.real.samples import find_changed_samples, record_digests
from benchmark.real.surface import read_surface
from benchmark.real.tasks import real_tasks
from meshforge.common import MeshForgeError


def main() -> None:
    """Do what is asked for."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmark.real", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    tasks = parser.add_subparsers(dest="do", required=True)
    add = tasks.add_parser("add", help="print the block of family.toml for files of the corpus")
    add.add_argument("path", help="below the corpus folder")
    add.add_argument("--name", required=True)
    add.add_argument("--wrapper", type=Path, help="a file whose text stands in for the path, which need not exist")
    look = tasks.add_parser("look", help="pictures of pieces and regions")
    look.add_argument("family")
    look.add_argument("assets", nargs="*", metavar="ASSET")
    look.add_argument("--out", type=Path, required=True)
    look.add_argument("--pieces", action="store_true", help="pieces only")
    look.add_argument("--regions", action="store_true", help="regions only")
    check = tasks.add_parser("check", help="digests, labels, geometry")
    check.add_argument("family")
    check.add_argument("--decompositions", action="store_true", help="also whether CoACD makes what was recorded")
    record = tasks.add_parser("record", help="write the digests of the decompositions")
    record.add_argument("family")
    ceiling = tasks.add_parser("ceiling", help="how unedited meshes, the reference and wrong edits fare")
    ceiling.add_argument("family")
    ceiling.add_argument("--out", type=Path, help="a folder for pictures before and after the reference's edit")
    mutants = tasks.add_parser("mutants", help="which nearly right programs the criteria let through")
    mutants.add_argument("family")
    given = parser.parse_args()
    try:
        sys.exit(_run(given))
    except MeshForgeError as error:
        sys.exit(error.message)


def _run(given: argparse.Namespace) -> int:
    if given.do == "add":
        wrapper = given.wrapper.read_text("utf-8") if given.wrapper else None
        print(describe_source(given.path, given.name, wrapper), end="")
        return 0
    one = family(given.family)
    if given.do == "look":
        _look(one, given.assets or one.names, given.out, given.pieces, given.regions)
        return 0
    if given.do == "record":
        print(record_digests(one))
        return 0
    if given.do == "ceiling":
        for line in describe_rows(list(judge_family(one.name))):
            print(line)
        for task, setting, samples in real_tasks([one.name]) if given.out else ():
            draw_edits(task, samples, given.out / f"{task.name}-{setting}.png")
        return 0
    if given.do == "mutants":
        for line in describe_mutants(one.name):
            print(line)
        return 0
    faults = find_faults(one)
    if given.decompositions:
        faults += [f"{name}: its hulls are not those that were recorded" for name in find_changed_samples(one)]
    for fault in faults:
        print(fault)
    print(f"{one.name}: {len(one.sources)} assets, {len(faults)} faults")
    return 1 if faults else 0


def _look(one: Family, names: Sequence[str], out: Path, pieces: bool, regions: bool) -> None:
    """Write PNG pictures and listings of assets."""
    out.mkdir(parents=True, exist_ok=True)
    for name in names:
        surface = read_surface(one.source(name))
        if not regions:
            draw_pieces(surface, out / f"{name}-pieces.png")
            listed = [f"{k} {describe_piece(surface, surface.pieces[p])}" for k, p in enumerate(order_pieces(surface))]
            (out / f"{name}-pieces.txt").write_text("\n".join(listed) + "\n", "utf-8")
            print(f"{name}: {len(listed)} pieces")
        if not pieces:
            patches = label_surface(surface, read_regions(one, name))
            draw_regions(patches, one.vocabulary, out / f"{name}-regions.png", name)


if __name__ == "__main__":
    main()
