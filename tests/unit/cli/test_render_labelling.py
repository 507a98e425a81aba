"""`meshforge render --views labelling`: numbered pictures, on a sheet or one by one."""

from __future__ import annotations

from pathlib import Path

import pytest
from PIL import Image

from tests.unit.batch.families import write_table
from tests.unit.cli.in_process import Run


@pytest.fixture
def run(run: Run, tmp_path: Path) -> Run:
    """Runs the command line beside a table."""
    write_table(tmp_path / "table.obj", labels=False)
    return run


def test_a_file_becomes_a_sheet_of_numbered_and_plain_pictures(run: Run) -> None:
    told = run("render", "table.obj", "--views", "labelling", "-o", "table.png", "--size", "256x256")
    assert told.code == 0
    assert "table.png: 3 pictures" in told.err
    with Image.open("table.png") as sheet:
        assert sheet.width > 4 * 256
        assert 2 * 256 < sheet.height < 3 * 256


def test_a_folder_takes_the_pictures_one_by_one_and_again(run: Run) -> None:
    words = ("render", "table.obj", "--views", "labelling", "-o", "pictures/of-table", "--size", "256x256")
    for _ in range(2):
        assert run(*words).code == 0
        found = sorted(path.name for path in Path("pictures/of-table").iterdir())
        assert [name[:3] for name in found] == ["01-", "01-", "02-", "02-", "03-", "03-"]
        assert found[0] == found[1].replace(".png", "-plain.png")
    with Image.open(Path("pictures/of-table", found[1])) as picture:
        assert picture.size == (256, 256)


@pytest.mark.parametrize(
    ("words", "problem"),
    [
        (("--names",), "--names does not go with --views labelling"),
        (("--ghost",), "--ghost does not go with --views labelling"),
        (("--color-by", "label"), "--color-by does not go with --views labelling"),
        (("--size", "300x200"), "Give --size 300x300."),
        (("--size", "64x64"), "cannot be 64 pixels wide"),
        (("-o", "table.obj/pictures"), "table.obj"),
    ],
)
def test_what_cannot_be_is_one_message(run: Run, words: tuple[str, ...], problem: str) -> None:
    told = run("render", "table.obj", "--views", "labelling", "-o", "x.png", *words)
    assert told.code == 2
    assert told.err.startswith("error: ")
    assert problem in told.err
    assert not Path("x.png").exists()


def test_an_asset_without_hulls_says_how_to_get_some(run: Run) -> None:
    Path("flat.urdf").write_text('<robot name="r"><link name="a"/></robot>')
    told = run("render", "flat.urdf", "--views", "labelling", "-o", "x.png")
    assert told.code == 2
    assert "there are no hulls to be named" in told.err
