from dataclasses import replace
from typing import Any

import manifold3d
import numpy as np
import pytest

from meshforge.common import GeometryError
from meshforge.geometry import (
    Floats,
    Ints,
    Polytope,
    SurfaceParts,
    convex_hull,
    decompose,
    decompose_by_parts,
    sample_surface,
    stack_parts,
)
from meshforge.geometry.decomposition import by_parts
from meshforge.geometry.decomposition.engines import CoacdSettings, EngineControl, VhacdSettings
from meshforge.geometry.decomposition.parts import join_small_parts
from meshforge.geometry.decomposition.triangles import cap_holes, clean_triangles
from meshforge.geometry.shape import volume_and_centroid
from meshforge.geometry.surface import heights_above, rises_above
from tests.soups import together

QUICK = CoacdSettings(threshold=0.3, resolution=200, mcts_iterations=20, mcts_nodes=8)
VOXELS = VhacdSettings(resolution=20_000, max_convex_hulls=6)
SQUARE = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])


def box(low: tuple[float, float, float], high: tuple[float, float, float]) -> tuple[Floats, Ints]:
    corners = np.array([[x, y, z] for z in (0, 1) for x, y in SQUARE])
    sides = [(0, 3, 2), (0, 2, 1), (4, 5, 6), (4, 6, 7)]
    for k in range(4):
        j = (k + 1) % 4
        sides += [(k, j, j + 4), (k, j + 4, k + 4)]
    return np.array(low) + corners * (np.array(high) - low), np.array(sides)


def stack(*boxes: tuple[Floats, Ints]) -> tuple[Floats, Ints, SurfaceParts]:
    """Boxes as one surface, each a part."""
    numbers = np.repeat(np.arange(len(boxes)), [len(own) for _, own in boxes])
    return (*together(*boxes), SurfaceParts(numbers, tuple("abcdefgh"[: len(boxes)])))


def welded_l() -> tuple[Floats, Ints, SurfaceParts]:
    """One closed L-shaped solid, whose two arms are parts with a planar boundary: neither of them is closed."""
    outline = [(0, 0), (1, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3), (0, 1)]
    lower, upper = [(0, 1, 7), (1, 4, 7), (1, 2, 4), (2, 3, 4)], [(7, 4, 6), (4, 5, 6)]
    vertices = np.array([(x, y, z) for z in (0.0, 1.0) for x, y in outline])
    faces, parts = [], []
    for part, triangles in enumerate((lower, upper)):
        for a, b, c in triangles:
            faces += [(c, b, a), (a + 8, b + 8, c + 8)]
            parts += [part, part]
    for k in range(8):
        j = (k + 1) % 8
        faces += [(k, j, j + 8), (k, j + 8, k + 8)]
        parts += [int(k in (4, 5, 6))] * 2
    return vertices, np.array(faces), SurfaceParts(np.array(parts), ("foot", "back"))


def cup() -> tuple[Floats, Ints, SurfaceParts]:
    """A box with a pocket from above, outside and inside in different groups, and a rim between them."""
    outer, inner = box((0, 0, 0), (4, 4, 4)), box((1, 1, 1), (3, 3, 4))
    vertices = np.concatenate([outer[0], inner[0]])
    kept = np.delete(np.arange(12), [2, 3])  # without the lids
    faces = [*outer[1][kept].tolist(), *(inner[1][kept][:, ::-1] + 8).tolist()]
    for k in range(4):
        j = (k + 1) % 4
        faces += [(k + 4, j + 4, j + 12), (k + 4, j + 12, k + 12)]
    return vertices, np.array(faces), SurfaceParts(np.repeat([0, 1, 0], [10, 10, 8]), ("glaze", "inside"))


@pytest.mark.parametrize("settings", [QUICK, VOXELS], ids=["coacd", "vhacd"])
@pytest.mark.parametrize("shape", ["boxes", "arms"])
def test_hulls_lie_within_that_of_their_part_and_cover_the_surface(
    settings: CoacdSettings | VhacdSettings, shape: str
) -> None:
    touching = stack(box((0, 0, 0), (4, 1, 1)), box((1, 1, 0), (2, 3, 1)), box((-2, 0, 0), (0, 1, 1)))
    vertices, faces, parts = touching if shape == "boxes" else welded_l()
    found = decompose_by_parts(vertices, faces, parts, settings, close=True)
    assert {one.part for one in found} == set(parts.numbers)
    for one in found:
        own = convex_hull(vertices[np.unique(faces[parts.of_face == one.part])])
        assert not rises_above(one.hull.vertices, own.vertices, own.faces, 1e-4)
    points, _ = sample_surface(vertices, faces, 500)
    assert np.min([heights_above(points, one.hull) for one in found], axis=0).max() < 0.06


def test_every_triangle_stays_in_one_part_and_a_lone_small_part_is_kept() -> None:
    vertices, faces, parts = stack(box((0, 0, 0), (4, 1, 1)), box((9, 9, 9), (9.001, 9.001, 9.001)))
    joined = join_small_parts(vertices, faces, parts)
    assert joined.of_face.tolist() == parts.of_face.tolist()


def test_a_part_of_two_triangles_joins_what_it_touches_and_a_note_says_so() -> None:
    vertices, faces = box((0, 0, 0), (1, 1, 1))
    notes: list[str] = []
    parts = SurfaceParts(np.array([1, 1] + [0] * 10), ("body", "decal"))
    assert set(join_small_parts(vertices, faces, parts, notes.append).of_face.tolist()) == {0}
    assert "decal" in notes[0]


