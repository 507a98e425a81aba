"""Pictures of meshes. Pictures as files."""

from base64 import b64decode
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from meshforge.common import UsageError
from meshforge.geometry import Aabb, Pose
from meshforge.rendering import VIEWS, View, encode_png, label_colors, render, to_data_url, write_picture, write_png
from meshforge.rendering.colors import COLOR_BY, SELECTED, rgb
from meshforge.symbolic import Asset, Document, Surface, SymbolicMesh
from tests.id_buffer import render_id_buffer
from tests.unit.rendering.scenes import box, hull, near, pixels, table

SMALL = (200, 150)


def bare(mesh: SymbolicMesh, **options: Any) -> Image.Image:
    return render(mesh, size=SMALL, legend=False, **options)


@pytest.mark.parametrize("size", [(160, 120), (321, 77), (64, 300)])
def test_a_picture_has_the_size_asked_for(size: tuple[int, int]) -> None:
    assert render(table(), size=size).size == size


@pytest.mark.slow
@pytest.mark.parametrize("color_by", COLOR_BY)
def test_several_views_share_the_size(color_by: str) -> None:
    image = render(table(), views=VIEWS, size=(480, 300), color_by=color_by, title="table")  # type: ignore[arg-type]
    assert image.size == (480, 300)


def test_the_same_mesh_gives_the_same_bytes() -> None:
    options: dict[str, Any] = {"color_by": "label", "names": True, "highlight": frozenset({"knob"}), "size": SMALL}
    assert encode_png(render(table(), **options)) == encode_png(render(table(), **options))


@pytest.mark.parametrize("view", VIEWS)
def test_each_hull_has_its_label_s_colour_where_the_rays_meet_it(view: View) -> None:
    mesh = table()
    colors = label_colors(["panel", "leg"])
    picture = pixels(bare(mesh, views=(view,), color_by="label", vocabulary=["panel", "leg"]))
    items = render_id_buffer(mesh, view=view, size=SMALL)
    assert len(np.unique(items)) > 3, "the ground, and several hulls"
    for k in np.unique(items[items >= 0]):
        label = mesh.hulls[k].label
        inside = _inside(items == k)
        if label and k != 3 and inside.any():  # hull 3 is hatched
            assert near(np.median(picture[inside], axis=0), rgb(colors[label])), (view, mesh.hulls[k].name)


def _inside(mask: np.ndarray[Any, np.dtype[np.bool_]]) -> np.ndarray[Any, np.dtype[np.bool_]]:
    """The pixels whose neighbours within two are all set: no line is drawn there."""
    out = mask.copy()
    for axis in (0, 1):
        for step in (-2, -1, 1, 2):
            out &= np.roll(mask, step, axis=axis)
    return out


def test_hulls_that_differ_in_name_differ_in_colour() -> None:
    mesh = table()
    picture, items = pixels(bare(mesh, views=("top",))), render_id_buffer(mesh, view="top", size=SMALL)
    left, right = (np.median(picture[_inside(items == k)], axis=0) for k in (0, 1))
    assert np.abs(left - right).max() > 0.15


def test_labels_in_the_vocabulary_keep_their_colours_whatever_else_the_mesh_has() -> None:
    vocabulary = ["misc", "panel", "leg"]
    only = SymbolicMesh(table().hulls[:2])
    whole = pixels(bare(table(), views=("top",), color_by="label", vocabulary=vocabulary))
    part = pixels(bare(only, views=("top",), color_by="label", vocabulary=vocabulary, bounds=table().aabb))
    at = (30, 60)  # on the left half of the top
    assert np.allclose(whole[at], part[at], atol=0.05)


def test_highlighted_hulls_are_strong_and_seen_through_what_hides_them() -> None:
    hidden = hull("inner", box((0, 0, 0), (0.2, 0.2, 0.2)))
    mesh = SymbolicMesh((hull("outer", box((0, 0, 0), (1, 1, 1))), hidden))
    plain = pixels(bare(mesh, views=("front",), highlight=frozenset()))
    picked = pixels(bare(mesh, views=("front",), highlight=frozenset({"inner"})))
    middle = (75, 100)
    assert np.ptp(plain[middle]) < 0.1, "pale without a selection"
    assert picked[middle][0] - picked[middle][1] > 0.15, "the strong colour shines through"
    shown = pixels(bare(mesh, views=("front",), highlight=frozenset({"outer"})))
    assert near(shown[middle], rgb(SELECTED))


