"""`meshforge apply PROJECT ASSETS`, and assets that came to a project later: prepared first, as the project says."""

import json
import shutil
from pathlib import Path

import numpy as np
import pytest

from meshforge.batch import IN_PROCESS
from meshforge.formats import load
from meshforge.language import Merge
from meshforge.project import Project, RebuildSettings
from meshforge.synthesis import Step
from tests.unit.batch.families import tree
from tests.unit.cli.in_process import Run
from tests.unit.project.stools import PARTS, boxes, coarse, write_stool

PROGRAM = "labels seat, leg\n\nIs(leg) => Each(Replace(box))\n"


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("stools")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("MESHFORGE_CACHE", str(folder / "cache"))
        parts, wide = boxes(0.2, 0.4), boxes(0.18, 0.4)
        write_stool(folder / "assets", "a", parts, parts)
        write_stool(folder / "new", "c", wide, coarse(wide))
        project = Project.create(folder / "p", [folder / "assets"], vocabulary=("seat", "leg"))
        names = [hull.name for hull in project.mesh("a.urdf").hulls]
        project.set_labels("a.urdf", dict(zip(names, PARTS, strict=True)))
        list(project.rebuild_spanning(how=RebuildSettings(0.7), execution=IN_PROCESS))
        (folder / "p/program.mf").write_text(PROGRAM)
    return folder


@pytest.fixture
def run(run: Run, tmp_path: Path, made: Path, monkeypatch: pytest.MonkeyPatch) -> Run:
    monkeypatch.setenv("MESHFORGE_CACHE", str(made / "cache"))
    for name in ("assets", "new", "p"):
        shutil.copytree(made / name, tmp_path / name)
    return run


def add_to_project() -> None:
    for path in Path("new").glob("c*"):
        shutil.copy(path, "assets")


def test_what_was_rebuilt_is_named_and_the_program_sees_the_parts(run: Run) -> None:
    before = tree(Path("new"))
    told = run("apply", "p", "new", "--out", "out", "--workers", "1")
    assert told.code == 0
    assert "edited     c.urdf: 5 -> 5 hulls\n    note: base/h0 holds seat and leg, " in told.out
    assert "%: base rebuilt into " in told.out
    assert "1 body of new assets rebuilt (c.urdf)" in told.err
    assert tree(Path("new")) == before
    assert sorted(hull.label or "" for hull in load("out/c.urdf").hulls) == sorted(PARTS)
    again = run("apply", "p", "new", "--out", "out", "--workers", "1")
    assert "skipped    c.urdf" in again.out and "%: base rebuilt into " in again.out


def test_as_json(run: Run) -> None:
    line = json.loads(run("apply", "p", "new", "--out", "out", "--workers", "1", "--json").out)
    (rebuilt,) = line["rebuilt"]
    (spanning,) = rebuilt["spanning"]
    assert (rebuilt["body"], spanning["hull"]) == ("base", "base/h0") and 0.7 <= spanning["chance"] < 1
    assert sorted(one["label"] for one in rebuilt["into"]) == sorted(PARTS)
    assert [one["hull"] for one in rebuilt["into"]][:2] == ["base/h0#0", "base/h0#1"]
    assert line["spanning"] == [] and line["guessed"] == {}
    assert line["sure_at_most"] <= spanning["chance"]


def test_no_rebuild_leaves_hulls_and_names_them(run: Run) -> None:
    told = run("apply", "p", "new", "--out", "out", "--workers", "1", "--no-rebuild")
    assert told.code == 0 and "edited     c.urdf: 4 -> 4 hulls" in told.out
    assert "base/h0 holds seat and leg, " in told.out and "%: left as it is" in told.out
    assert "1 hull likely spans parts, left as is" in told.err


@pytest.mark.slow
def test_a_dry_run_writes_nothing(run: Run) -> None:
    add_to_project()
    before = tree(Path("p"))
    told = run("apply", "p", "--dry-run", "--workers", "1")
    assert told.code == 0 and "%: base rebuilt into " in told.out and tree(Path("p")) == before
    told = run("apply", "p", "new", "--out", "out", "--dry-run", "--workers", "1")
    assert told.code == 0 and "%: base rebuilt into " in told.out and not Path("out").exists()


