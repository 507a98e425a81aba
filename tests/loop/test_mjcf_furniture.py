"""The whole loop on real MJCF tables: four files, 9 to 49 hulls on 4 to 8 bodies, two demonstrations."""

from __future__ import annotations

import shutil
from fnmatch import fnmatch
from pathlib import Path

import pytest

from meshforge.formats import load, read
from tests.corpus_path import corpus
from tests.loop.command import meshforge_here as meshforge
from tests.loop.labels import write_labels
from tests.mjcf_models import Pair, compiled

# the bodies 0 to 3 or so are legs; what else there is belongs to the last one
TABLES = {
    "table_bjorkudden_0207": {"plate": "4_part4_[56789], 4_part4_10", "apron": "4_part4_[1234]", "joint": "?_part?_1"},
    "table_jokkmokk_0694": {"plate": "4_part4_0", "apron": "4_part4_[1234]"},
    "table_bjorkudden_0206": {"plate": "7_part7_0", "apron": "7_part7_*, [134]_part*"},
    "toy_table": {"plate": "4_part4_32", "apron": "4_part4_3[3456]", "joint": "4_part4_*"},
}
MADE = {"table_bjorkudden_0207": 1, "table_jokkmokk_0694": 0, "table_bjorkudden_0206": 0, "toy_table": 4}
PROGRAM = """\
labels plate, apron, leg, joint

Is(joint) => Delete
Is(leg)   => Each(Merge)
Is(plate) => Merge
"""


@pytest.fixture(scope="module")
def tables(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the assets, and a project that has learned from two of them and was applied to all."""
    folder = tmp_path_factory.mktemp("tables")
    for name, parts in TABLES.items():
        path = folder / "assets" / f"{name}.xml"
        source = corpus("tables_desks", "clvrai-furniture", "objects", path.name)
        shutil.copytree(source.with_suffix(""), path.with_suffix(""))
        shutil.copyfile(source, path)
        write_labels(path, labelled(path, parts), rest="leg")
    meshforge("new", "tables", "assets/*.xml", "--vocabulary", "plate,apron,leg,joint", cwd=folder)
    meshforge("label", "tables", "--with", "file", cwd=folder)
    for name, steps in SHOWN.items():
        meshforge("demonstrate", "tables", name, *steps, cwd=folder)
    meshforge("synthesize", "tables", cwd=folder)
    meshforge("apply", "tables", cwd=folder)
    return folder


SHOWN = {
    "toy_table.xml": (
        "4_part4/*_?, 4_part4/*_[12]?, 4_part4/*_3[01789], 4_part4/*_40 => Delete",
        "[0123]_part?/* => Each(Merge)",
        "4_part4/*_32 => Merge",
    ),
    "table_bjorkudden_0207.xml": (
        "[0123]_part?/*_1 => Delete",
        "[0123]_part?/*_0 => Each(Merge)",
        "4_part4/*_[56789], 4_part4/*_10 => Merge",
    ),
}


def labelled(path: Path, parts: dict[str, str]) -> dict[str, tuple[int, ...]]:
    """The hulls of each label, by patterns of the ends of their names; the first one that fits counts."""
    found: dict[str, list[int]] = {label: [] for label in parts}
    for k, geom in enumerate(read(path).geoms):
        fits = (label for label, ends in parts.items() if any(fnmatch(geom.name, f"*_{e}") for e in ends.split(", ")))
        if label := next(fits, None):
            found[label].append(k)
    return {label: tuple(hulls) for label, hulls in found.items()}


def test_two_tables_teach_the_program(tables: Path) -> None:
    assert (tables / "tables" / "program.mf").read_text() == PROGRAM


@pytest.mark.parametrize("name", TABLES)
def test_every_table_comes_back_with_one_plate_and_four_legs(tables: Path, name: str) -> None:
    after = load(tables / "tables" / "edited" / f"{name}.xml")
    count = {label: sum(hull.label == label for hull in after.hulls) for label in ("plate", "leg", "joint")}
    assert count == {"plate": 1, "leg": 4, "joint": 0}


@pytest.mark.parametrize("name", TABLES)
def test_mujoco_finds_all_else_of_an_edited_table_as_it_was(tables: Path, name: str) -> None:
    source, edited = tables / "assets" / f"{name}.xml", tables / "tables" / "edited" / f"{name}.xml"
    before, after = read(source), read(edited)
    old, new = ({geom.name for geom in asset.geoms} for asset in (before, after))
    made = [geom for geom in after.geoms if geom.name not in old]
    Pair(compiled(source), compiled(edited)).assert_same(removed=old - new, made=made)
    assert len(made) == MADE[name]
    model = compiled(edited)
    assert model.ngeom == compiled(source).ngeom - len(old) + len(after.geoms)