def test_a_ghost_is_drawn_around_the_hulls_but_hides_none() -> None:
    mesh = SymbolicMesh((hull("core", box((0, 0, 0), (1, 1, 1)), "core"),))
    large = box((0, 0, 0), (1.6, 1.6, 1.6))
    ghost = (Surface(large.vertices, large.faces),)
    bounds = Aabb(np.full(3, -0.8), np.full(3, 0.8))
    options: dict[str, Any] = {"views": ("front",), "bounds": bounds, "color_by": "label"}
    without, through = (pixels(bare(mesh, ghost=g, **options)) for g in ((), ghost))
    beside, middle = (75, 47), (75, 100)
    assert np.abs(without[beside] - through[beside]).max() > 0.03
    assert near(through[middle], without[middle], 0.35)
    assert np.abs(through[middle] - without[middle]).max() > 0.01


def test_no_hulls_say_so() -> None:
    empty = pixels(bare(SymbolicMesh(())))
    assert empty.min() < 0.6, "words are written"
    assert empty[:40].min() > 0.9, "and nothing else"


def test_no_hulls_within_a_ghost_show_the_ghost() -> None:
    shape = box((0, 0, 0), (1, 1, 1))
    picture = pixels(bare(SymbolicMesh(()), ghost=(Surface(shape.vertices, shape.faces),)))
    assert picture[:40].min() < 0.9


@pytest.mark.parametrize(("scale", "offset"), [(1e-6, 0.0), (1e6, 0.0), (1.0, 1e6), (1e-3, 50.0)])
def test_size_and_place_of_the_coordinates_do_not_matter(scale: float, offset: float) -> None:
    mesh = table()
    moved = SymbolicMesh(
        tuple(hull(h.name, h.shape.transform(np.eye(3) * scale, np.full(3, offset)), h.label) for h in mesh.hulls)
    )
    for view in ("iso", "front"):
        usual, found = render_id_buffer(mesh, view=view, size=SMALL), render_id_buffer(moved, view=view, size=SMALL)
        assert (usual != found).mean() < 0.01
    assert bare(moved).size == SMALL


def test_shared_bounds_put_a_hull_at_the_same_pixels() -> None:
    whole = table()
    part = SymbolicMesh(whole.hulls[2:4])
    seen = render_id_buffer(whole, view="front", size=SMALL, bounds=whole.aabb)
    alone = render_id_buffer(part, view="front", size=SMALL, bounds=whole.aabb)
    both = seen == 2
    assert both.any()
    assert (alone[both] == 0).all()


def test_a_picture_without_background_is_transparent_and_opaque_in_the_right_places() -> None:
    image = bare(table(), background=None)
    assert image.mode == "RGBA"
    alpha = np.asarray(image)[..., 3]
    items = render_id_buffer(table(), size=SMALL)
    assert alpha[0, 0] == 0
    assert alpha[_inside(items >= 0)].min() > 240, "a ray may slip through a seam"


def test_numbers_are_written_on_the_hulls_that_are_seen() -> None:
    plain, numbered = pixels(bare(table(), views=("top",))), pixels(bare(table(), views=("top",), names=True))
    numbered = numbered[: len(plain)]  # below is a list of those that are hidden
    items = render_id_buffer(table(), view="top", size=SMALL)
    changed = np.abs(plain - numbered).max(axis=2) > 0.2
    assert {int(k) for k in np.unique(items[changed])} >= {0, 1, 4}


def test_legend_and_title_take_room_but_leave_the_drawing() -> None:
    with_words = pixels(
        render(table(), size=(400, 300), color_by="label", title="A table", vocabulary=["panel", "leg"])
    )
    foot = with_words[-24:]
    orange = np.abs(foot - rgb(label_colors(["panel"])["panel"])).max(axis=2) < 0.02
    assert orange.any()
    assert with_words[:24].min() < 0.5


def test_more_legend_than_fits_is_counted() -> None:
    names = [f"a rather long label number {k}" for k in range(60)]
    hulls = tuple(hull(n, box((k, 0, 0), (1, 1, 1)), n) for k, n in enumerate(names))
    assert render(SymbolicMesh(hulls), size=(300, 200), color_by="label").size == (300, 200)


