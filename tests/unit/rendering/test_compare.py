"""Pictures of edits, and sheets."""

from unittest.mock import patch

import numpy as np
import pytest
from PIL import Image

from meshforge.common import UsageError
from meshforge.rendering import (
    compare,
    draw_before_after,
    draw_changes,
    draw_difference,
    encode_png,
    label_colors,
    make_contact_sheet,
    render,
)
from meshforge.rendering.colors import CHANGED, KEPT, MADE, REMOVED, rgb
from meshforge.rendering.comparison import joint_bounds
from meshforge.symbolic import SymbolicMesh
from tests.id_buffer import render_id_buffer
from tests.unit.rendering.scenes import box, edited, hull, near, pixels, table

SIZE = (200, 150)


def test_what_stays_is_at_the_same_pixels_in_the_same_colours() -> None:
    for color_by in ("hull", "label"):
        first, second = (pixels(i) for i in compare(table(), edited(), size=SIZE, color_by=color_by))
        bounds = joint_bounds(table(), edited())
        knob = render_id_buffer(table(), size=SIZE, bounds=bounds) == 4
        assert knob.sum() > 20
        assert np.abs(first[knob] - second[knob]).max() < 0.05


def test_a_smaller_result_is_not_zoomed() -> None:
    only = SymbolicMesh(table().hulls[4:])
    _, after = compare(table(), only, size=SIZE, background="#FFFFFF")
    inked = (pixels(after).min(axis=2) < 0.6).mean()
    assert inked < 0.1


def test_before_and_after_stand_side_by_side_with_words_below() -> None:
    image = draw_before_after(table(), edited(), size=SIZE)
    assert image.width > 2 * SIZE[0]
    assert image.height > SIZE[1]
    assert pixels(image)[-20:].min() < 0.4


def row() -> SymbolicMesh:
    return SymbolicMesh(tuple(hull(name, box((x, 0, 0), (1, 1, 1))) for name, x in (("a", -2), ("b", 0), ("c", 2))))


def test_what_is_unchanged_keeps_the_colour_of_render_and_each_change_is_marked() -> None:
    before = row()
    wider = hull("b", box((0, 0, 0), (1.4, 1, 1)))
    after = SymbolicMesh((hull("new", box((-2, 0, 0), (1, 1, 1))), wider, before.hulls[2]))
    size = (300, 120)
    sheet = draw_changes(before, after, view="front", size=size)
    gap = (sheet.width - 2 * size[0]) // 3
    first, second = (pixels(sheet.crop((x, gap, x + size[0], gap + size[1]))) for x in (gap, 2 * gap + size[0]))
    drawn = pixels(render(before, views=("front",), size=size, legend=False, bounds=joint_bounds(before, after)))
    items = render_id_buffer(before, view="front", size=size, bounds=joint_bounds(before, after))
    inner = (np.arange(size[0]) > 225)[None] & (items == 2)
    assert inner.sum() > 1000
    assert np.abs(first - drawn)[inner].max() < 0.02
    assert np.abs(second - drawn)[inner].max() < 0.02
    assert near(second[60, 60], rgb(MADE))
    for panel, column, color in ((first, 60, REMOVED), (first, 150, CHANGED), (second, 150, CHANGED)):
        stripes = panel[45:75, column - 15 : column + 15].reshape(-1, 3)
        share = np.mean([near(one, rgb(color)) for one in stripes])
        assert 0.2 < share < 0.9, "stripes of the colour of the change"


def test_an_outline_surrounds_what_changed() -> None:
    before, after = row(), SymbolicMesh(row().hulls[1:])
    plain = draw_changes(before, before, size=SIZE, view="front")
    assert encode_png(plain) == encode_png(draw_changes(before, before, size=SIZE, view="front"))
    marked = pixels(draw_changes(before, after, size=SIZE, view="front"))
    outside = render_id_buffer(before, view="front", size=SIZE) < 0
    gap = (plain.width - 2 * SIZE[0]) // 3
    panel = marked[gap : gap + SIZE[1], gap : gap + SIZE[0]]
    red = (panel[..., 0] - panel[..., 2] > 0.5) & outside
    assert red.sum() > 60


def test_the_legend_of_changes_has_only_what_there_is() -> None:
    with patch("meshforge.rendering.comparison.make_contact_sheet") as made:
        draw_changes(table(), edited(), size=SIZE)
    legend = made.call_args.kwargs["colors"]
    colors = label_colors(["leg", "panel"])
    assert legend == {
        "removed 2": REMOVED,
        "made 1": MADE,
        "unchanged 3, in their own colours": "",
        "leg": colors["leg"],
    }


def test_made_hulls_are_green_kept_ones_grey_and_removed_ones_red() -> None:
    before = SymbolicMesh((hull("gone", box((-2, 0, 0), (1, 1, 1))), hull("kept", box((0, 0, 0), (1, 1, 1)))))
    after = SymbolicMesh((before.hulls[1], hull("gone~1", box((2, 0, 0), (1, 1, 1)))))
    picture = pixels(draw_difference(before, after, view="front", size=(300, 120)))
    row = picture[60]
    assert near(row[260], rgb(MADE))
    assert near(row[150], rgb(KEPT))
    red = row[30:60].mean(axis=0)
    assert red[0] - red[2] > 0.15
    assert near(red / red.max(), rgb(REMOVED), 0.8)


def test_differences_of_nothing_can_be_drawn() -> None:
    empty = SymbolicMesh(())
    for before, after in ((empty, empty), (table(), empty), (empty, table())):
        assert draw_difference(before, after, size=SIZE).size == SIZE
        assert [i.size for i in compare(before, after, size=SIZE)] == [SIZE, SIZE]


def test_differences_are_the_same_bytes_every_time() -> None:
    assert encode_png(draw_difference(table(), edited(), size=SIZE)) == encode_png(
        draw_difference(table(), edited(), size=SIZE)
    )


def test_a_sheet_holds_every_picture_and_title() -> None:
    colors = ["#ff0000", "#00ff00", "#0000ff"]
    made = make_contact_sheet([Image.new("RGB", (40, 30), c) for c in colors], columns=2, titles=["a", "b", "c"])
    found = pixels(made)
    for color in colors:
        assert (np.abs(found - rgb(color)).max(axis=2) < 0.01).sum() == 40 * 30
    assert made.width < 3 * 40
    assert made.height > 2 * 30


@pytest.mark.parametrize(("count", "titles"), [(0, []), (2, ["only one"])])
def test_a_sheet_needs_pictures_and_a_title_each(count: int, titles: list[str]) -> None:
    with pytest.raises(UsageError, match="sheet"):
        make_contact_sheet([Image.new("RGB", (4, 4))] * count, titles=titles)
