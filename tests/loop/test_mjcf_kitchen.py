"""The whole loop on real MJCF cups and a teapot: four files with includes, 13 to 42 hulls each, two demonstrations."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest

from meshforge.formats import load, read
from tests.corpus_path import corpus
from tests.loop.command import meshforge_here as meshforge
from tests.loop.labels import write_labels
from tests.mjcf_models import Pair, compiled

# by the number of a `contact` mesh; the visual mesh, which collides in these files, is the first hull of each
MUG: dict[str, tuple[int, ...]] = {"handle": (10, 11, 12, 13), "base": (5, 6, 8, 9)}
OBJECTS: dict[str, dict[str, tuple[int, ...]]] = {
    "cup": {"base": (8, 9, 10, 11)},
    "mug": MUG,
    "coffeemug": MUG,
    "teapot": {"handle": (14, 15), "base": (7, 9, 20, 21, 32, 33), "spout": (40,), "knob": (38,)},
}
SHOWN = {
    "mug": ("*contact[5689] => Merge", "*contact1[0123] => Merge"),
    "teapot": (
        "*contact[79], *contact2[01], *contact3[23] => Merge",
        "*contact1[45] => Merge",
        "*contact38 => Replace(sphere)",
    ),
}
PROGRAM = """\
labels visual, wall, base, handle, spout, knob

Is(base)   => Merge
Is(handle) => Merge
Is(knob)   => Replace(sphere)
"""


@pytest.fixture(scope="module")
def kitchen(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the assets, and a project that has learned from two of them and was applied to all."""
    folder = tmp_path_factory.mktemp("kitchen")
    home = folder / "assets" / "object_sim"
    for name, parts in OBJECTS.items():
        source = corpus("kettles_teapots" if name == "teapot" else "cups_mugs", "object_sim")
        shutil.copytree(source / name, home / name)
        shutil.copyfile(source / "common.xml", home / "common.xml")
        after_visual = {label: tuple(k + 1 for k in hulls) for label, hulls in parts.items()}
        write_labels(home / name / "object.xml", {"visual": (0,), **after_visual}, rest="wall")
    vocabulary = "visual,wall,base,handle,spout,knob"
    meshforge("new", "kitchen", "assets/*/*/object.xml", "--vocabulary", vocabulary, cwd=folder)
    meshforge("label", "kitchen", "--with", "file", cwd=folder)
    for name, steps in SHOWN.items():
        meshforge("demonstrate", "kitchen", f"object_sim/{name}/object.xml", *steps, cwd=folder)
    meshforge("synthesize", "kitchen", cwd=folder)
    meshforge("apply", "kitchen", cwd=folder)
    return folder


def source(kitchen: Path, name: str) -> Path:
    return kitchen / "assets" / "object_sim" / name / "object.xml"


def edited(kitchen: Path, name: str) -> Path:
    return kitchen / "kitchen" / "edited" / "object_sim" / name / "object.xml"


def test_a_mug_and_a_teapot_teach_the_program(kitchen: Path) -> None:
    assert (kitchen / "kitchen" / "program.mf").read_text() == PROGRAM


@pytest.mark.parametrize("name", OBJECTS)
def test_every_object_comes_back_with_one_base_and_one_handle(kitchen: Path, name: str) -> None:
    before, after = load(source(kitchen, name)), load(edited(kitchen, name))
    parts = OBJECTS[name]
    made = [hull.label for hull in after.hulls if hull.source == "edit"]
    assert made == [label for label in ("base", "handle", "knob") if label in parts]
    assert len(after.hulls) == len(before.hulls) - sum(len(parts[label or ""]) - 1 for label in made)


@pytest.mark.parametrize("name", OBJECTS)
def test_mujoco_finds_all_else_of_an_edited_object_as_it_was(kitchen: Path, name: str) -> None:
    before, after = read(source(kitchen, name)), read(edited(kitchen, name))
    kinds = {geom.name: geom.shape.kind for geom in before.geoms}
    made = [geom for geom in after.geoms if geom.shape.kind != kinds.get(geom.name)]  # one alone keeps its name
    new = {geom.name for geom in after.geoms}
    old = kinds.keys()
    models = compiled(before.path), compiled(after.path)
    Pair(*models).assert_same(removed=(old - new) | (old & {geom.name for geom in made}), made=made)
    assert models[1].ngeom == models[0].ngeom - len(old) + len(new)
    np.testing.assert_array_equal(models[1].body_mass, models[0].body_mass)


def test_files_that_several_objects_share_are_there_once_and_as_they_were(kitchen: Path) -> None:
    home = edited(kitchen, "mug").parent.parent
    assert (home / "common.xml").read_bytes() == (kitchen / "assets/object_sim/common.xml").read_bytes()
    assert len(list(home.rglob("*--*.obj"))) == 1 + 2 + 2 + 2  # an ellipsoid needs no file


def test_an_included_file_changes_where_its_geoms_do(kitchen: Path) -> None:
    body = edited(kitchen, "mug").with_name("body.xml")
    authored = source(kitchen, "mug").with_name("body.xml").read_text().splitlines()
    gone = [line for line in authored if line not in body.read_text().splitlines()]
    assert len(gone) == len(MUG["base"]) + len(MUG["handle"])
    assets = edited(kitchen, "mug").with_name("assets.xml")
    assert assets.read_bytes() == source(kitchen, "mug").with_name("assets.xml").read_bytes()
