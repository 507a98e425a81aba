"""Pictures for labelling: every hull is seen and numbered, exactly as the pictures tell."""

import itertools
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.common import UsageError
from meshforge.formats import load
from meshforge.geometry import Box, Pose
from meshforge.rendering import LabelingPicture, draw_labeling_pictures, encode_png
from meshforge.rendering.labeling.picture import LabelingCanvas
from meshforge.rendering.labeling.subject import VIEW_WORDS, Arrangement, LabelingSubject
from meshforge.rendering.placement import LEAST_PIXELS
from meshforge.symbolic import Asset, Document, NonConvexPiece, Surface, SymbolicMesh
from tests.corpus_path import corpus
from tests.examples import examples
from tests.unit.rendering.scenes import box, hull, pixels, table

SMALL = 320


def mesh_of(*boxes: Box) -> SymbolicMesh:
    return SymbolicMesh(tuple(hull(f"h{k}", shape) for k, shape in enumerate(boxes)))


def scattered(count: int, seed: int = 0) -> SymbolicMesh:
    random = np.random.default_rng(seed)
    return mesh_of(*(box(random.uniform(-5, 5, 3).tolist(), random.uniform(0.3, 2, 3).tolist()) for _ in range(count)))


def nested(count: int) -> SymbolicMesh:
    return mesh_of(*(box((0, 0, 0), (1 - 0.15 * k,) * 3) for k in range(count)))


def block(side: int) -> SymbolicMesh:
    """Cubes that fill a larger one."""
    places = itertools.product(range(side), repeat=3)
    return mesh_of(*(box(place, (0.98, 0.98, 0.98)) for place in places))


def with_asset(mesh: SymbolicMesh, **parts: Any) -> SymbolicMesh:
    return SymbolicMesh(mesh.hulls, Asset(Path("a.urdf"), "urdf", (), (), Document(), **parts))


def surface_of(shape: Box, rgba: tuple[float, float, float, float] | None = None) -> Surface:
    return Surface(shape.vertices, shape.faces, rgba=rgba)


def in_place(taken: tuple[LabelingPicture, ...]) -> list[LabelingPicture]:
    return [shot for shot in taken if shot.name in VIEW_WORDS.values()]


def assert_all_shown(mesh: SymbolicMesh, wanted: set[str], taken: tuple[LabelingPicture, ...], unmet: int = 0) -> None:
    """Each wanted hull is numbered, and seen there but for `unmet` that no ray can meet; nothing else is numbered."""
    assert set().union(*(shot.numbered for shot in taken)) == wanted
    best = {name: max(shot.visible_pixels[name] for shot in taken if name in shot.numbered) for name in wanted}
    assert sum(count < LEAST_PIXELS for count in best.values()) <= unmet
    assert len({shot.name for shot in taken}) == len(taken)
    assert all(list(shot.visible_pixels) == [h.name for h in mesh.hulls] for shot in taken)


PLACES = st.tuples(*[st.integers(-2, 2)] * 3)
LENGTHS = st.tuples(*[st.sampled_from([0.02, 0.3, 1.0, 1.0, 3.0])] * 3)


@pytest.mark.slow
@examples(30)
@given(st.lists(st.tuples(PLACES, LENGTHS), min_size=1, max_size=9), st.data())
def test_each_wanted_hull_is_seen_and_numbered(parts: list[tuple[Any, Any]], data: st.DataObject) -> None:
    mesh = mesh_of(*(box(place, lengths) for place, lengths in parts))
    names = [h.name for h in mesh.hulls]
    wanted = data.draw(st.none() | st.sets(st.sampled_from(names), min_size=1))
    most = data.draw(st.integers(1, 6))
    taken = draw_labeling_pictures(mesh, hulls=wanted, most=most, size=SMALL)
    assert_all_shown(mesh, wanted or set(names), taken)
    assert 1 <= len(in_place(taken)) <= most


@pytest.mark.slow
@pytest.mark.parametrize(
    "mesh",
    [
        nested(5),
        mesh_of(*[box((0, 0, 0), (1, 1, 1))] * 4),
        mesh_of(box((0, 0, 0), (1, 1, 1)), box((0.2, 0.1, 0.5005), (0.001, 0.001, 0.001))),
        mesh_of(box((0, 0, 0), (1, 1, 1)), box((2, 2, 2), (1e-5, 1e-5, 1e-5))),
        mesh_of(box((0, 0, 0), (1, 1, 1e-9)), box((0, 0, 1), (1, 1e-9, 1))),
        block(4),
        scattered(150),
    ],
    ids=["nested", "in one place", "small", "very small", "flat", "block", "many"],
)
def test_odd_meshes_are_shown_whole(mesh: SymbolicMesh) -> None:
    assert_all_shown(mesh, set(mesh.index), draw_labeling_pictures(mesh, size=SMALL if len(mesh.hulls) < 64 else 1024))


def test_no_hulls_no_pictures() -> None:
    assert draw_labeling_pictures(SymbolicMesh(())) == ()
    assert draw_labeling_pictures(table(), hulls=()) == ()


def test_a_picture_of_a_cube_from_before_it_shows_as_many_pixels_as_it_has_room_for() -> None:
    canvas = LabelingCanvas(
        LabelingSubject(mesh_of(box((3, 4, 5), (2, 2, 2)), box((3, 6, 5), (1, 1, 1))), {0: 0, 1: 1}, "Z"), 512
    )
    shot = canvas.draw(Arrangement.in_place(canvas.subject), "front")
    side = 0.88 * min(canvas.drawing_size)
    assert shot.visible_pixels["h0"] == pytest.approx(side**2, abs=4 * side)
    assert shot.visible_pixels["h1"] == 0


