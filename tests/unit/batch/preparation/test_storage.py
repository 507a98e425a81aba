import json
from functools import partial
from pathlib import Path

import pytest

from meshforge.batch import (
    Preparation,
    cut_hull,
    decompose_asset,
    read_preparation,
    read_prepared,
    record_digest,
    write_preparation,
)
from meshforge.common import AssetError
from meshforge.formats import read
from tests.unit.batch.preparation.samples import VOXELS, stand
from tests.unit.deaths import deaths, needs_fork


def hulls(preparation: Preparation | None) -> dict[str, bytes]:
    """Every hull to the last bit."""
    found = preparation or Preparation()
    return {name: found.hulls[known].vertices.tobytes() for name, known in found.hull_digests.items()}


def test_a_preparation_comes_back_to_the_last_bit(tmp_path: Path) -> None:
    asset, preparation = stand(tmp_path)
    cut = cut_hull(asset, preparation, "frame/body#1", (0.1, 0.2, 0.3), (1, 2, 3))
    write_preparation(tmp_path / "p", cut)
    back = read_preparation(tmp_path / "p")
    assert back is not None and back.steps == cut.steps and hulls(back) == hulls(cut)
    again = tmp_path / "again"
    write_preparation(again, back)
    for name in ("preparation.json", "hulls.obj"):
        assert (again / name).read_bytes() == (tmp_path / "p" / name).read_bytes()


def test_the_record_tells_what_was_done_and_the_hulls_can_be_opened(tmp_path: Path) -> None:
    _, preparation = stand(tmp_path)
    write_preparation(tmp_path / "p", preparation)
    (step,) = json.loads((tmp_path / "p/preparation.json").read_text())["steps"]
    assert step["do"] == "decompose" and step["settings"]["method"] == "coacd" and step["settings"]["seed"] == 0
    assert set(step["software"]) == {"meshforge", "coacd"}
    assert [entry["what"] for entry in step["replaced"]] == ["frame/body", "cover"]
    opened = read(tmp_path / "p/hulls.obj")
    assert [geom.name for geom in opened.geoms] == list(preparation.hull_digests)


def test_an_asset_is_read_with_its_preparation_or_without_one(tmp_path: Path) -> None:
    asset, preparation = stand(tmp_path)
    assert len(read_prepared(asset.path, tmp_path / "p").geoms) == 1
    write_preparation(tmp_path / "p", preparation)
    assert len(read_prepared(asset.path, tmp_path / "p").geoms) == 5
    assert len(read_prepared(asset.path, None).geoms) == 1
    write_preparation(tmp_path / "p", Preparation())
    assert not (tmp_path / "p").exists() and record_digest(tmp_path / "p") is None
    assert len(read_prepared(asset.path, tmp_path / "p").geoms) == 1


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("", "this is no JSON (line 1, column "),
        ("{", "this is no JSON (line 1, column "),
        ("[" * 100_000, "this JSON is nested too deeply (line 1, column "),
        ("[]", "expected an object {...}, found []"),
        (
            '{"steps": [{"do": "guess"}]}',
            "the field steps[0].do: expected 'decompose', 'cut', 'rebuild', 'split' or 'divide', found",
        ),
        ('{"steps": 3}', "the field steps: expected a list [...], found 3"),
        ('{"hulls": []}', "the field steps is missing"),
    ],
)
def test_a_damaged_record_is_named(tmp_path: Path, text: str, problem: str) -> None:
    (tmp_path / "preparation.json").write_text(text)
    with pytest.raises(AssetError, match="damaged") as caught:
        read_preparation(tmp_path)
    assert caught.value.problem.startswith(f"this preparation is damaged: {problem}")
    assert "preparation.json" in caught.value.message and "--remove" in caught.value.message


def test_a_folder_in_the_place_of_a_record_is_to_be_taken_away_by_hand(tmp_path: Path) -> None:
    (tmp_path / "preparation.json").mkdir()
    for reach in (read_preparation, partial(write_preparation, preparation=Preparation())):
        with pytest.raises(AssetError, match=r"preparation\.json: .*\n  Take away by hand") as caught:
            reach(tmp_path)
        assert "prepare --remove" not in caught.value.message
    assert record_digest(tmp_path) == ""


def test_hulls_that_were_changed_or_are_gone_are_noticed(tmp_path: Path) -> None:
    _, preparation = stand(tmp_path)
    write_preparation(tmp_path / "p", preparation)
    file = tmp_path / "p/hulls.obj"
    file.write_text(file.read_text().replace("v 3.0", "v 3.1", 1))
    with pytest.raises(AssetError, match="is not in it as it was made"):
        read_preparation(tmp_path / "p")
    file.unlink()
    with pytest.raises(AssetError, match=r"hulls\.obj"):
        read_preparation(tmp_path / "p")


@pytest.mark.slow
@needs_fork
def test_a_killed_change_has_happened_or_not(tmp_path: Path) -> None:
    asset, first = stand(tmp_path)
    second = decompose_asset(asset, first, VOXELS, again=True).preparation
    assert hulls(first).keys() & hulls(second).keys() and hulls(first) != hulls(second)
    folder = tmp_path / "p"
    for before, after in ((Preparation(), first), (first, second), (second, first.with_only(()))):
        for _ in deaths(lambda: write_preparation(folder, after), removals=True, costly=True):  # noqa: B023  called at once
            assert hulls(read_preparation(folder)) in (hulls(before), hulls(after))
        assert hulls(read_preparation(folder)) == hulls(after)
        text = (folder / "hulls.obj").read_text() if after.steps else ""
        assert "@before" not in text
