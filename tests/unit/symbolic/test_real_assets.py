from __future__ import annotations

import pytest

from meshforge.checks import check
from meshforge.formats import load
from tests.corpus_path import corpus
from tests.nearest import distance_bracket

REAL = {
    "cups_mugs/pybullet-URDF-models": ("green_cup/model.urdf", "blue_cup/model.urdf"),
    "soap_bottles/pybullet-URDF-models": ("cleanser/model.urdf",),
}


@pytest.mark.slow
@pytest.mark.parametrize(("family", "asset"), [(family, asset) for family, assets in REAL.items() for asset in assets])
def test_contacts_of_a_real_asset_are_those_of_brute_force(family: str, asset: str) -> None:
    (path,) = sorted(corpus(family).rglob(asset))
    mesh = load(path)
    for i, a in enumerate(mesh.hulls):
        for j, b in enumerate(mesh.hulls[i + 1 :], i + 1):
            if (a.aabb.min - b.aabb.max).max() > mesh.contact_distance:
                assert (i, j) not in mesh.contacts
                continue
            below, above, _ = distance_bracket(a.shape, b.shape)
            assert ((i, j) in mesh.contacts) == (above <= mesh.contact_distance)
            assert above - below < 1e-6 * mesh.diagonal
    assert [finding for finding in check(mesh) if finding.severity == "error"] == []
