import os
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from meshforge.common import GeometryError, UsageError
from meshforge.geometry import Floats, Ints, Polytope, is_convex
from meshforge.geometry.decomposition import engines
from meshforge.geometry.decomposition.engines import (
    CoacdSettings,
    DecomposeSettings,
    DecompositionCancelledError,
    EngineControl,
    VhacdSettings,
)
from meshforge.geometry.decomposition.run import (
    cache_folder,
    cache_key,
    decompose,
    decompose_solids,
    read_entry,
    read_solid,
    write_entry,
)
from meshforge.geometry.decomposition.triangles import clean_triangles
from meshforge.geometry.decomposition.worker import pack_pieces

QUICK = CoacdSettings(resolution=200, mcts_iterations=20, mcts_nodes=8)
COARSE = VhacdSettings(resolution=5000, max_convex_hulls=4)
RAYCAST = VhacdSettings(resolution=20000, fill_mode="raycast")


def prism(outline: list[tuple[float, float]], triangles: list[tuple[int, int, int]]) -> tuple[Floats, Ints]:
    """A prism of height 1 over an outline with its triangles, both counter-clockwise."""
    n = len(outline)
    vertices = [(x, y, z) for z in (0.0, 1.0) for x, y in outline]
    faces = [(c, b, a) for a, b, c in triangles] + [(a + n, b + n, c + n) for a, b, c in triangles]
    for k in range(n):
        j = (k + 1) % n
        faces += [(k, j, j + n), (k, j + n, k + n)]
    return np.array(vertices), np.array(faces)


L_SHAPE = prism([(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)], [(0, 1, 3), (1, 2, 3), (0, 3, 5), (3, 4, 5)])
CUBE = prism([(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 1, 2), (0, 2, 3)])


def fake_engine(monkeypatch: pytest.MonkeyPatch, folder: Path, code: str) -> None:
    script = folder / "engine.py"
    script.write_text(code)
    monkeypatch.setattr(engines, "worker", SimpleNamespace(__file__=str(script)))


@pytest.mark.parametrize(
    "settings", [QUICK, VhacdSettings(resolution=5000), RAYCAST], ids=["coacd", "flood", "raycast"]
)
@pytest.mark.parametrize("winding", [1, -1], ids=["outward", "inward"])
def test_an_l_shape_becomes_convex_hulls_that_fill_it(settings: DecomposeSettings, winding: int) -> None:
    notes: list[str] = []
    vertices, faces = L_SHAPE
    hulls = decompose(vertices, faces[:, ::winding], settings, note=notes.append)
    assert len(hulls) >= 2 and not notes
    assert all(is_convex(h.vertices, h.faces) and h.volume > 0 for h in hulls)
    assert sum(h.volume for h in hulls) == pytest.approx(5.0, rel=0.1)


def test_triangles_that_share_no_vertices_are_welded_first() -> None:
    vertices, faces = L_SHAPE
    soup = vertices[faces].reshape(-1, 3), np.arange(faces.size).reshape(-1, 3)
    notes: list[str] = []
    assert sum(h.volume for h in decompose(*soup, QUICK, note=notes.append)) == pytest.approx(5.0, rel=0.01)
    assert notes == []


def test_an_open_box_is_decomposed_with_a_note() -> None:
    vertices, faces = CUBE
    notes: list[str] = []
    hulls = decompose(vertices, faces[2:], COARSE, note=notes.append)
    assert hulls and "open (4 edges" in notes[0]


def test_an_open_box_without_preprocessing_is_refused() -> None:
    with pytest.raises(GeometryError, match="nonsense for open meshes"):
        decompose(CUBE[0], CUBE[1][2:], CoacdSettings(preprocess_mode="off"))


@pytest.mark.parametrize(
    ("vertices", "faces", "problem"),
    [
        (CUBE[0], np.zeros((0, 3)), "no triangles"),
        (CUBE[0] * [1, 1, 0], CUBE[1], "flat"),
        (CUBE[0] * [1, 0, 0], CUBE[1], "flat"),
        (CUBE[0], CUBE[1] + 1, "not there"),
        (np.where(CUBE[0] == 1, np.nan, CUBE[0]), CUBE[1], "not a finite number"),
        (np.where(CUBE[0] == 1, np.inf, CUBE[0]), CUBE[1], "not a finite number"),
    ],
)
def test_a_mesh_that_cannot_be_decomposed_is_refused(vertices: Floats, faces: Ints, problem: str) -> None:
    with pytest.raises(GeometryError, match=problem):
        decompose(vertices, faces, QUICK)


