from __future__ import annotations

import json
from pathlib import Path

import pytest

from meshforge.project import Project
from tests.unit.cli.in_process import Run, runner
from tests.unit.project.stools import PARTS, boxes, coarse, write_stool


@pytest.fixture
def run(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path) -> Run:
    monkeypatch.chdir(tmp_path)
    return runner(monkeypatch, capsys)


@pytest.fixture(autouse=True)
def _stools(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MESHFORGE_CACHE", str(tmp_path / "cache"))
    for name, width in (("a", 0.2), ("b", 0.22), ("c", 0.18)):
        parts = boxes(width, 0.4)
        write_stool(tmp_path / "assets", name, parts, parts if name != "c" else coarse(parts))
    project = Project.create(tmp_path / "p", [tmp_path / "assets/*.urdf"], vocabulary=("seat", "leg"))
    for name in ("a.urdf", "b.urdf"):
        names = [hull.name for hull in project.mesh(name).hulls]
        project.set_labels(name, dict(zip(names, PARTS, strict=True)))


def test_dry_run_then_split_then_undo(run: Run) -> None:
    told = run("prepare", "p", "--split-spanning", "--min-confidence", "0.7", "--dry-run", "--workers", "1")
    assert told.code == 0
    assert "c.urdf: nothing written; would turn 1 piece into 2 hulls\n    base/h0 holds seat and leg, " in told.out
    assert "a.urdf: nothing new\n" in told.out
    told = run("prepare", "p", "--split-spanning", "--min-confidence", "0.7", "--workers", "1")
    assert told.code == 0
    assert "c.urdf: 1 piece into 2 hulls\n    base/h0 holds seat and leg, " in told.out
    told = run("status", "p")
    assert "base/h0 divided into 2 hulls" in told.out
    told = run("prepare", "p", "c.urdf", "--undo")
    assert told.code == 0 and "base/h0 divided into 2 hulls" in told.out
    told = run("status", "p", "--json")
    spans = {asset["asset"]: asset["spans"] for asset in json.loads(told.out)["assets"]}
    assert spans["a.urdf"] == [] and spans["c.urdf"][0].startswith("base/h0 holds seat and leg, ")
    assert "(meshforge review, or prepare --split-spanning)" in run("status", "p").out
    asked = run("info", "c.urdf", "--project", "p")
    assert "\nbase/h0 holds seat and leg, " in asked.out and "meshforge split" in asked.out
    assert json.loads(run("info", "c.urdf", "--project", "p", "--json").out)["spans"] == spans["c.urdf"]


@pytest.mark.slow
def test_review_asks_about_it_and_a_reply_splits_it_or_keeps_it(run: Run, tmp_path: Path) -> None:
    assert "demonstrate" in run("review", "p").out, "nobody has looked for such hulls"
    run("prepare", "p", "--split-spanning", "--min-confidence", "0.7", "--dry-run", "--workers", "1")
    told = run("review", "p", "--json")
    question = json.loads(told.out)["question"]
    assert question["kind"] == "span" and question["hulls"] == [{"asset": "c.urdf", "hull": "base/h0"}]
    assert [choice["text"].split(":")[0] for choice in question["choices"]] == ["no, it is one part", "split so"]
    (picture,) = question["pictures"]
    assert Path(picture).read_bytes().startswith(b"\x89PNG")
    told = run("review", "p")
    assert "base/h0 of c.urdf holds seat and leg, " in told.out and "%: split so?  [span-" in told.out
    replies = tmp_path / "replies.json"
    for choice in ("yes", "no"):
        replies.write_text(json.dumps([{"id": question["id"], "choice": choice}]))
        assert "[span-" not in run("review", "p", "--answers", str(replies)).out
        assert (tmp_path / "p/prepared/c.urdf").exists() == (choice == "yes")
        if choice == "yes":
            run("prepare", "p", "c.urdf", "--undo")
    told = run("prepare", "p", "--split-spanning", "--min-confidence", "0.7", "--workers", "1")
    assert "left as it is, since a person said that it is one part" in told.out and "into 2 hulls" not in told.out


def test_another_engine_makes_the_fine_pieces(run: Run, tmp_path: Path) -> None:
    told = run("prepare", "p", "--split-spanning", "--min-confidence", "0.7", "--workers", "1", "--decompose", "vhacd")
    assert told.code == 0 and "c.urdf: 1 piece into 2 hulls\n" in told.out
    kept = json.loads((tmp_path / "p/prepared/c.urdf/preparation.json").read_text())
    assert kept["steps"][0]["settings"]["pieces"] == "vhacd"
    told = run("prepare", "p", "c.urdf", "--undo")
    assert told.code == 0 and not (tmp_path / "p/prepared/c.urdf").exists()


@pytest.mark.parametrize("option", [("--set", "resolution=5"), ("--hollow",), ("--by", "parts")])
@pytest.mark.parametrize("what", ["--split-spanning", "--rebuild-spanning"])
def test_settings_of_a_decomposition_do_not_go_with_fine_pieces(run: Run, what: str, option: tuple[str, ...]) -> None:
    told = run("prepare", "p", what, "--decompose", "vhacd", *option)
    assert told.code == 2 and told.out == ""
    assert f"{option[0]} does not go with --split-spanning and --rebuild-spanning\n" in told.err


@pytest.mark.slow
@pytest.mark.parametrize(("what", "hulls"), [("--split-spanning", 2), ("--rebuild-spanning", 5)])
def test_only_some_hulls_and_bodies(run: Run, tmp_path: Path, what: str, hulls: int) -> None:
    words = ("prepare", "p", "c.urdf", what, "--min-confidence", "0.7", "--workers", "1", "--only")
    told = run(*words, "base/h1")
    assert told.code == 0 and not (tmp_path / "p/prepared/c.urdf").exists() and "matches" not in told.out
    assert "no hull or body matches lid" in run(*words, "lid").out
    assert f"into {hulls} hulls" in run(*words, "lid", "--only", "bas*").out
    kept = json.loads((tmp_path / "p/prepared/c.urdf/preparation.json").read_text())
    assert kept["steps"][0]["settings"]["only"] == ["lid", "bas*"]
    assert not (tmp_path / "p/preparation.json").exists(), "it was not done to all assets"
    run("prepare", "p", what, "--min-confidence", "0.7", "--workers", "1", "--only", "bas*")
    assert json.loads((tmp_path / "p/preparation.json").read_text())["only"] == ["bas*"]


def test_as_json(run: Run) -> None:
    told = run("prepare", "p", "--split-spanning", "--min-confidence", "0.7", "--workers", "1", "--json")
    rows = [json.loads(line) for line in told.out.splitlines()]
    assert [row["asset"] for row in rows] == ["a.urdf", "b.urdf", "c.urdf"]
    assert rows[2]["hulls"] == ["base/h0#0", "base/h0#1"]


@pytest.mark.parametrize(
    ("words", "problem"),
    [
        (["--split-spanning", "--undo"], "say what to do"),
        (["--decompose", "coacd", "--min-confidence", "0.5"], "--min-confidence"),
        (["--decompose", "coacd", "--dry-run"], "--dry-run"),
        (["--decompose", "coacd", "--limits", "mujoco"], "--limits"),
        (["--split-spanning", "--min-confidence", "0"], "--min-confidence 0: a probability is needed"),
        (["--split-spanning", "--hollow"], "--hollow"),
        (["nope.urdf", "--split-spanning"], "nope.urdf"),
    ],
)
def test_bad_input(run: Run, words: list[str], problem: str) -> None:
    told = run("prepare", "p", *words)
    assert told.code == 2 or told.code == 1
    assert problem in told.err and "Traceback" not in told.err
