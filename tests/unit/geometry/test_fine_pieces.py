"""Fine pieces of a surface: kept whole, and by another engine."""

from collections.abc import Sequence
from pathlib import Path

import manifold3d
import numpy as np
import pytest

from meshforge.common import GeometryError
from meshforge.geometry import FinePiece, Floats, Ints, decompose_finely, volume_of_union
from meshforge.geometry.decomposition import fine
from tests.unit.geometry.test_decompose import CUBE, fake_engine


def make_t() -> tuple[Floats, Ints]:
    bar = manifold3d.Manifold.cube((0.6, 0.1, 0.1), True)
    stem = manifold3d.Manifold.cube((0.1, 0.1, 0.5), True).translate((0, 0, -0.25))
    mesh = (bar + stem).to_mesh()
    return np.asarray(mesh.vert_properties)[:, :3].astype(float), np.asarray(mesh.tri_verts).astype(np.int64)


T_SHAPE = make_t()


def contents(pieces: Sequence[FinePiece]) -> list[tuple[bytes, bytes, int, int]]:
    return [(one.shape.vertices.tobytes(), one.shape.faces.tobytes(), one.region, one.solid) for one in pieces]


def forbid_cuts(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> None:
        raise AssertionError("the pieces were made again")

    monkeypatch.setattr(fine, "_decompose_mesh", refuse)


@pytest.mark.parametrize("engine", ["coacd", "vhacd"])
def test_kept_pieces_are_those_that_were_made_to_the_last_bit(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, engine: fine.PieceEngine
) -> None:
    made = decompose_finely(*T_SHAPE, engine, cache=tmp_path)
    assert volume_of_union([piece.shape for piece in made]) == pytest.approx(0.1 * 0.1 * (0.6 + 0.45), rel=0.02)
    forbid_cuts(monkeypatch)
    assert contents(decompose_finely(*T_SHAPE, engine, cache=tmp_path)) == contents(made)


def test_pieces_of_another_engine_mesh_or_version_are_others(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    decompose_finely(*T_SHAPE, cache=tmp_path)
    forbid_cuts(monkeypatch)
    with pytest.raises(AssertionError, match="again"):
        decompose_finely(*T_SHAPE, "vhacd", cache=tmp_path)
    with pytest.raises(AssertionError, match="again"):
        decompose_finely(T_SHAPE[0] * [1, 1, 1.001], T_SHAPE[1], cache=tmp_path)
    monkeypatch.setattr(fine, "_VERSION", -1)
    with pytest.raises(AssertionError, match="again"):
        decompose_finely(*T_SHAPE, cache=tmp_path)


def test_pieces_that_were_damaged_on_disk_are_made_again(tmp_path: Path) -> None:
    made = decompose_finely(*T_SHAPE, cache=tmp_path)
    for entry in tmp_path.rglob("*.npz"):
        content = bytearray(entry.read_bytes())
        content[len(content) // 3] ^= 1
        entry.write_bytes(content)
    assert contents(decompose_finely(*T_SHAPE, cache=tmp_path)) == contents(made)


def test_what_an_engine_failed_on_is_one_piece_and_is_not_kept(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    with monkeypatch.context() as patch:
        fake_engine(patch, tmp_path, "raise SystemExit('out of memory')")
        assert len(decompose_finely(*T_SHAPE, cache=tmp_path / "cache")) >= 1
    assert not list(tmp_path.rglob("*.npz"))
    assert contents(decompose_finely(*T_SHAPE, cache=tmp_path / "cache")) == contents(decompose_finely(*T_SHAPE))


def test_a_cache_that_cannot_be_written_does_not_matter(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    assert len(decompose_finely(*CUBE, cache=tmp_path / "file")) == 1


def test_nothing_is_kept_of_a_surface_that_has_no_pieces(tmp_path: Path) -> None:
    with pytest.raises(GeometryError, match="flat"):
        decompose_finely(
            np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], dtype=float), np.array([[0, 1, 2]]), cache=tmp_path
        )
    assert not list(tmp_path.rglob("*"))
