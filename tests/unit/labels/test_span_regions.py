"""What regions say about the labels of fine pieces, and about hulls that span parts."""

from __future__ import annotations

import numpy as np
import pytest

from meshforge.geometry import Aabb, Box, Polytope, cut
from meshforge.label_model import AssetPieces, SpanModel, SpanPosterior, piece_mesh
from meshforge.symbolic import Hull, Label, SymbolicMesh
from tests.unit.project.stools import PARTS, boxes


def stool(width: float, height: float, slices: int = 1, regions: bool = True) -> AssetPieces:
    """A stool whose legs are in so many pieces, which are of one region, or each of its own."""
    parts = boxes(width, height)
    mesh = SymbolicMesh(tuple(Hull(f"h{k}", "base", part) for k, part in enumerate(parts)))
    rows = [[parts[0]], *(slice_leg(leg, height, slices) for leg in parts[1:])]
    return AssetPieces(mesh, piece_mesh({"base": rows if regions else [[p] for own in rows for p in own]}, mesh))


def slice_leg(leg: Polytope, height: float, slices: int) -> list[Polytope]:
    found = list[Polytope]()
    for k in range(1, slices):
        below, above = cut(leg, np.array([0, 0, height * (k / slices) ** 3]), np.array([0.0, 0.0, 1.0]))
        assert below and above
        leg = above
        found.append(below)
    return [*found, leg]


def infer(new: AssetPieces) -> SpanPosterior:
    known = [stool(0.2, 0.4), stool(0.22, 0.45)]
    labels = [Label(part) for _ in known for part in PARTS]
    return SpanModel([*known, new]).infer([*labels, *[None] * len(new.mesh.hulls)])


def test_pieces_of_a_region_are_of_one_label_though_none_looks_like_its_whole() -> None:
    alone, together = (infer(stool(0.19, 0.41, 4, regions)) for regions in (False, True))
    leg = together.labels.index("leg")
    assert together.chances[2].shape == (17, 2) == alone.chances[2].shape
    assert together.chances[2][1:, leg].min() > alone.chances[2][1:, leg].min()
    assert together.chances[2][1:, leg].min() > 0.9
    assert together.chances[2].sum(axis=1) == pytest.approx(1.0)


def test_a_region_that_is_the_whole_asset_says_nothing() -> None:
    new = stool(0.19, 0.41, 2)
    pieces = [hull.shape.tessellate() for hull in new.pieces.hulls]
    whole = infer(AssetPieces(new.mesh, piece_mesh({"base": [pieces]}, new.mesh)))
    apart = infer(AssetPieces(new.mesh, piece_mesh({"base": [[piece] for piece in pieces]}, new.mesh)))
    assert whole.labels == apart.labels
    assert whole.chances[2].argmax(axis=1).tolist() == [whole.labels.index("seat"), *[whole.labels.index("leg")] * 8]


@pytest.mark.parametrize(("regions", "chance"), [(1, 0.0), (2, 0.5)])
def test_labels_of_one_region_are_drawn_together(regions: int, chance: float) -> None:
    halves = [
        Box.of_bounds(Aabb(np.array([x, 0.0, 0.0]), np.array([x + 1, 1.0, 1.0]))).tessellate() for x in (0.0, 1.0)
    ]
    hull = Box.of_bounds(Aabb(np.zeros(3), np.array([2.0, 1.0, 1.0]))).tessellate()
    mesh = SymbolicMesh((Hull("h", "b", hull),))
    asset = AssetPieces(mesh, piece_mesh({"b": [halves] if regions == 1 else [[half] for half in halves]}, mesh))
    posterior = SpanPosterior([asset], ("a", "b"), [np.full((2, 2), 0.5)], np.array([0.0, 1.0]))
    assert posterior.chances_of(0)[0] == pytest.approx(chance, abs=0.06)
    assert posterior.shares_of(0)[0] == pytest.approx([0.5, 0.5])


def test_labels_of_a_region_come_from_more_than_half_of_it() -> None:
    asset = stool(0.2, 0.4, 2)
    said = [Label("seat"), *[None, Label("leg")] * 4]
    assert [str(one and one.name) for one in asset.collect_labels(said)] == list(PARTS)
    sliver = [Label("seat"), *[Label("leg"), None] * 4]
    assert [one and one.name for one in asset.collect_labels(sliver)] == ["seat", None, None, None, None]
