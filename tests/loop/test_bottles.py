"""The whole loop on real OBJ bottles: seven files, 1 to 7 hulls each, two demonstrations."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from tests.corpus_path import corpus
from tests.loop.command import meshforge_here as meshforge
from tests.loop.engines import assert_engines_see_hulls
from tests.loop.labels import write_labels
from tests.loop.readme import parse_commands

CAPS = {
    "bleach_cleanser": (2,),
    "blue_moon": (),
    "cleanser": (1, 2, 3),
    "conditioner": (),
    "magic_clean": (3, 4, 5, 6),
    "repellent": (1,),
    "shampoo": (),
}
COMMANDS = """
meshforge new bottles 'assets/*.obj' --vocabulary body,cap
meshforge label bottles --with file
meshforge demonstrate bottles magic_clean.obj 'convex_[012] => Merge' 'convex_[3456] => Replace(box)'
meshforge demonstrate bottles cleanser.obj    'convex_0 => Merge'     'convex_[123] => Replace(box)'
meshforge synthesize bottles
meshforge apply bottles
"""
PROGRAM = """\
labels body, cap

Is(body) => Merge
Is(cap)  => Replace(box)
"""


@pytest.fixture(scope="module")
def bottles(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the assets, and a project that has learned from two of them and was applied to all."""
    folder = tmp_path_factory.mktemp("bottles")
    (folder / "assets").mkdir()
    for name, cap in CAPS.items():
        path = folder / "assets" / f"{name}.obj"
        shutil.copyfile(corpus("soap_bottles", "pybullet-URDF-models", name, "collision.obj"), path)
        write_labels(path, {"cap": cap}, rest="body")
    for words in parse_commands(COMMANDS):
        meshforge(*words, cwd=folder)
    return folder


def test_two_bottles_teach_the_program(bottles: Path) -> None:
    assert (bottles / "bottles" / "program.mf").read_text() == PROGRAM


def test_a_bottle_of_one_hull_comes_back_byte_for_byte(bottles: Path) -> None:
    for name in ("blue_moon", "conditioner", "shampoo"):
        before, after = bottles / "assets" / f"{name}.obj", bottles / "bottles" / "edited" / f"{name}.obj"
        assert after.read_bytes() == before.read_bytes()


@pytest.mark.parametrize("name", list(CAPS))
def test_engines_and_trimesh_see_the_hulls_of_an_edited_bottle(bottles: Path, name: str) -> None:
    assert_engines_see_hulls(bottles / "bottles" / "edited" / f"{name}.obj")
