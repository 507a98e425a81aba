import json
from pathlib import Path

import pytest

from tests.unit.cli.in_process import Run
from tests.unit.project.stools import create_stools


@pytest.fixture(autouse=True)
def _stools(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MESHFORGE_CACHE", str(tmp_path / "cache"))
    create_stools(tmp_path, {"a": (0.2, 0.4), "b": (0.22, 0.4), "c": (0.18, 0.4)}, spanning="c")


def test_dry_run_then_rebuild_then_undo(run: Run) -> None:
    words = ("prepare", "p", "--rebuild-spanning", "--min-confidence", "0.7", "--workers", "1")
    told = run(*words, "--dry-run")
    assert told.code == 0
    assert "c.urdf: nothing written; would turn 4 pieces into 5 hulls\n    base/h0 holds seat and leg, " in told.out
    assert "    3 others made anew with its body\n" in told.out and "a.urdf: nothing new\n" in told.out
    told = run(*words)
    assert told.code == 0
    assert "c.urdf: 4 pieces into 5 hulls\n    base/h0 holds seat and leg, " in told.out
    assert "4 hulls rebuilt into 5 hulls" in run("status", "p").out
    told = run("prepare", "p", "c.urdf", "--undo")
    assert told.code == 0 and "4 hulls rebuilt into 5 hulls" in told.out


@pytest.mark.parametrize("option", [("--set", "resolution=5"), ("--hollow",), ("--by", "parts")])
def test_settings_of_a_decomposition_do_not_go_with_fine_pieces(run: Run, option: tuple[str, ...]) -> None:
    told = run("prepare", "p", "--rebuild-spanning", "--decompose", "vhacd", *option)
    assert told.code == 2 and told.out == ""
    assert f"{option[0]} does not go with --rebuild-spanning\n" in told.err


@pytest.mark.slow
def test_only_some_hulls_and_bodies(run: Run, tmp_path: Path) -> None:
    words = ("prepare", "p", "c.urdf", "--rebuild-spanning", "--min-confidence", "0.7", "--workers", "1", "--only")
    told = run(*words, "base/h1")
    assert told.code == 0 and not (tmp_path / "p/prepared/c.urdf").exists() and "matches" not in told.out
    assert "no hull or body matches lid" in run(*words, "lid").out
    assert "into 5 hulls" in run(*words, "lid", "--only", "bas*").out
    kept = json.loads((tmp_path / "p/prepared/c.urdf/preparation.json").read_text())
    assert kept["steps"][0]["settings"]["only"] == ["lid", "bas*"]
    assert not (tmp_path / "p/preparation.json").exists(), "it was not done to all assets"
    run("prepare", "p", "--rebuild-spanning", "--min-confidence", "0.7", "--workers", "1", "--only", "bas*")
    assert json.loads((tmp_path / "p/preparation.json").read_text())["only"] == ["bas*"]


def test_as_json(run: Run) -> None:
    told = run("prepare", "p", "--rebuild-spanning", "--min-confidence", "0.7", "--workers", "1", "--json")
    rows = [json.loads(line) for line in told.out.splitlines()]
    assert [row["asset"] for row in rows] == ["a.urdf", "b.urdf", "c.urdf"]
    assert rows[2]["hulls"] == ["base/h0#0", "base/h0#1", "base/h1#0", "base/h2#0", "base/h3#0"]


@pytest.mark.parametrize(
    ("words", "problem"),
    [
        (["--rebuild-spanning", "--undo"], "say what to do"),
        (["--decompose", "coacd", "--min-confidence", "0.5"], "--min-confidence"),
        (["--decompose", "coacd", "--dry-run"], "--dry-run"),
        (["--rebuild-spanning", "--min-confidence", "0"], "--min-confidence 0: a probability is needed"),
        (["--rebuild-spanning", "--hollow"], "--hollow"),
        (["nope.urdf", "--rebuild-spanning"], "nope.urdf"),
    ],
)
def test_bad_input(run: Run, words: list[str], problem: str) -> None:
    told = run("prepare", "p", *words)
    assert told.code == 2 or told.code == 1
    assert problem in told.err and "Traceback" not in told.err
