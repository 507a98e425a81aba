"""`--max-vertices` where hulls are made: the engine is told, and what it makes keeps to the number."""

from pathlib import Path

import pytest

from meshforge.cli.options import EngineMethod, parse_engine_settings
from meshforge.common import UsageError
from meshforge.formats import load
from meshforge.geometry import CoacdSettings, VhacdSettings
from tests.loop.command import meshforge
from tests.mesh_files import obj
from tests.soups import ball


def test_the_engine_is_told() -> None:
    coacd, vhacd, hull = (parse_engine_settings(method, None, 24) for method in EngineMethod)
    assert isinstance(coacd, CoacdSettings) and (coacd.decimate, coacd.max_ch_vertex, coacd.max_vertices) == (
        True,
        24,
        24,
    )
    assert isinstance(vhacd, VhacdSettings) and vhacd.max_hull_vertices == vhacd.max_vertices == 24
    assert hull.max_vertices == 24 and parse_engine_settings(EngineMethod.HULL, None).max_vertices is None
    assert parse_engine_settings(EngineMethod.COACD, None) == CoacdSettings() and CoacdSettings().max_vertices is None


def test_the_number_is_given_once() -> None:
    with pytest.raises(UsageError, match="--max-vertices and --set max_hull_vertices say the same"):
        parse_engine_settings(EngineMethod.VHACD, ["max_hull_vertices=32"], 24)


@pytest.mark.slow
@pytest.mark.parametrize("engine", ["coacd", "vhacd", "hull"])
def test_no_hull_has_more(tmp_path: Path, engine: str) -> None:
    whole = ball(100)
    (tmp_path / "ball.obj").write_bytes(obj((whole.vertices, whole.faces)))
    words = ("decompose", "ball.obj", "-o", "out.obj", "--decompose", engine, "--max-vertices", "20")
    meshforge(*words, *(() if engine == "hull" else ("--set", "resolution=2000")), cwd=tmp_path)
    hulls = load(tmp_path / "out.obj").hulls
    assert max(len(hull.vertices) for hull in hulls) <= 20
    assert sum(hull.volume for hull in hulls) >= 0.99 * whole.volume, "it lies around the ball: no corner is left out"
