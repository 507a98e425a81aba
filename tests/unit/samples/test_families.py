"""The families that `meshforge samples` writes: whole, legal, the same each time; one program is right for each."""

import re
from functools import cache
from pathlib import Path

import pytest

from meshforge.checks import check
from meshforge.common import UsageError
from meshforge.formats import load
from meshforge.language import Program
from meshforge.samples import FAMILIES, family_of, write_family
from meshforge.symbolic import SymbolicMesh
from script.families.__main__ import BUILDERS
from script.families.cups import list_cups

pytestmark = pytest.mark.slow
BUILT = ("bottles", "cups", "chairs")
NAMES = tuple(family.name for family in FAMILIES)
CUPS = Program.parse(
    "labels base, wall, handle, lid\n\n"
    "Is(base) => Merge\n"
    "Diff(Is(handle), Attach(Is(handle), Is(wall))) => Each(Replace(capsule, volume))\n"
)


@pytest.fixture(scope="module")
def root(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a folder of each family."""
    root = tmp_path_factory.mktemp("families")
    for family in FAMILIES:
        write_family(family, root / family.name)
    return root


@cache
def meshes(root: Path, name: str) -> dict[str, SymbolicMesh]:
    """The assets of a family by their names."""
    paths = sorted((root / name).glob(family_of(name).pattern))
    return {path.parent.name if path.stem == "model" else path.stem: load(path) for path in paths}


@pytest.mark.parametrize("name", NAMES)
def test_a_family_is_what_its_line_says(root: Path, name: str) -> None:
    found = meshes(root, name)
    hulls = [len(mesh.hulls) for mesh in found.values()]
    said = [int(number) for number in re.findall(r"\d+", family_of(name).about)]
    assert said == [len(found), min(hulls), max(hulls)]


@pytest.mark.parametrize("name", NAMES)
def test_every_hull_is_labelled_and_nothing_is_left_out(root: Path, name: str) -> None:
    for mesh in meshes(root, name).values():
        assert mesh.asset is not None and mesh.asset.non_convex == ()
        assert {hull.source for hull in mesh.hulls} == {"file"}
    used = {hull.label for mesh in meshes(root, name).values() for hull in mesh.hulls}
    assert used == set(family_of(name).vocabulary)


@pytest.mark.parametrize("name", BUILT)
def test_every_hull_is_legal(root: Path, name: str) -> None:
    for mesh in meshes(root, name).values():
        assert [finding for finding in check(mesh) if finding.severity == "error"] == []


def test_the_program_selects_of_each_handle_what_is_between_its_ends(root: Path) -> None:
    for cup in list_cups():
        mesh = meshes(root, "cups")[cup.name]
        handle = iter([hull.name for hull in mesh.hulls if hull.label == "handle"])
        pieces = [[next(handle) for _ in range(ear.pieces)] for ear in cup.ears]
        grips = [own[1:] if ear.low is None else own[1:-1] for ear, own in zip(cup.ears, pieces, strict=True)]
        assert next(handle, None) is None
        base, grip = CUPS.run(mesh).trace
        assert list(base.selected) == [hull.name for hull in mesh.hulls if hull.label == "base"]
        assert sorted(grip.selected) == sorted(name for own in grips for name in own)
        assert len(grip.made) == sum(bool(own) for own in grips)


def test_what_a_killed_run_left_half_written_is_no_other_file(tmp_path: Path) -> None:
    family = family_of("tables")
    count, first = write_family(family, tmp_path), sorted(family.read())[0]
    (tmp_path / first).unlink()
    (tmp_path / f".{first}.a1b2c3d4.tmp").write_text("half")
    assert count > 1 and write_family(family, tmp_path) == 1
    assert not list(tmp_path.rglob("*.tmp"))
    (tmp_path / first).unlink()
    (tmp_path / ".other.a1b2c3d4.tmp").write_text("whose?")
    with pytest.raises(UsageError, match=r"this folder holds something else: \.other"):
        write_family(family, tmp_path)


@pytest.mark.parametrize("name", BUILT)
def test_the_files_that_ship_are_what_the_generators_make(name: str) -> None:
    assert BUILDERS[name]() == family_of(name).read()