@pytest.mark.slow
def test_what_came_later_is_prepared_in_the_project_once(run: Run) -> None:
    add_to_project()
    told = run("apply", "p", "--workers", "1")
    assert told.code == 0 and "edited     c.urdf: 5 -> 5 hulls\n    note: base/h0 holds seat and leg, " in told.out
    assert "4 hulls rebuilt into 5 hulls" in run("status", "p").out
    assert run("prepare", "p", "c.urdf", "--undo").code == 0
    told = run("apply", "p", "--workers", "1")
    assert "rebuilt in" not in told.out, "what a person took back is not done again"
    assert Project.open("p").mesh("c.urdf").hulls[0].name == "base/h0"


@pytest.mark.slow
def test_no_rebuild_in_a_project_is_made_good_by_the_next_run(run: Run) -> None:
    add_to_project()
    assert "%: left as it is" in run("apply", "p", "--workers", "1", "--no-rebuild").out
    assert "%: base rebuilt into " in run("apply", "p", "--workers", "1").out


def test_the_projects_own_assets_are_taken_as_they_are_there(run: Run) -> None:
    told = run("apply", "p", "assets/a.urdf", "--out", "out", "--workers", "1")
    assert told.code == 0 and told.out.startswith("edited     a.urdf: 5 -> 5 hulls\n1 asset")


@pytest.mark.slow
def test_what_is_less_sure_than_asked_is_held_and_reported(run: Run) -> None:
    told = run("apply", "p", "new", "--out", "out", "--workers", "1", "--min-confidence", "0.999")
    assert told.code == 1 and not Path("out/c.urdf").exists()
    assert "needs review c.urdf: " in told.out and "% sure; " in told.out
    told = run(
        "apply", "p", "new", "--out", "out", "--workers", "1", "--min-confidence", "0.5", "--json", "--report", "r.html"
    )
    line = json.loads(told.out)
    assert 0.5 <= line["probability"] <= line["rebuilt"][0]["spanning"][0]["chance"] + 0.001, (
        "the chance has three digits"
    )
    assert any("%: base rebuilt into " in doubt["text"] for doubt in line["reasons"])
    assert "%: base rebuilt into " in Path("r.html").read_text()


@pytest.mark.parametrize(
    ("words", "problem"),
    [
        (["p", "new"], "--out DIR is missing"),
        (["p", "new", "--out", "p/edited"], "this folder is for the project's own assets"),
        (["p", "--labels", "new"], "a project has its own labels"),
        (["p/program.mf", "new", "--out", "out", "--no-rebuild"], "--no-rebuild needs a project"),
        (["p", "nowhere", "--out", "out"], "there is no such file or folder"),
    ],
)
def test_bad_input(run: Run, words: list[str], problem: str) -> None:
    told = run("apply", *words)
    assert told.code == 2 and problem in told.err and "Traceback" not in told.err


@pytest.fixture
def block(run: Run, monkeypatch: pytest.MonkeyPatch) -> Run:
    """The project's program makes one block of everything."""
    Path("p/program.mf").write_text("labels seat, leg\n\nAll => Merge\n")
    return run


def test_new_assets_whose_results_stand_out_end_with_exit_code_1_until_they_are_accepted(block: Run) -> None:
    words = ("apply", "p", "new", "--out", "out", "--workers", "1")
    told = block(*words)
    assert told.code == 1
    assert "1 result stands out: c.urdf (" in told.out
    assert told.err.endswith("Look at c.urdf, then: --accept-outliers\n")
    assert Path("out/c.urdf").exists(), "it is written all the same"
    assert block(*words).code == 1, "it stands out as before where nothing is left to do"
    as_json = block(*words, "--json")
    assert as_json.code == 1 and json.loads(as_json.out)["alarms"]
    assert block(*words, "--accept-outliers").code == 0


def test_an_outlier_of_the_project_is_one_until_it_is_accepted(block: Run) -> None:
    add_to_project()
    told = block("apply", "p", "--workers", "1")
    assert told.code == 1 and "then: meshforge review, or --accept-outliers\n" in told.err
    project = Project.open("p")
    for asset in project.assets():
        assert block("apply", "p", "--workers", "1").code == 1
        project.set_verdict(asset, "accepted")
    assert block("apply", "p", "--workers", "1").code == 0


