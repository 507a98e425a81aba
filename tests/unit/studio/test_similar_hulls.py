"""Look-alikes in a family that is too large to be looked in whole."""

from functools import partial
from pathlib import Path

import pytest

from meshforge.studio import similar_hulls
from meshforge.studio.similar_hulls import SimilarHulls, choose_assets
from meshforge.studio.wire.requests import HullOfAsset, SimilarRequest
from meshforge.studio.workers import Workers
from tests.e2e.legs import four_legged


def test_some_are_chosen_evenly_and_those_that_come_first_always() -> None:
    assets = [f"{k}" for k in range(10)]
    assert choose_assets(("9",), assets, 4) == ("9", "0", "3", "6")
    assert choose_assets(("9",), assets, 20) == ("9", *assets[:9])


@pytest.mark.slow
def test_assets_that_are_passed_over_are_counted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    project = four_legged(tmp_path, words=("top", "leg"))
    first, *others = project.assets()
    workers = Workers(1)
    try:
        similar = SimilarHulls(workers)
        request = SimilarRequest(hulls=(HullOfAsset(asset=first, hull="leg_a"),), assets=(first, *others))
        assert similar.find(project, project.assets(), request).passed_over == 0
        monkeypatch.setattr(similar_hulls, "choose_assets", partial(choose_assets, most=2))
        found = similar.find(project, project.assets(), request)
        assert (found.passed_over, len(found.found)) == (2, 2)
        assert similar.find(project, project.assets(), request.model_copy(update={"assets": None})).passed_over == 0
    finally:
        workers.close()
