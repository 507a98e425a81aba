"""The parts of a mesh by segmented points beside it."""

from __future__ import annotations

from pathlib import Path

import manifold3d
import numpy as np
import pytest

from meshforge.common import AssetError, UsageError
from meshforge.formats import SegmentationFile, decompose, read_parts
from meshforge.geometry import Aabb, Floats, Ints, SurfaceParts, VhacdSettings, sample_surface, separate_parts
from tests.mesh_files import obj

QUICK = VhacdSettings(resolution=3000, max_convex_hulls=4)
NAMES = ("panel", "leg")


def make_table() -> tuple[Floats, Ints, Ints]:
    """A panel on two legs, one solid, with the class of each of its faces."""
    panel = manifold3d.Manifold.cube((1.0, 0.4, 0.1), True)
    legs = [manifold3d.Manifold.cube((0.1, 0.4, 0.5), True).translate((x, 0, -0.25)) for x in (-0.4, 0.4)]
    mesh = (panel + legs[0] + legs[1]).refine_to_length(0.06).to_mesh64()
    vertices, faces = np.asarray(mesh.vert_properties)[:, :3], np.asarray(mesh.tri_verts).astype(np.int64)
    return vertices, faces, (vertices[faces].mean(axis=1)[:, 2] < -0.0501).astype(np.int64)


TABLE = make_table()
VERTICES, FACES, KINDS = TABLE
POINTS, PLACES = sample_surface(VERTICES, FACES, 4000)


@pytest.fixture
def mesh(tmp_path: Path) -> Path:
    path = tmp_path / "table.obj"
    path.write_bytes(obj((VERTICES, FACES)))
    return path


MIDDLES = np.repeat(VERTICES[FACES].mean(axis=1), 5, axis=0)
"""Points of which all near a triangle are of its class."""


def put(folder: Path, **arrays: object) -> Path:
    path = folder / "table.points.npz"
    np.savez(path, **arrays)  # type: ignore[arg-type]
    return path


def parts_of(path: Path, *notes: str, align: str = "check") -> SurfaceParts:
    told = list[str]()
    file = SegmentationFile(path, align=align)  # type: ignore[arg-type]
    (found,) = read_parts([(VERTICES, FACES)], file, note=told.append)
    assert [note for note in notes if not any(note in one for one in told)] == []
    assert len(told) == len(notes), told
    return found


def names_of(found: SurfaceParts) -> list[str]:
    return [found.names[k] for k in found.of_face]


TRUE = [NAMES[k] for k in KINDS]


def test_points_with_a_class_each_are_parts_leg_by_leg(tmp_path: Path) -> None:
    middles = VERTICES[FACES].mean(axis=1)
    found = parts_of(put(tmp_path, points=MIDDLES, labels=np.repeat(KINDS, 5), names=NAMES))
    assert names_of(found) == TRUE
    assert sorted(found.names[k] for k in found.numbers) == ["leg", "leg", "panel"], "each patch is a part of its own"
    for side in (middles[:, 0] > 0, middles[:, 0] < 0):
        assert len(np.unique(found.of_face[side & (KINDS == 1)])) == 1


def test_triangles_too_small_for_a_place_have_the_class_around_their_middle(tmp_path: Path) -> None:
    """A sheet of one part, and on it two rows of tiny triangles amid points of another."""
    square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float)
    tiny = np.array([[0, 0, 0], [1e-5, 0, 0], [0, 1e-5, 0]])
    at = np.array([[x, 0.5, 0.015] for x in np.linspace(0.3, 0.31, 20)])
    vertices = np.concatenate([square, *(tiny + place for place in at)])
    faces = np.array([[0, 1, 2], [0, 2, 3], *([4 + 3 * k, 5 + 3 * k, 6 + 3 * k] for k in range(20))])
    rng = np.random.default_rng(3)
    sheet = np.column_stack([rng.random((4000, 2)), np.zeros(4000)])
    points, labels = np.concatenate([sheet, np.repeat(at, 5, axis=0)]), np.repeat([0, 1], [4000, 100])
    path = put(tmp_path, points=points, labels=labels, names=("sheet", "crumb"))
    (found,) = read_parts([(vertices, faces)], SegmentationFile(path))
    assert names_of(found) == ["sheet"] * 2 + ["crumb"] * 20


def test_points_of_which_a_tenth_is_wrong_give_each_face_its_class(tmp_path: Path) -> None:
    rng = np.random.default_rng(0)
    kinds = np.where(rng.random(len(POINTS)) < 0.1, 1 - KINDS[PLACES], KINDS[PLACES])
    found = parts_of(put(tmp_path, points=POINTS, labels=kinds, names=NAMES))
    wrong = np.array(names_of(found)) != np.array(TRUE)
    level = np.abs(VERTICES[FACES].mean(axis=1)[:, 2] + 0.05) < 0.03
    assert not (wrong & ~level).any(), "only beside the joint may a face be of the neighbour"
    assert len(found.numbers) == 3, "no wrong point is a part"


def test_the_order_of_the_points_does_not_matter(tmp_path: Path) -> None:
    order = np.random.default_rng(1).permutation(len(POINTS))
    first = parts_of(put(tmp_path, points=POINTS, labels=KINDS[PLACES]))
    again = parts_of(put(tmp_path, points=POINTS[order], labels=KINDS[PLACES][order]))
    assert first.of_face.tobytes() == again.of_face.tobytes() and first.names == again.names