def test_a_result_that_was_demonstrated_is_no_outlier(block: Run) -> None:
    project = Project.open("p")
    (asset,) = project.assets()
    assert block("apply", "p", "--workers", "1").code == 1
    project.demonstrate(asset, [Step(1, frozenset(hull.name for hull in project.mesh(asset).hulls), Merge())])
    assert block("apply", "p", "--workers", "1").code == 0


def test_a_program_alone_is_never_signed_off_so_its_outliers_are_only_named(block: Run) -> None:
    told = block("apply", "p/program.mf", "new", "--out", "out", "--workers", "1")
    assert told.code == 0 and "1 result stands out: c.urdf (" in told.out


@pytest.fixture
def named(run: Run) -> Run:
    """The project's hulls are labelled by a pattern of their names; likeness would say otherwise of those of c.urdf."""
    project = Project.open("p")
    project.set_labels("a.urdf", dict.fromkeys([hull.name for hull in project.mesh("a.urdf").hulls]))
    assert run("label", "p", "--with", "names", "--pattern", "*h[0-4]=leg", "--workers", "1").code == 0
    return run


SOURCES = Path("p/label_sources.json")
WORDS = ("apply", "p", "new", "--out", "out", "--workers", "1", "--no-rebuild")


def test_new_assets_are_labelled_by_the_patterns_that_labelled_the_family(named: Run) -> None:
    told = named(*WORDS)
    assert "note: 4 labels by names" in told.out and "by likeness" not in told.out
    assert {hull.label for hull in load("out/c.urdf").hulls} == {"leg"}
    (line,) = map(json.loads, named(*WORDS, "--json").out.splitlines())
    assert line["guessed"] == {} and line["labelled"]["base/h0"] == {
        "label": "leg",
        "confidence": 0.9,
        "source": "name",
    }


def test_what_names_do_not_say_is_labelled_by_likeness(named: Run) -> None:
    kept = json.loads(SOURCES.read_text())
    kept["lines"][0]["options"]["meanings"] = [["*h0", "leg"]]
    SOURCES.write_text(json.dumps(kept))
    told = named(*WORDS)
    assert "note: 1 label by names" in told.out and "note: 3 labels by likeness to the family; least sure" in told.out


def test_files_beside_new_assets_come_before_names_and_likeness(named: Run) -> None:
    points = np.concatenate([hull.vertices for hull in load("new/c.urdf").hulls])
    for label in ("seat", "leg"):
        np.savez("new/c.points.npz", points=points, labels=np.zeros(len(points), int), names=[label])
        told = named(*WORDS)
        assert "note: 4 labels from a file" in told.out
    assert "edited     c.urdf" in told.out, "another file, another label"
    Path("new/c.labels.json").write_text(json.dumps({"hulls": {"base/h1": "seat"}}))
    told = named(*WORDS)
    assert "note: 3 labels by names" in told.out, "of files beside an asset the first counts, here its labels file"
    assert {hull.label for hull in load("out/c.urdf").hulls} == {"seat", "leg"}


def test_a_project_of_before_sources_were_kept_has_those_of_its_labels(named: Run) -> None:
    SOURCES.unlink()
    with Path("p/meshforge.toml").open("a") as settings:
        settings.write('\n[names]\n"*h[0-4]" = "leg"\n')
    assert "note: 4 labels by names" in named(*WORDS).out


def test_labels_that_were_taken_back_label_no_new_asset(named: Run) -> None:
    project = Project.open("p")
    hulls = [hull.name for hull in project.mesh("a.urdf").hulls]
    project.set_labels("a.urdf", dict(zip(hulls, PARTS, strict=True)))
    told = named(*WORDS)
    assert "by names" not in told.out and "by likeness to the family" in told.out


def test_patterns_add_up_and_follow_a_label_that_is_renamed(named: Run) -> None:
    Project.open("p").set_labels("a.urdf", {"base/h4": None})
    assert named("label", "p", "--with", "names", "--pattern", "*h4=seat", "--workers", "1").code == 0
    Project.open("p").rename_label("leg", "foot")
    (line,) = json.loads(SOURCES.read_text())["lines"]
    assert line["options"]["meanings"] == [["*h[0-4]", "foot"], ["*h4", "seat"]]
