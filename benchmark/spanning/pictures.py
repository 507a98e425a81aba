"""The assets that gain the most and the least purity by the split, before and after, hulls in the colours of labels."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from benchmark.assets import Sample
from benchmark.assets.pictures import upright
from benchmark.report import Result
from benchmark.spanning.course import SplitHull, parts_of, split_some
from benchmark.spanning.family import BY_PIECES, name_part, split_hulls
from benchmark.spanning.sets import find_sample
from meshforge.rendering import draw_before_after, make_contact_sheet, write_png
from meshforge.symbolic import SymbolicMesh

_EACH = 3
_SIZE = (260, 220)
_FILES = {"splits": ("spanning.png", "assets"), "real_assets": ("spanning-real.png", "real assets")}
"""By the part of the page the picture of it, and what it shows."""
_CAPTION = (
    f"The {_EACH} {{}} that gain the most purity by the split and, below, the {_EACH} that gain the least: before, "
    "after. Hulls have the label that has most of them in true parts, parts of split hulls the one that is propagated"
)


def draw_splits(folder: Path, found: Sequence[Mapping[str, Any]]) -> str:
    """Draw them beside the results of the page; Markdown that shows them, empty where nothing was split yet."""
    lines = []
    for row in found:
        if row["part"] in _FILES and (chosen := choose_assets(Result.of_json(row).details)):
            name, shown = _FILES[row["part"]]
            _draw_assets(folder / name, chosen)
            caption = _CAPTION.format(shown)
            lines.append(f"![{caption}]({name})\n\n{caption}.\n")
    return "\n".join(lines)


def _draw_assets(path: Path, chosen: Sequence[Mapping[str, Any]]) -> None:
    """A sheet of assets before and after the split."""
    images = []
    for row in chosen:
        sample, after = _split(row)
        words = sorted({part.label for part in sample.asset.parts})
        images.append(draw_before_after(upright(sample), upright(sample, after), size=_SIZE, vocabulary=words))
    titles = [f"{row['asset']}, {row['set']}: {row['before']:.2f} to {row['after']:.2f}" for row in chosen]
    write_png(path, make_contact_sheet(images, _EACH, titles))


def choose_assets(details: Sequence[Mapping[str, Any]]) -> list[Mapping[str, Any]]:
    """Of the assets with spanning hulls those that gain the most purity, then those that gain the least."""
    rows = [row for row in details if row["labels"] == BY_PIECES]
    rows.sort(key=lambda row: (row["before"] - row["after"], row["asset"], row["set"]))
    return rows if len(rows) <= 2 * _EACH else [*rows[:_EACH], *rows[-_EACH:]]


def _split(row: Mapping[str, Any]) -> tuple[Sample, SymbolicMesh]:
    """An asset, and its mesh with the hulls split."""
    families = split_some([row["category"]], print, sets=[row["set"]])
    (family,) = [one for one in families if (one.setting, one.labelled) == (row["set"], row["labels"])]
    sample = find_sample(family.category, family.setting, row["asset"])
    hulls = [hull for hull in family.hulls if hull.asset == row["asset"]]
    return sample, split_hulls(sample, parts_of(hulls)).mesh.with_labels(_labels_of(sample, hulls))


def _labels_of(sample: Sample, rows: Sequence[SplitHull]) -> dict[str, str]:
    """The propagated labels of the parts of split hulls, by name."""
    return {
        name_part(sample, row.number, number): part.label
        for row in rows
        if row.is_split()
        for number, part in enumerate(row.parts)
    }