def test_what_has_no_class_or_is_far_from_all_points_is_the_rest(tmp_path: Path) -> None:
    path = put(tmp_path, points=POINTS, labels=np.where(KINDS[PLACES] == 1, 1, -1), names=NAMES)
    assert set(names_of(parts_of(path))) == {"rest", "leg"}
    near = (POINTS[:, 0] < 0) | (POINTS[:, 2] > -0.05) | (POINTS[:, 2] < -0.49)
    path = put(tmp_path, points=POINTS[near], labels=KINDS[PLACES][near], names=NAMES)
    found = np.array(names_of(parts_of(path, "of the surface is far from all labelled points")))
    right = VERTICES[FACES].mean(axis=1)
    assert set(found[(right[:, 0] > 0.3) & (np.abs(right[:, 2] + 0.3) < 0.1)]) == {"rest"}


def test_triangles_of_several_parts_go_to_the_one_with_most_and_that_is_told(tmp_path: Path) -> None:
    path = put(tmp_path, points=POINTS, labels=(POINTS[:, 0] * 50 % 2).astype(int), names=("even", "odd"))
    parts_of(path, "of the surface is in triangles that are mostly of another part, and goes with it")
    path = put(tmp_path, points=POINTS, labels=(POINTS[:, 0] > 0.003).astype(int), names=("left", "right"))
    found = np.array(names_of(parts_of(path)))
    middle = VERTICES[FACES].mean(axis=1)[:, 0]
    assert set(found[middle < -0.06]) == {"left"} and set(found[middle > 0.06]) == {"right"}


def test_points_that_another_tool_scaled_fit_by_their_box(tmp_path: Path) -> None:
    path = put(tmp_path, points=POINTS * 3 + 1, labels=KINDS[PLACES], names=NAMES)
    with pytest.raises(AssetError, match=r"They would fit with --align box\."):
        parts_of(path)
    assert names_of(parts_of(path, align="box")).count("leg") == pytest.approx(TRUE.count("leg"), rel=0.1)


def test_a_file_on_all_of_an_asset_fits_a_piece_of_it(tmp_path: Path) -> None:
    own = KINDS == 1
    path = put(tmp_path, points=POINTS, labels=KINDS[PLACES], names=NAMES)
    legs, far = (VERTICES, FACES[own]), Aabb.of_points(VERTICES)
    with pytest.raises(AssetError, match="do not lie where the asset does"):
        read_parts([legs], SegmentationFile(path))
    (found,) = read_parts([legs], SegmentationFile(path), beside=[far])
    assert names_of(found).count("leg") > 0.95 * own.sum()


def test_no_hull_crosses_the_boundary_and_hulls_are_called_by_their_class(mesh: Path, tmp_path: Path) -> None:
    put(tmp_path, points=MIDDLES, labels=np.repeat(KINDS, 5), names=NAMES)
    made = decompose(mesh, QUICK, by="labels", cache=False)
    assert {hull.name.rpartition("_")[0] for hull in made.hulls} == {"panel", "leg"}
    for hull in made.hulls:
        if hull.name.startswith("leg"):
            assert hull.shape.aabb.max[2] <= -0.05 + 1e-6 and hull.shape.aabb.size[0] < 0.11
        else:
            assert hull.shape.aabb.min[2] >= -0.05 - 1e-6


def test_labels_of_one_part_are_told(mesh: Path, tmp_path: Path) -> None:
    put(tmp_path, points=POINTS, labels=np.zeros(len(POINTS), dtype=int), names=("all",))
    made = decompose(mesh, QUICK, by="labels", cache=False)
    assert made.asset and "its labels say one part only (all): decomposed as a whole" in made.asset.notes


APART = "It may be turned, or of another asset. If it is right, say --align off."
WRONG = {
    "far": (
        {"points": POINTS + 5, "labels": KINDS[PLACES]},
        "its points do not lie where the asset does: they are in a box of 1 0.4 0.55 m around 5 5 4.78, the hulls in a "
        "box of 1 0.4 0.55 m around 0 0 -0.225",
        "They would fit with --align box.",
    ),
    "inside": (
        {"points": np.mgrid[-0.5:0.5:20j, -0.2:0.2:20j, -0.5:0.05:20j].reshape(3, -1).T, "labels": np.arange(8000) % 3},
        "only 34% of its points are near the surface",
        APART,
    ),
    "two corners": (
        {"points": np.array([[-0.5, -0.2, -0.5], [0.5, 0.2, 0.05]]), "labels": np.array([0, 1])},
        "only 3% of the surface has labelled points near it",
        APART,
    ),
}


@pytest.mark.parametrize("case", WRONG)
def test_labels_that_make_no_sense_have_one_message(tmp_path: Path, case: str) -> None:
    arrays, problem, remedy = WRONG[case]
    path = put(tmp_path, **arrays)
    with pytest.raises(AssetError) as caught:
        parts_of(path)
    assert (caught.value.where, caught.value.problem, caught.value.remedy) == (str(path), problem, remedy)


def test_without_labels_it_is_said_where_they_would_lie(mesh: Path) -> None:
    with pytest.raises(UsageError) as caught:
        decompose(mesh, QUICK, by="labels", cache=False)
    assert caught.value.message == (
        f"{mesh}: no labels of points lie beside it\n"
        "  Put them beside it, in table.points.npz (or .ply), or name their file: --labels FILE."
    )


def test_a_patch_too_small_to_count_joins_what_it_touches_and_patches_of_a_part_come_apart() -> None:
    kinds = KINDS.copy()
    kinds[np.flatnonzero(KINDS == 0)[7]] = 1  # noise
    found = separate_parts(VERTICES, FACES, SurfaceParts(kinds, NAMES))
    assert names_of(found) == TRUE and len(found.names) == 3