def test_two_faces_in_one_plane_never_speckle() -> None:
    twins = SymbolicMesh((hull("a", box((0, 0, 0), (1, 1, 1))), hull("b", box((0, 0, 0), (1, 1, 1)))))
    for view in VIEWS:
        items = render_id_buffer(twins, view=view, size=SMALL)
        assert set(np.unique(items)) == {-1, 1}


@pytest.mark.slow
def test_up_can_be_y() -> None:
    mesh = table()
    turn = Pose(np.array([[1.0, 0, 0], [0, 0, 1.0], [0, -1.0, 0]]), np.zeros(3))  # Z up to Y up
    lying = SymbolicMesh(tuple(h.move(turn) for h in mesh.hulls))
    for view in VIEWS:
        upright, turned = (
            render_id_buffer(mesh, view=view, size=SMALL),
            render_id_buffer(lying, view=view, size=SMALL, up="Y"),
        )
        assert (upright != turned).mean() < 0.01


def test_a_mesh_of_a_y_up_file_stands_upright() -> None:
    mesh = table()
    file = Asset(Path("table.glb"), "gltf", (), (), Document(), up="y")
    of_file = SymbolicMesh(mesh.hulls, file)
    assert (render_id_buffer(of_file, size=SMALL) == render_id_buffer(mesh, size=SMALL, up="Y")).all()
    assert (render_id_buffer(of_file, size=SMALL, up="Z") == render_id_buffer(mesh, size=SMALL)).all()
    assert (pixels(bare(of_file)) == pixels(bare(mesh, up="Y"))).all()


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"views": ("side",)}, "no view 'side'"),
        ({"views": ()}, "needs a view"),
        ({"color_by": "mood"}, "'mood'"),
        ({"size": (4, 4)}, "4 by 4"),
        ({"size": (9000, 100)}, "9000 by 100"),
        ({"background": "plaid"}, "plaid"),
    ],
)
def test_wrong_arguments_are_named(options: dict[str, Any], words: str) -> None:
    with pytest.raises(UsageError, match=words):
        render(table(), **options)


def test_a_png_is_read_back_pixel_by_pixel(tmp_path: Path) -> None:
    image = render(table(), size=(80, 60), legend=False)
    write_png(tmp_path / "deep" / "picture.png", image)
    with Image.open(tmp_path / "deep" / "picture.png") as found:
        assert found.tobytes() == image.tobytes()


def test_a_webp_keeps_transparency_and_is_small() -> None:
    image = render(table(), size=(320, 240), legend=False, background=None)
    data = b64decode(to_data_url(image).removeprefix("data:image/webp;base64,"))
    with Image.open(BytesIO(data)) as found:
        assert found.convert("RGBA").getpixel((0, 0)) == (0, 0, 0, 0)
    assert len(data) < 30_000


def test_a_picture_that_cannot_be_written_is_a_usage_error(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(UsageError, match="cannot be written"):
        write_png(tmp_path / "file" / "picture.png", render(table(), size=(16, 16), legend=False))


@pytest.mark.parametrize(("name", "kind"), [("a.png", "PNG"), ("a.jpg", "JPEG"), ("a.JPEG", "JPEG")])
def test_a_picture_is_written_as_its_suffix_says(tmp_path: Path, name: str, kind: str) -> None:
    image = render(table(), size=(80, 60), background=None)
    write_picture(tmp_path / name, image)
    with Image.open(tmp_path / name) as found:
        assert (found.format, found.size) == (kind, (80, 60))
        white = found.convert("RGBA").getpixel((79, 0))
        assert white == ((0, 0, 0, 0) if kind == "PNG" else (255, 255, 255, 255))


@pytest.mark.parametrize(
    ("name", "problem"), [("a.gif", ".gif is no picture that can be written"), ("picture", "it has no suffix")]
)
def test_another_suffix_names_what_can_be_written(tmp_path: Path, name: str, problem: str) -> None:
    with pytest.raises(UsageError) as raised:
        write_picture(tmp_path / name, render(table(), size=(16, 16), legend=False))
    assert raised.value.problem == problem
    assert raised.value.remedy == "Pictures end in .png, .jpg, .jpeg."
    assert not any(tmp_path.iterdir())