def test_six_sides_of_a_box_that_are_groups_become_one_part() -> None:
    vertices, faces = box((0, 0, 0), (1, 1, 1))
    parts = SurfaceParts(np.repeat(np.arange(6), 2), tuple("abcdef"))
    (only,) = decompose_by_parts(vertices, faces, parts, QUICK, close=True)
    assert only.hull.volume == pytest.approx(1.0)


def test_the_inside_of_a_cup_is_no_part_of_its_own_so_the_cup_stays_hollow() -> None:
    vertices, faces, parts = cup()
    notes: list[str] = []
    joined = join_small_parts(vertices, faces, parts, notes.append)
    assert not joined.is_divided and "inside" in notes[0]


def test_each_part_is_decomposed_by_the_settings_as_they_are(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[CoacdSettings] = []

    def record(vertices: Floats, faces: Ints, settings: CoacdSettings, **more: Any) -> list[Polytope]:
        asked.append(settings)
        return decompose(vertices, faces, settings, **more)

    monkeypatch.setattr(by_parts, "decompose", record)
    vertices, faces, parts = stack(box((0, 0, 0), (4, 1, 1)), box((5, 0, 0), (6, 1, 1)))
    settings = CoacdSettings(threshold=0.2, resolution=200, max_convex_hull=5)
    decompose_by_parts(vertices, faces, parts, settings)
    assert asked == [settings] * 2


def test_a_flat_part_becomes_a_thin_sheet_and_a_line_is_left_out_with_a_note() -> None:
    vertices, faces, parts = stack(box((0, 0, 0), (1, 1, 1)), box((3, 0, 0), (4, 1, 0)), box((6, 0, 0), (7, 0, 0)))
    notes: list[str] = []
    found = decompose_by_parts(vertices, faces, parts, QUICK, close=True, note=notes.append)
    assert [one.part for one in found] == [0, 1] and found[1].hull.aabb.size[2] < 1e-3
    assert {"b: it is flat, so its hulls are thin sheets", "c: it has no area: left out"} <= set(notes)


def test_open_parts_and_one_of_a_single_triangle_are_decomposed() -> None:
    vertices, faces, parts = stack(box((0, 0, 0), (1, 1, 1)), box((2, 0, 0), (3, 1, 1)))
    kept = np.concatenate([np.arange(2, 12), [12]])  # the first without its bottom, one triangle of the second
    found = decompose_by_parts(vertices, faces[kept], parts.select(kept), QUICK, close=True)
    assert [one.part for one in found] == [0, 1]
    assert found[0].hull.volume == pytest.approx(1.0)


def test_parts_without_any_area_are_refused() -> None:
    vertices, faces, parts = stack(box((0, 0, 0), (1, 0, 0)), box((2, 0, 0), (3, 0, 0)))
    with pytest.raises(GeometryError, match="made no hull"):
        decompose_by_parts(vertices, faces, parts, QUICK)


def test_a_failure_names_the_part() -> None:
    vertices, faces, parts = stack(box((0, 0, 0), (1, 1, 1)), box((2, 0, 0), (3, 1, 1)))
    with pytest.raises(GeometryError, match="part a: no decomposition within"):
        decompose_by_parts(vertices, faces, parts, QUICK, control=EngineControl(timeout=0.0))


def test_parts_of_several_surfaces_stay_apart_though_names_repeat() -> None:
    one = SurfaceParts(np.array([0, 0]), ("leg",))
    assert stack_parts([one, one]).of_face.tolist() == [0, 0, 1, 1]
    assert stack_parts([one, one]).names == ("leg", "leg")


def jagged_bar() -> tuple[Floats, Ints, SurfaceParts]:
    """A closed bar, 3 by 1 by 1, of many triangles, in two halves whose boundary follows these."""
    mesh = manifold3d.Manifold.cube((3.0, 1.0, 1.0)).refine(7).to_mesh64()
    vertices, faces = np.asarray(mesh.vert_properties)[:, :3], np.asarray(mesh.tri_verts).astype(np.int64)
    return vertices, faces, SurfaceParts((vertices[faces].mean(axis=1)[:, 0] > 1.5).astype(np.int64), ("left", "right"))


def test_a_part_with_a_jagged_rim_is_closed_roughly_by_a_fan_where_its_edges_are_in_the_way() -> None:
    vertices, faces, parts = jagged_bar()
    for part in (0, 1):
        mesh = clean_triangles(vertices, faces[parts.of_face == part])
        assert mesh.open_edges
        assert cap_holes(mesh)[1] == 0, "no plane holds its rim"
        capped, holes = cap_holes(mesh, 0.3)
        assert (holes, capped.open_edges) == (1, 0)
        assert volume_and_centroid(capped.vertices, capped.faces)[0] == pytest.approx(1.5, rel=0.1)


@pytest.mark.parametrize("settings", [QUICK, replace(VOXELS, resolution=3000)], ids=["coacd", "vhacd"])
def test_parts_with_jagged_rims_are_decomposed_as_solids(settings: CoacdSettings | VhacdSettings) -> None:
    vertices, faces, parts = jagged_bar()
    notes = list[str]()
    found = decompose_by_parts(vertices, faces, parts, settings, note=notes.append)
    assert not any("open" in note for note in notes), notes
    for part in (0, 1):
        own = [one.hull for one in found if one.part == part]
        corners = vertices[faces[parts.of_face == part]].reshape(-1, 3)
        assert sum(hull.volume for hull in own) == pytest.approx(1.5, rel=0.2)
        around = convex_hull(corners)
        assert not any(rises_above(hull.vertices, around.vertices, around.faces, 1e-5) for hull in own)
