"""The README word for word: its shell blocks in order in an empty folder, by the installed command, and what they make.

`meshforge samples` builds the families, so that nothing else is needed. Real bottles, cups and chairs have their own
tests beside this one.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

import meshforge
from meshforge.formats import load
from meshforge.samples import family_of
from meshforge.symbolic import SymbolicMesh
from tests.loop.command import meshforge_here
from tests.loop.engines import assert_engines_keep_masses, assert_engines_see_hulls
from tests.loop.readme import README, commands, parse_commands, read_blocks

NOT_RUN = "script/demo"
"""The first word of the block that is not run: a script of a clone, which has tests."""
SHOWN = ("bottles", "cups", "chairs")
"""The families of the walk-throughs, in the order in which the README prints their programs."""
CAPLESS = ("ampoule", "flask")
GRIPS = {"coarse_mug": 0, "tumbler": 0, "soup_cup": 2, "loving_cup": 3}
"""Handles that have a piece which does not touch the wall; other cups have one."""
LEGS = {"stool": 3, "bench": 6}
"""Other chairs have four."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder in which every command of the README was run that is to be run."""
    folder = tmp_path_factory.mktemp("readme")
    blocks = read_blocks("sh")
    run = [block for block in blocks if not block.startswith(NOT_RUN)]
    assert len(blocks) == len(run) + 1  # the first one alone is left out
    assert not parse_commands(blocks[0])
    for block in run:
        run_block(block, folder)
    for block in read_blocks("python"):
        subprocess.run([sys.executable, "-c", block], cwd=folder, env=environment(), check=True, timeout=300)
    return folder


def run_block(block: str, folder: Path) -> None:
    """Run a block in a shell that stops at the first command that fails; no question can be answered."""
    done = subprocess.run(
        ["bash", "-euo", "pipefail", "-c", block],
        cwd=folder,
        env=environment(),
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=900,
        check=False,
    )
    assert done.returncode == 0, f"{block}\n{done.stdout}\n{done.stderr}"
    assert "Traceback" not in done.stderr


def environment() -> dict[str, str]:
    """That of a person who installed what is tested here."""
    installed, source = Path(sys.executable).parent, Path(meshforge.__file__).parents[1]
    assert (installed / "meshforge").exists()
    path = os.pathsep.join([str(installed), os.environ["PATH"]])
    return {**os.environ, "PATH": path, "PYTHONPATH": str(source)}


def assets(family: str, folder: Path) -> list[Path]:
    """The files of a family, relative to their folder."""
    root = folder / "assets" / family
    return sorted(path.relative_to(root) for path in root.glob(family_of(family).pattern))


def name_of(asset: Path) -> str:
    return asset.parent.name or asset.stem


def both(family: str, asset: Path, folder: Path) -> tuple[Path, Path]:
    """The file of an asset, and that of what was made of it."""
    return folder / "assets" / family / asset, folder / family / "edited" / asset


def labels_of(mesh: SymbolicMesh, *, made: bool) -> list[str]:
    """The labels of the hulls that an edit made, or of those that it left."""
    return sorted(str(hull.label) for hull in mesh.hulls if (hull.source == "edit") is made)


def test_the_programs_learned_are_those_that_are_printed(folder: Path) -> None:
    printed = [block for block in read_blocks("") if block.startswith("Is(")]
    for family, rules in zip(SHOWN, printed, strict=True):
        head, learned = (folder / family / "program.mf").read_text().split("\n\n", 1)
        assert learned == rules
        assert sorted(head.removeprefix("labels ").split(", ")) == sorted(family_of(family).vocabulary)


@pytest.mark.parametrize("family", SHOWN)
def test_simcheck_finds_no_error_in_what_is_written(folder: Path, family: str) -> None:
    (words,) = commands("--second-opinion", README.parent / "docs" / "checks.md")
    found = meshforge_here(*(word.replace("cups", family) for word in words), "--json", cwd=folder).lines
    assert len(found) == len(assets(family, folder)) and all(one["simcheck"]["counts"]["error"] == 0 for one in found)


def test_a_project_is_made_as_samples_proposes_it(tmp_path: Path) -> None:
    told = [words for words in parse_commands("".join(read_blocks("sh"))) if words[0] == "new"]
    for family, words in zip(SHOWN, told, strict=True):
        after = meshforge_here("samples", family, f"assets/{family}", cwd=tmp_path).out
        assert parse_commands(after.splitlines()[-1].removeprefix("Next: ")) == [words]


def test_every_bottle_is_one_body_and_one_cap(folder: Path) -> None:
    for asset in assets("bottles", folder):
        after = load(both("bottles", asset, folder)[1])
        assert sorted(str(hull.label) for hull in after.hulls) == ["body", "cap"][: 2 - (name_of(asset) in CAPLESS)]
        caps = [hull for hull in after.hulls if hull.label == "cap"]
        assert all(len(hull.vertices) == 8 for hull in caps)


def test_every_cup_has_one_base_and_a_capsule_for_each_grip(folder: Path) -> None:
    for asset in assets("cups", folder):
        before, after = (load(path) for path in both("cups", asset, folder))
        several = sum(hull.label == "base" for hull in before.hulls) > 1
        grips = GRIPS.get(name_of(asset), 1)
        assert labels_of(after, made=True) == ["base"] * several + ["handle"] * grips
        assert sum(hull.label == "base" for hull in after.hulls) == 1
        walls = [sum(hull.label == "wall" for hull in mesh.hulls) for mesh in (before, after)]
        assert walls[0] == walls[1]


def test_every_chair_has_a_box_for_each_leg_and_one_back(folder: Path) -> None:
    for asset in assets("chairs", folder):
        before, after = (load(path) for path in both("chairs", asset, folder))
        backs = int(any(hull.label == "back" for hull in before.hulls))
        legs = [hull for hull in after.hulls if hull.label == "leg"]
        assert len(legs) == LEGS.get(name_of(asset), 4)
        assert all(len(hull.vertices) == 8 for hull in legs)
        assert sum(hull.label == "back" for hull in after.hulls) == backs
        rest = [
            sorted(str(hull.label) for hull in mesh.hulls if hull.label not in ("leg", "back"))
            for mesh in (before, after)
        ]
        assert rest[0] == rest[1]


def test_trimesh_mujoco_and_pybullet_load_the_edited_bottles(folder: Path) -> None:
    for asset in assets("bottles", folder):
        assert_engines_see_hulls(both("bottles", asset, folder)[1])


def test_mujoco_and_pybullet_load_the_edited_cups_with_the_masses_they_had(folder: Path) -> None:
    for asset in assets("cups", folder):
        assert_engines_keep_masses(*both("cups", asset, folder))


def test_diff_tells_what_became_of_a_bottle(folder: Path) -> None:
    words = ("diff", "assets/bottles/hand_soap.obj", "bottles/edited/hand_soap.obj", "--json")
    changes = meshforge_here(*words, cwd=folder).json
    assert changes["hulls"] == {"before": 12, "after": 2}
    for picture in ("shampoo.png", "hand_soap.png"):
        assert (folder / picture).read_bytes().startswith(b"\x89PNG")
