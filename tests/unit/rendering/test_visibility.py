"""What rays see, against geometry. Pictures in which certain hulls can be seen."""

import numpy as np
import pytest

from meshforge.geometry import Capsule, Cylinder, Ellipsoid, Pose, Shape, Sphere
from meshforge.rendering import VIEWS, ThumbnailPixels, View, render_revealing, render_thumbnail
from meshforge.symbolic import SymbolicMesh
from tests.id_buffer import count_visible_pixels, render_id_buffer
from tests.unit.rendering.scenes import box, hull, table


@pytest.mark.parametrize(("view", "first"), [("front", 0), ("back", 1), ("iso", 0), ("iso-back", 1)])
def test_the_nearer_hull_hides_the_farther(view: View, first: int) -> None:
    mesh = SymbolicMesh((hull("front", box((0, -1, 0), (1, 0.2, 1))), hull("back", box((0, 1, 0), (1, 0.2, 1)))))
    items = render_id_buffer(mesh, view=view, size=(120, 90))
    counts = [int((items == k).sum()) for k in (0, 1)]
    assert counts[first] > counts[1 - first]
    if view in ("front", "back"):
        assert counts[1 - first] == 0


def test_a_hull_inside_another_is_never_seen() -> None:
    mesh = SymbolicMesh((hull("inner", box((0, 0, 0), (0.5, 0.5, 0.5))), hull("outer", box((0, 0, 0), (1, 1, 1)))))
    for view in VIEWS:
        assert count_visible_pixels(mesh, view=view)["inner"] == 0


def test_left_right_top_and_bottom_are_where_tools_have_them() -> None:
    sides: dict[View, tuple[int, int, int]] = {
        "right": (2, 0, 0),
        "left": (-2, 0, 0),
        "back": (0, 2, 0),
        "front": (0, -2, 0),
        "top": (0, 0, 2),
        "bottom": (0, 0, -2),
    }
    hulls = tuple(hull(name, box(at, (1, 1, 1))) for name, at in sides.items())
    for view in sides:
        items = render_id_buffer(SymbolicMesh(hulls), view=view, size=(90, 90))
        assert hulls[items[45, 45]].name == view
    front = render_id_buffer(SymbolicMesh(hulls), view="front", size=(90, 90))
    assert [hulls[front[45, x]].name for x in (10, 79)] == ["left", "right"]
    assert [hulls[front[y, 45]].name for y in (10, 79)] == ["top", "bottom"]


@pytest.mark.parametrize("view", [v for v in VIEWS if v.endswith(("above", "below"))])
def test_a_corner_is_seen_from_its_own_side(view: View) -> None:
    sides = {"left": (0, -1), "right": (0, 1), "front": (1, -1), "back": (1, 1), "below": (2, -1), "above": (2, 1)}
    at, opposite = [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]
    for side in view.split("-"):
        axis, sign = sides[side]
        at[axis], opposite[axis] = sign, -sign
    mesh = SymbolicMesh(
        (
            hull("far", box(opposite, (1, 1, 1))),
            hull("all", box((0, 0, 0), (3, 3, 3))),
            hull("near", box(at, (1.2, 1.2, 1.2))),
        )
    )
    seen = count_visible_pixels(mesh, view=view)
    assert seen["far"] == 0
    assert seen["all"] > seen["near"] > 0


@pytest.mark.parametrize(
    ("shape", "share"),
    [
        (Sphere(Pose.of_translation((3, 2, 1)), 0.5), np.pi / 4),
        (Cylinder(Pose.identity(), 0.5, 1.0), np.pi / 4),
        (Capsule(Pose.from_rpy((0, 0, 0), (0, np.pi / 2, 0)), 0.5, 0.5), (np.pi / 4 + 1) / 2),
        (Ellipsoid(Pose.identity(), np.array([0.5, 1.0, 0.25])), np.pi / 4),
    ],
)
def test_round_shapes_cover_as_much_of_their_frame_as_geometry_says(shape: Shape, share: float) -> None:
    mesh = SymbolicMesh((hull("it", shape),))
    seen = render_id_buffer(mesh, view="top", size=(400, 400)) == 0
    rows, columns = np.nonzero(seen)
    frame = (np.ptp(rows) + 1) * (np.ptp(columns) + 1)
    assert seen.sum() / frame == pytest.approx(share, rel=0.01)


