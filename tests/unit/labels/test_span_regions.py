"""What regions say about the labels of fine pieces, and about hulls that span parts."""

from collections.abc import Sequence

import numpy as np
import pytest

from meshforge.geometry import Aabb, Box, FinePiece, Floats, Polytope, cut
from meshforge.label_model import AssetPieces, SpanModel, SpanPosterior, piece_mesh
from meshforge.label_model.spans import weigh_solids
from meshforge.symbolic import Hull, Label, SymbolicMesh
from tests.unit.project.stools import PARTS, boxes, make_box

EVEN = np.full((2, 2), 0.5)


def stool(width: float, height: float, slices: int = 1, regions: bool = True) -> AssetPieces:
    """A stool whose legs are in so many pieces, which are of one region, or each of its own."""
    parts = boxes(width, height)
    mesh = SymbolicMesh(tuple(Hull(f"h{k}", "base", part) for k, part in enumerate(parts)))
    rows = [[parts[0]], *(slice_leg(leg, height, slices) for leg in parts[1:])]
    return pieces_of(mesh, rows if regions else [[piece] for own in rows for piece in own])


def pieces_of(mesh: SymbolicMesh, regions: Sequence[Sequence[Polytope]], apart: bool = False) -> AssetPieces:
    """Pieces by region; apart: each region is a solid by itself, else all are of one."""
    body = mesh.hulls[0].body
    rows = [FinePiece(shape, k, k if apart else 0) for k, own in enumerate(regions) for shape in own]
    return AssetPieces(mesh, piece_mesh({body: rows}, mesh))


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
    whole = infer(pieces_of(new.mesh, [pieces]))
    apart = infer(pieces_of(new.mesh, [[piece] for piece in pieces]))
    assert whole.labels == apart.labels
    assert whole.chances[2].argmax(axis=1).tolist() == [whole.labels.index("seat"), *[whole.labels.index("leg")] * 8]


@pytest.mark.parametrize(("regions", "chance"), [(1, 0.0), (2, 0.5)])
def test_labels_of_one_region_are_drawn_together(regions: int, chance: float) -> None:
    found = infer_halves(regions, one_part=0.0)
    assert found.chances_of(0)[0] == pytest.approx(chance, abs=0.06)
    assert found.shares_of(0)[0] == pytest.approx([0.5, 0.5])


@pytest.mark.parametrize(("one_part", "chance"), [(0.0, 0.5), (0.6, 0.2), (1.0, 0.0)])
def test_labels_of_a_solid_are_drawn_together_as_often_as_it_is_one_part(one_part: float, chance: float) -> None:
    assert infer_halves(2, one_part).chances_of(0)[0] == pytest.approx(chance, abs=0.06)


def test_pieces_of_a_solid_that_is_one_part_have_the_labels_of_its_mean() -> None:
    found = infer_halves(2, 0.5, np.array([[0.9, 0.1], [0.1, 0.9]]))
    assert found.chances[0] == pytest.approx(np.array([[0.7, 0.3], [0.3, 0.7]]))


def infer_halves(regions: int, one_part: float, chances: Floats = EVEN) -> SpanPosterior:
    """A hull of two halves in so many regions of one solid, which is so likely one part."""
    halves = [
        Box.of_bounds(Aabb(np.array([x, 0.0, 0.0]), np.array([x + 1, 1.0, 1.0]))).tessellate() for x in (0.0, 1.0)
    ]
    hull = Box.of_bounds(Aabb(np.zeros(3), np.array([2.0, 1.0, 1.0]))).tessellate()
    asset = pieces_of(SymbolicMesh((Hull("h", "b", hull),)), [halves] if regions == 1 else [[half] for half in halves])
    return SpanPosterior([asset], ("a", "b"), [chances], np.array([0.0, 1.0]), [np.array([one_part])])


@pytest.mark.parametrize(("apart", "least", "most"), [(True, 0.7, 1.0), (False, 0.0, 0.0)])
def test_how_often_a_solid_is_one_part_is_learned_from_labelled_assets(apart: bool, least: float, most: float) -> None:
    """Stools of which each leg is two regions of one solid, or all is one solid."""
    known = [_two_regions_a_leg(apart) for _ in range(3)]
    model = SpanModel(known)
    found = model.infer([Label(part) for _ in known for part in PARTS])
    legs = found.solids[0][1:] if apart else found.solids[0]
    assert least <= legs.min() <= legs.max() <= most