def test_coordinates_of_unused_vertices_do_not_matter() -> None:
    vertices = np.concatenate([CUBE[0], [[np.nan, 0, 0]]])
    assert [h.volume for h in decompose(vertices, CUBE[1], QUICK)] == pytest.approx([1.0])


def test_progress_tells_each_round() -> None:
    told: list[str] = []
    decompose(*L_SHAPE, QUICK, control=EngineControl(told.append))
    assert told[0] == "round 1: 1 parts still to be split" and len(told) > 1


def test_a_crash_of_the_engine_is_an_error_with_its_last_words(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    fake_engine(monkeypatch, tmp_path, "import os, sys\nprint('out of luck', file=sys.stderr, flush=True)\nos.abort()")
    with pytest.raises(GeometryError, match=r"coacd crashed \(exit code -6: out of luck\)"):
        decompose(*CUBE, QUICK)


def test_an_engine_that_ends_without_a_result_is_an_error(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    fake_engine(monkeypatch, tmp_path, "")
    with pytest.raises(GeometryError, match=r"vhacd crashed \(exit code 0: no message\)"):
        decompose(*CUBE, COARSE)


_CRASH_ON_A_CUBE = """
import os, sys
from meshforge.geometry.decomposition import worker

def run(vertices, faces, settings):
    return os.abort() if len(vertices) == 8 else known(vertices, faces, settings)

known, worker._run_coacd = worker._run_coacd, run
worker.main(*sys.argv[1:])
"""


@pytest.mark.slow
def test_each_of_several_solids_is_decomposed_as_it_is_alone(tmp_path: Path) -> None:
    solids = [
        read_solid(*L_SHAPE, QUICK, close=False),
        read_solid(*CUBE, COARSE, close=False),
        read_solid(L_SHAPE[0] * [1, 1, 2], L_SHAPE[1], QUICK, close=False),
        read_solid(*L_SHAPE, QUICK, close=False),
    ]
    decompose(*CUBE, COARSE, cache=tmp_path)
    alone = [decompose(mesh.vertices, mesh.faces, settings) for mesh, settings in solids]
    for cache in (None, tmp_path, tmp_path):
        together = decompose_solids(solids, cache)
        assert [_contents(found) for found in together] == [_contents(found) for found in alone]
    assert decompose_solids([], tmp_path) == []


def test_a_crash_on_one_of_several_solids_leaves_the_others(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    solids = [read_solid(*shape, QUICK, close=False) for shape in (CUBE, L_SHAPE, CUBE, L_SHAPE, CUBE)]
    alone = decompose(*L_SHAPE, QUICK)
    fake_engine(monkeypatch, tmp_path, _CRASH_ON_A_CUBE)
    found = decompose_solids(solids, tmp_path / "cache")
    assert [isinstance(one, GeometryError) for one in found] == [True, False, True, False, True]
    assert all(_contents(one) == _contents(alone) for one in found[1::2])
    assert "crashed (exit code -6" in str(found[2])
    assert len(list((tmp_path / "cache").rglob("*.npz"))) == 1


def _contents(found: list[Polytope] | GeometryError) -> list[bytes]:
    assert not isinstance(found, GeometryError)
    return [hull.vertices.tobytes() for hull in found]


def hanging_engine(folder: Path) -> str:
    return f"import os, time\nopen({str(folder / 'pid')!r}, 'w').write(str(os.getpid()))\ntime.sleep(600)"


def assert_ended(pid: int) -> None:
    with pytest.raises(ProcessLookupError):
        os.kill(pid, 0)


def test_cancelling_ends_the_engine(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    fake_engine(monkeypatch, tmp_path, hanging_engine(tmp_path))

    def cancel() -> bool:
        return (tmp_path / "pid").exists() and (tmp_path / "pid").read_text() != ""

    with pytest.raises(DecompositionCancelledError):
        decompose(*CUBE, QUICK, control=EngineControl(cancel=cancel))
    assert_ended(int((tmp_path / "pid").read_text()))


def test_an_engine_that_takes_too_long_is_ended(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    fake_engine(monkeypatch, tmp_path, hanging_engine(tmp_path))
    with pytest.raises(GeometryError, match=r"no decomposition within 0\.6 s"):
        decompose(*CUBE, QUICK, control=EngineControl(timeout=0.6))
    if (tmp_path / "pid").exists():
        assert_ended(int((tmp_path / "pid").read_text()))


def test_sheets_get_a_thickness_and_needles_are_left_out(tmp_path: Path) -> None:
    sheet, needle = CUBE[0] * [1, 1, 0], CUBE[0] * [1, 0, 0]
    write_entry(tmp_path, cache_key(clean_triangles(*CUBE), QUICK), pack_pieces([(sheet, CUBE[1]), (needle, CUBE[1])]))
    notes: list[str] = []
    (hull,) = decompose(*CUBE, QUICK, cache=tmp_path, note=notes.append)
    assert hull.aabb.size == pytest.approx([1, 1, 1e-4 * 3**0.5])
    assert "1 of 2 pieces" in notes[0]


def test_a_kept_result_is_used_and_is_the_same(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    made = decompose(*L_SHAPE, QUICK, cache=tmp_path)
    fake_engine(monkeypatch, tmp_path, "raise SystemExit('the engine was run again')")
    kept = decompose(*L_SHAPE, QUICK, cache=tmp_path)
    assert [h.vertices.tobytes() for h in kept] == [h.vertices.tobytes() for h in made]
    with pytest.raises(GeometryError, match="run again"):
        decompose(*L_SHAPE, CoacdSettings(resolution=201), cache=tmp_path)


@pytest.mark.parametrize("damage", [b"", b"nonsense", b"PK\x03\x04"])
def test_a_damaged_entry_is_ignored_and_written_anew(tmp_path: Path, damage: bytes) -> None:
    made = decompose(*CUBE, QUICK, cache=tmp_path)
    (entry,) = tmp_path.rglob("*.npz")
    whole = entry.read_bytes()
    entry.write_bytes(damage or whole[: len(whole) // 2])
    assert [h.volume for h in decompose(*CUBE, QUICK, cache=tmp_path)] == [h.volume for h in made]
    assert entry.read_bytes() == whole


def test_a_bit_flipped_in_an_entry_is_noticed(tmp_path: Path) -> None:
    decompose(*CUBE, QUICK, cache=tmp_path)
    (entry,) = tmp_path.rglob("*.npz")
    content = bytearray(entry.read_bytes())
    content[len(content) // 4] ^= 1
    entry.write_bytes(content)
    assert read_entry(tmp_path, entry.stem) is None


def test_a_cache_that_cannot_be_written_is_a_note(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    notes: list[str] = []
    assert decompose(*CUBE, QUICK, cache=tmp_path / "file", note=notes.append)
    assert "could not be kept" in notes[0]


@pytest.mark.parametrize(
    ("environment", "folder"),
    [
        ({"MESHFORGE_CACHE": "/a", "XDG_CACHE_HOME": "/b"}, Path("/a")),
        ({"XDG_CACHE_HOME": "/b"}, Path("/b/meshforge")),
        ({}, Path.home() / ".cache" / "meshforge"),
    ],
)
def test_the_cache_is_where_the_environment_says(environment: dict[str, str], folder: Path) -> None:
    assert cache_folder(environment) == folder


@pytest.mark.parametrize(
    ("kind", "wrong", "message"),
    [
        (CoacdSettings, {"threshold": 0.001}, "coacd threshold: 0.001 is not between 0.01 and 1"),
        (CoacdSettings, {"threshold": float("nan")}, "is not between"),
        (CoacdSettings, {"preprocess_mode": "maybe"}, "'maybe' is none of auto, on, off"),
        (CoacdSettings, {"max_convex_hull": -2}, "is not at least -1"),
        (VhacdSettings, {"fill_mode": "drip"}, "vhacd fill_mode: 'drip' is none of"),
        (VhacdSettings, {"resolution": 10}, "is not between"),
    ],
)
def test_settings_out_of_range_are_refused(kind: Any, wrong: dict[str, Any], message: str) -> None:
    with pytest.raises(UsageError, match=message):
        kind(**wrong)