def test_counts_of_pixels_are_those_of_the_buffer() -> None:
    mesh = table()
    items = render_id_buffer(mesh, size=(160, 120))
    counts = count_visible_pixels(mesh, size=(160, 120))
    assert counts == {h.name: int((items == k).sum()) for k, h in enumerate(mesh.hulls)}
    assert counts["left"] > counts["knob"] > 0


def test_nothing_is_seen_of_no_hulls() -> None:
    assert count_visible_pixels(SymbolicMesh(())) == {}
    assert (render_id_buffer(SymbolicMesh(()), size=(20, 10)) == -1).all()


SIZE = (160, 120)


def pixels_of(picture: ThumbnailPixels, place: int) -> int:
    """How many pixels show the hull in a place."""
    return int((picture[..., 0].astype(int) * 256 + picture[..., 1] == place + 1).sum())


def test_what_is_seen_from_the_usual_side_is_shown_from_there() -> None:
    mesh = table()
    names = [hull.name for hull in mesh.hulls][:1]
    assert np.array_equal(render_revealing(mesh, names, size=SIZE), render_thumbnail(mesh, size=SIZE))
    assert np.array_equal(render_revealing(mesh, ["unknown"], size=SIZE), render_thumbnail(mesh, size=SIZE))
    assert np.array_equal(render_revealing(mesh, [], size=SIZE), render_thumbnail(mesh, size=SIZE))


@pytest.mark.parametrize("at", [(0, -1, 0), (0, 1, 0), (-1, 0, 0), (1, 0, 0), (0, 0, -1)])
def test_what_a_wall_hides_is_shown_from_another_side(at: tuple[int, int, int]) -> None:
    aside = [0.8 * part for part in at]
    wall = hull("wall", box((0, 0, 0), [0.2 if part else 3.0 for part in at]))
    mesh = SymbolicMesh((wall, hull("button", box(aside, (0.4, 0.4, 0.4)))))
    picture = render_revealing(mesh, ["button"], size=SIZE)
    known = [render_thumbnail(mesh, size=SIZE, view="iso"), render_thumbnail(mesh, size=SIZE, view="iso", through=[1])]
    assert pixels_of(picture, 1) > 40
    if pixels_of(known[0], 1) < 40:
        assert not any(np.array_equal(picture, one) for one in known)  # another side, not through the wall


def test_what_is_hidden_from_every_side_is_seen_through_what_hides_it_half_of_the_pixels() -> None:
    mesh = SymbolicMesh((hull("outer", box((0, 0, 0), (1, 1, 1))), hull("inner", box((0, 0, 0), (0.5, 0.5, 0.5)))))
    picture, alone = render_revealing(mesh, ["inner"], size=SIZE), render_thumbnail(mesh, size=SIZE)
    assert pixels_of(alone, 1) == 0
    shown = pixels_of(picture, 1)
    assert shown > 300
    rows, columns = np.nonzero(picture[..., 1] == 2)
    assert set((rows + columns) % 2) == {0}
    area = (np.ptp(rows) + 1) * (np.ptp(columns) + 1)
    assert shown < 0.5 * area
    assert pixels_of(picture, 0) + shown == pixels_of(alone, 0)


def test_of_hulls_that_are_not_asked_for_nothing_changes() -> None:
    mesh = SymbolicMesh((
        hull("outer", box((0, 0, 0), (1, 1, 1))),
        hull("inner", box((0, 0, 0), (0.5, 0.5, 0.5))),
        hull("other", box((0, 0, 0), (0.4, 0.4, 0.4))),
    ))  # fmt: skip
    assert pixels_of(render_revealing(mesh, ["inner"], size=SIZE), 2) == 0