def _two_regions_a_leg(apart: bool) -> AssetPieces:
    parts = boxes(0.2, 0.4)
    mesh = SymbolicMesh(tuple(Hull(f"h{k}", "base", part) for k, part in enumerate(parts)))
    legs = [piece for leg in parts[1:] for piece in slice_leg(leg, 0.4, 2)]
    rows = [FinePiece(parts[0], 0, 0), *(FinePiece(p, 1 + k, 1 + k // 2 if apart else 0) for k, p in enumerate(legs))]
    return AssetPieces(mesh, piece_mesh({"base": rows}, mesh))


def test_a_solid_is_the_less_likely_one_part_the_more_the_labels_of_its_regions_differ() -> None:
    """A stool of a seat, and of legs of two regions each, of which the smaller one differs more and more surely."""
    asset = _two_regions_a_leg(True)
    found = list[Floats]()
    for chance in (0.98, 0.5, 0.3, 0.1, 0.02):
        chances = np.tile([0.02, 0.98], (9, 1))
        chances[1::2] = [1 - chance, chance]
        found.append(weigh_solids(asset, chances, 0.9))
    shares = np.bincount(asset.solid_of, weights=asset.volumes) / asset.volumes.sum()
    assert found[0] == pytest.approx(0.9 * (1 - shares))
    assert found[1] == pytest.approx(found[0])
    seats, legs = np.array(found)[:, 0], np.array(found)[1:, 1:]
    assert seats == pytest.approx(seats[0])
    assert (np.diff(legs, axis=0) < -0.01).all()
    assert legs[-1] == pytest.approx(np.full(4, 0.7025), abs=1e-3)


def test_labels_of_a_region_come_from_more_than_half_of_it() -> None:
    asset = stool(0.2, 0.4, 2)
    said = [Label("seat"), *[None, Label("leg")] * 4]
    assert [str(one and one.name) for one in asset.collect_labels(said)] == list(PARTS)
    sliver = [Label("seat"), *[Label("leg"), None] * 4]
    assert [one and one.name for one in asset.collect_labels(sliver)] == ["seat", None, None, None, None]


@pytest.mark.parametrize("order", [range(10), (9, *range(9)), (3, 9, 0, 1, 2, 4, 5, 6, 7, 8)])
def test_a_hull_of_exactly_nine_tenths_is_of_one_part_in_whatever_order_its_pieces_come(order: Sequence[int]) -> None:
    slabs = [make_box((0.1 * k + 0.05, 0, 0), (0.05, 0.5, 0.5)) for k in range(10)]
    mesh = SymbolicMesh((Hull("h", "base", make_box((0.5, 0, 0), (0.5, 0.5, 0.5))),))
    asset = pieces_of(mesh, [[slabs[k]] for k in order])
    chances = np.eye(2)[[int(k == 9) for k in order]]
    found = SpanPosterior([asset], ("leg", "seat"), [chances], np.array([0.0, 1.0]), [np.zeros(1)])
    assert found.chances_of(0)[0] < 0.01


def test_where_nothing_is_said_of_any_piece_no_hull_spans_parts() -> None:
    new = stool(0.19, 0.41)
    assert SpanModel([new]).infer([None] * len(new.mesh.hulls)).chances_of(0).tolist() == [0.0] * len(new.mesh.hulls)


@pytest.mark.parametrize(("apart", "spans"), [(True, True), (False, False)])
def test_a_hull_that_alone_has_a_solid_of_another_label_spans_parts_however_thin(apart: bool, spans: bool) -> None:
    """A seat with a leg that is a twentieth of it, a solid by itself or not; and a hull of the seat alone."""
    seat, leg = make_box((0, 0, 1), (1, 1, 0.1)), make_box((0, 0, 0.5), (0.1, 0.1, 0.5))
    mesh = SymbolicMesh((Hull("h", "b", make_box((0, 0, 0.55), (1, 1, 0.55))), Hull("seat", "b", seat)))
    asset = pieces_of(SymbolicMesh(mesh.hulls[:1]), [[seat], [leg]], apart)
    solids = np.zeros(2 if apart else 1)
    found = SpanPosterior([asset], ("leg", "seat"), [np.eye(2)[::-1]], np.array([0.0, 1.0]), [solids])
    assert (found.chances_of(0)[0] > 0.99) == spans
    beside = pieces_of(mesh, [[seat], [leg]], apart)
    found = SpanPosterior([beside], ("leg", "seat"), [np.eye(2)[::-1]], np.array([0.0, 1.0]), [solids])
    assert found.chances_of(0)[1] < 0.01
