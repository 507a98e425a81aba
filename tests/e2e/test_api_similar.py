"""Look-alikes by the studio's interface: found in one asset and in all, and labelled by one edit that one undo takes
back."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from tests.e2e.legs import LEGS, four_legged
from tests.e2e.studio import Studio, ok, opened

FIRST, SECOND = "t0.obj", "t1.obj"


@pytest.fixture(scope="module")
def studio(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Studio]:
    """Four tables of a top and four legs."""
    folder = tmp_path_factory.mktemp("similar")
    with opened(folder, four_legged(folder, words=("top", "leg")).folder) as found:
        found.settled()
        ok(found.post("/api/similar/prepare"))
        yield found


def similar(studio: Studio, hull: str, assets: list[str] | None = None, step: int = 0) -> dict[str, list[str]]:
    """The hulls found, by asset."""
    request = {"hulls": [{"asset": FIRST, "hull": hull}], "assets": assets, "step": step}
    found: dict[str, Any] = ok(studio.post("/api/similar", request))
    assert found["unread"] == []
    return {row["asset"]: row["hulls"] for row in found["found"]}


def test_look_alikes_of_a_leg_are_the_legs(studio: Studio) -> None:
    assert similar(studio, "leg_b") == {FIRST: list(LEGS)}
    assert similar(studio, "leg_b", [SECOND]) == {FIRST: list(LEGS), SECOND: list(LEGS)}
    everywhere = similar(studio, "leg_b", [f"t{k}.obj" for k in range(4)])
    assert everywhere == {f"t{k}.obj": list(LEGS) for k in range(4)}


def test_what_a_person_labelled_otherwise_is_left_alone(studio: Studio) -> None:
    studio.edit("label", hulls={SECOND: ["leg_a"]}, label="top")
    assert "leg_a" not in similar(studio, "leg_b", [SECOND]).get(SECOND, [])
    assert similar(studio, "leg_b") == {FIRST: list(LEGS)}
    studio.undo_all()


def test_hulls_and_assets_that_are_not_there_are_refused(studio: Studio) -> None:
    for asset, hull in ((FIRST, "wing"), ("none.obj", "leg_a")):
        assert studio.post("/api/similar", {"hulls": [{"asset": asset, "hull": hull}]}).status_code == 404