@pytest.mark.slow
def test_what_can_be_seen_in_place_is_neither_moved_nor_taken_out() -> None:
    for mesh in (table(), scattered(8), mesh_of(box((0, 0, 0), (1, 2, 3)))):
        taken = draw_labeling_pictures(mesh, size=SMALL)
        assert in_place(taken) == list(taken)
        assert taken[0].name.endswith("above")


@pytest.mark.slow
def test_hidden_hulls_are_drawn_alone() -> None:
    names = [shot.name for shot in draw_labeling_pictures(nested(3), size=SMALL)]
    assert [name.split(" alone")[0] for name in names if "alone" in name] == ["hulls 1, 2", "hull 2"]


def test_a_hull_far_smaller_than_the_mesh_is_shown_from_close_up() -> None:
    mesh = mesh_of(box((0, 0, 0), (1, 1, 1)), box((0, 0, 0.502), (0.004, 0.004, 0.004)))
    taken = draw_labeling_pictures(mesh, size=512)
    (close,) = (shot for shot in taken if "close up of hull 1" in shot.name)
    assert close.visible_pixels["h1"] > 10 * max(shot.visible_pixels["h1"] for shot in taken if shot is not close)


def test_hulls_that_are_not_asked_for_are_pale_and_have_no_number() -> None:
    mesh = scattered(10)
    taken = draw_labeling_pictures(mesh, hulls={"h3"}, size=512)
    assert set().union(*(shot.numbered for shot in taken)) == {"h3"}
    picture = pixels(taken[0].marked)[60:-60]
    strong = (np.ptp(picture, axis=2) > 0.25).sum()
    assert 0 < strong <= taken[0].visible_pixels["h3"]
    assert sum(count > 0 for count in taken[0].visible_pixels.values()) > 1, "the others are there"


@pytest.mark.slow
def test_pictures_have_the_size_asked_for_and_the_same_bytes_every_time() -> None:
    first, second = (draw_labeling_pictures(nested(3), size=size) for size in (SMALL, SMALL))
    for one, other in zip(first, second, strict=True):
        assert one.marked.size == one.plain.size == (SMALL, SMALL)
        assert encode_png(one.marked) == encode_png(other.marked)
        assert encode_png(one.plain) == encode_png(other.plain)
        assert (one.name, one.visible_pixels, one.numbered) == (other.name, other.visible_pixels, other.numbered)


def test_the_plain_picture_shows_the_visual_mesh_in_its_colour_under_the_same_camera() -> None:
    shape = box((0, 0, 0), (1, 1, 1))
    glass = surface_of(box((0, 0, 0), (3, 3, 3)), (0.0, 0.0, 1.0, 0.0))
    mesh = with_asset(mesh_of(shape), visuals=(surface_of(shape, (0.8, 0.1, 0.1, 1.0)), glass))
    (shot, *_) = draw_labeling_pictures(mesh, size=SMALL)
    plain = pixels(shot.plain)
    red = (plain[..., 0] - plain[..., 1]) > 0.2
    assert red.sum() == pytest.approx(shot.visible_pixels["h0"], rel=0.02)
    assert not ((plain[..., 2] - plain[..., 0]) > 0.2).any(), "what is clear is not drawn"


@pytest.mark.slow
def test_collision_geometry_that_is_no_hull_is_drawn_faintly_and_is_in_the_plain_picture() -> None:
    shape = box((0, 0, 0), (1, 1, 1))
    beside = NonConvexPiece("beside", "body", "it is open", surface_of(box((1.5, 0, 0), (1, 1, 1))))
    (alone, *_), (shot, *_) = (
        draw_labeling_pictures(mesh_of(shape)),
        draw_labeling_pictures(with_asset(mesh_of(shape), non_convex=(beside,))),
    )
    assert shot.numbered == {"h0"}
    assert 0 < shot.visible_pixels["h0"] < alone.visible_pixels["h0"], "it is framed as well"
    drawn = (pixels(shot.plain).min(axis=2) < 0.97).sum()
    assert drawn > 1.7 * shot.visible_pixels["h0"]
    assert (pixels(shot.marked)[50:-40].min(axis=2) < 0.99).sum() > 1.7 * shot.visible_pixels["h0"]


def test_up_may_be_y() -> None:
    turn = Pose(np.array([[1.0, 0, 0], [0, 0, 1.0], [0, -1.0, 0]]), np.zeros(3))  # Z up to Y up
    lying = SymbolicMesh(tuple(h.move(turn) for h in table().hulls))
    for one, other in zip(
        draw_labeling_pictures(table(), size=SMALL), draw_labeling_pictures(lying, size=SMALL, up="Y"), strict=True
    ):
        assert one.name == other.name
        assert all(abs(count - other.visible_pixels[name]) <= 4 for name, count in one.visible_pixels.items())


def test_a_hull_that_is_not_there_is_named() -> None:
    with pytest.raises(UsageError, match="'lef'"):
        draw_labeling_pictures(table(), hulls={"left", "lef"})


@pytest.mark.slow
@pytest.mark.parametrize(
    ("path", "hidden"),
    [
        ("doors_cabinets/IsaacGymEnvs/sektion_cabinet_model/urdf/sektion_cabinet.urdf", "alone"),
        ("kettles_teapots/CoACD/python/out.obj", "alone, from the front right, above, close up"),
        ("tables_desks/clvrai-furniture/objects/toy_table.xml", "below"),
    ],
)
def test_every_hull_of_real_assets_is_found(path: str, hidden: str) -> None:
    mesh = load(corpus(path))
    taken = draw_labeling_pictures(mesh)
    assert_all_shown(mesh, set(mesh.index), taken)
    assert any(hidden in shot.name for shot in taken)
    assert len(taken) <= 8
