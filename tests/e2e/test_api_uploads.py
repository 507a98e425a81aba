"""Files that a page sends: taken if they are right, thrown away with a message if not."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from meshforge.samples import TABLES
from tests.e2e.studio import Studio, ok, opened
from tests.studio_project import FEW, demo_project


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("uploads")


@pytest.fixture(scope="module")
def studio(folder: Path) -> Iterator[Studio]:
    with opened(folder, demo_project(folder, demonstrated=False, tables=FEW).folder) as found:
        found.settled()
        yield found


def test_assets_that_are_dropped_belong_to_the_project(studio: Studio, folder: Path) -> None:
    source = (TABLES / "table_01.obj").read_bytes()
    assert ok(studio.put("/api/assets", source, path="new/table_99.obj"))["names"] == ["new/table_99.obj"]
    assert not (folder / "assets" / "added").exists()
    with studio.page() as page:
        assert page.hello
        assert ok(studio.post("/api/assets"))["names"] == ["added/new/table_99.obj"]
        page.until(lambda e: e["kind"] == "cards" and e["cards"] and e["cards"][0]["asset"] == "added/new/table_99.obj")
    assert len(studio.settled()["cards"]) == len(FEW) + 1
    assert ok(studio.get("/api/asset", asset="added/new/table_99.obj"))["hulls"]
    studio.put("/api/assets", source, path="new/table_99.obj")
    again = studio.post("/api/assets")
    assert again.status_code == 400 and "that name already" in again.json()["message"]
    ok(studio.post("/api/undo"))
    assert len(studio.settled()["cards"]) == len(FEW)


ROBOT = "<robot name='r'><link name='a'><{0}><geometry><mesh filename='{1}'/></geometry></{0}></link></robot>"
MODEL = (
    "<mujoco><asset><mesh file='base.stl'/><mesh file='a/lid.stl'/></asset><worldbody><geom type='box' size='1 1 1'/>"
    "<geom type='mesh' mesh='base'/></worldbody></mujoco>"
)
CHAIR = (TABLES.parent / "chairs" / "child_chair.gltf").read_text()
LOST = "{} refers to {} not dropped: {}: drop the folder"
BAD = {
    "readme.txt": ("hello", "there is no asset among these files"),
    "r.urdf": (
        ROBOT.format("collision", "../../../../../assets/table_01.obj"),
        LOST.format("r.urdf", "1 file that was", "../../../../../assets/table_01.obj"),
    ),
    "seen.urdf": (ROBOT.format("visual", "v.stl"), LOST.format("seen.urdf", "1 file that was", "v.stl")),
    "m.xml": (MODEL, LOST.format("m.xml", "2 files that were", "base.stl, a/lid.stl")),
    "c.gltf": (CHAIR, LOST.format("c.gltf", "1 file that was", "child_chair.bin")),
}


@pytest.mark.parametrize("path", BAD)
def test_uploads_that_cannot_be_read_are_thrown_away_with_a_message(studio: Studio, path: str, folder: Path) -> None:
    text, message = BAD[path]
    studio.put("/api/assets", text.encode(), path=path)
    answer = studio.post("/api/assets")
    assert answer.status_code == 400, answer.text
    assert answer.json()["message"] == message and answer.json()["remedy"]
    assert not (folder / "assets" / "added").exists()
    assert not (folder / "project" / ".meshforge" / "studio" / "uploads").exists()
    assert len(studio.settled()["cards"]) == len(FEW)


def test_uploads_that_are_too_large_are_refused(studio: Studio) -> None:
    answer = studio.client.post("/api/edit", content=bytes(16 * 2**20 + 1))
    assert answer.status_code == 413
