import json
import shutil
from collections.abc import Callable
from pathlib import Path
from unittest.mock import Mock

import pytest

from meshforge.batch import IN_PROCESS, ExecutionOptions, Failed
from meshforge.common import AssetError, ProjectError
from meshforge.formats import load
from meshforge.geometry.decomposition import engines
from meshforge.language import Delete, Merge
from meshforge.project import DecompositionPlan, Project
from meshforge.project.prepare import count_copies, try_decomposition
from meshforge.synthesis import Found, Step
from tests.unit.batch.families import tree
from tests.unit.batch.preparation.samples import QUICK, write_boxes, write_stand
from tests.unit.deaths import deaths, needs_fork
from tests.unit.project.tables import FIRST, SECOND, applied, labelled

HIGH, LOW = "high/stand.urdf", "low/stand.urdf"


@pytest.fixture(scope="module")
def cache(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("cache")


@pytest.fixture(autouse=True)
def _cached(monkeypatch: pytest.MonkeyPatch, cache: Path) -> None:
    monkeypatch.setenv("MESHFORGE_CACHE", str(cache))


def fresh(folder: Path) -> Project:
    """A project of two stands, the second lower."""
    write_stand(folder / "assets/high")
    path = write_stand(folder / "assets/low")
    path.write_text(path.read_text().replace("0 0 2", "0 0 1.5"))
    return Project.create(folder / "stands", [folder / "assets"], vocabulary=["body", "foot", "cover"])


def decomposed(folder: Path) -> Project:
    project = fresh(folder)
    assert [len(done.made) for done in project.decompose(settings=QUICK, execution=IN_PROCESS)] == [2, 2]
    return project


def names(project: Project, asset: str) -> list[str]:
    return [hull.name for hull in project.mesh(asset).hulls]


def label_all(project: Project, asset: str) -> None:
    kind = {"frame/body": "body", "frame/foot": "foot", "cover/geom0": "cover"}
    project.set_labels(asset, {name: kind[name.partition("#")[0]] for name in names(project, asset)})


@pytest.mark.slow
def test_the_files_do_not_depend_on_the_workers(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    found = []
    for workers in (0, 2):
        monkeypatch.setenv("MESHFORGE_CACHE", str(tmp_path / f"cache{workers}"))
        project = fresh(tmp_path / str(workers))
        list(project.decompose(settings=QUICK, execution=ExecutionOptions(workers=workers)))
        found.append(tree(project.folder / "prepared"))
    assert len(found[0]) == 4 and found[0] == found[1]


@pytest.mark.slow
def test_equal_copies_are_decomposed_once_a_try_writes_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MESHFORGE_CACHE", str(tmp_path / "cache"))
    for name in "abc":
        write_stand(tmp_path / "assets" / name)
    project = Project.create(tmp_path / "p", [tmp_path / "assets"])
    runs, before = Mock(wraps=engines.run_engines), tree(project.folder)
    monkeypatch.setattr(engines, "run_engines", runs)
    (tmp_path / "pieces").mkdir()
    plan = DecompositionPlan(QUICK)
    for _ in range(2):  # what is known from before is made anew, so that the seconds are right
        tried, seconds = try_decomposition(project, project.assets()[0], plan, IN_PROCESS, tmp_path / "pieces")
        assert seconds > 0 and tree(project.folder) == before
    done = list(project.decompose(settings=QUICK, execution=ExecutionOptions(workers=2)))
    made = [entry for one in done for entry in one.made]
    assert (runs.call_count, len(made), count_copies(made)) == (4, 6, 4)
    assert len({json.dumps(list(one.made[0].made.values())) for one in done}) == 1
    assert done[0].made == tried.made


@pytest.mark.slow
def test_one_asset_that_fails_is_told_and_the_others_are_done(tmp_path: Path) -> None:
    project = fresh(tmp_path)
    (tmp_path / "assets" / HIGH).write_text("<robot")
    high, low = project.decompose(settings=QUICK, execution=ExecutionOptions(workers=1))
    assert len(high.problems) == 1 and HIGH in high.problems[0]
    assert len(low.made) == 2


def test_a_changed_asset_is_told_to_be_prepared_again_and_then_is(tmp_path: Path) -> None:
    project = decomposed(tmp_path)
    path = tmp_path / "assets" / HIGH
    path.write_text(path.read_text().replace('scale="1 1 0.5"', 'scale="1 1 0.7"'))
    with pytest.raises(AssetError, match="out of date"):
        project.mesh(HIGH)
    error = project.status(workers=0).assets[0].error
    assert error and "cover has another geometry now" in error
    (done,) = project.decompose([HIGH], QUICK, execution=IN_PROCESS)
    assert done.notes == ("given up, since cover has another geometry now",)
    assert [entry.what for entry in done.made] == ["cover"]
    assert len(names(project, HIGH)) == 5


def test_the_program_runs_on_what_is_prepared(tmp_path: Path) -> None:
    project = decomposed(tmp_path)
    for asset in (HIGH, LOW):
        label_all(project, asset)
    project.demonstrate(HIGH, [Step(1, {n for n in names(project, HIGH) if "cover" in n}, Merge())])
    assert isinstance(project.synthesize(), Found)
    outcomes = list(project.apply(execution=IN_PROCESS))
    assert [(o.status, getattr(o, "before", 0), getattr(o, "after", 0)) for o in outcomes] == [("edited", 5, 4)] * 2
    edited = load(project.folder / "edited" / LOW)
    assert {hull.name.replace("#1~", "#0~"): hull.label for hull in edited.hulls} == {
        "frame/body#0": "body",
        "frame/body#1": "body",
        "frame/foot": "foot",
        "cover/geom0#0~1": "cover",
    }
    assert edited.asset and edited.asset.non_convex == ()
    assert all(asset.is_done for asset in project.status(workers=0).assets)
    assert [o.status for o in project.apply(execution=IN_PROCESS)] == ["skipped"] * 2


def test_outputs_programs_and_surveys_know_when_a_preparation_changed(tmp_path: Path) -> None:
    project = decomposed(tmp_path)
    for asset in (HIGH, LOW):
        label_all(project, asset)
    project.demonstrate(HIGH, [Step(1, {"frame/foot"}, Delete())])
    project.synthesize()
    list(project.apply(execution=IN_PROCESS))
    project.cut(HIGH, "frame/foot", (0, 0, -1), (1, 0, 0))
    found = project.status(workers=0)
    assert found.outdated
    assert [asset.stale for asset in found.assets] == [("preparation", "labels"), ()]
    assert found.assets[0].prepared == ("2 pieces decomposed into 4 hulls by coacd", "frame/foot cut into 2 hulls")


def test_an_asset_whose_preparation_cannot_be_read_is_not_edited_without_it(tmp_path: Path) -> None:
    project = decomposed(tmp_path)
    (project.folder / "program.mf").write_text("All => Merge\n")
    record = project.folder / "prepared" / HIGH / "preparation.json"
    record.unlink()
    record.mkdir()
    first, second = project.apply(execution=IN_PROCESS)
    assert isinstance(first, Failed) and str(record) in first.error and second.status == "edited"
    assert "preparation.json" in (project.status(workers=0).assets[0].error or "")


def test_labels_of_a_split_hull_go_to_its_parts_and_come_back(tmp_path: Path) -> None:
    project = labelled(tmp_path)
    before = json.loads((project.folder / "labels" / f"{FIRST}.json").read_text())
    done = project.cut(FIRST, "top", (1, 0, 0), (1, 0, 0))
    assert done.hulls == ("top#0", "top#1")
    assert done.notes == ("labels of top went to top#0, top#1",)
    mesh = project.mesh(FIRST)
    assert [(mesh.hull_of(n).label, mesh.hull_of(n).source) for n in done.hulls] == [("top", "file")] * 2
    found = project.status(workers=0).assets[0]
    assert (found.hulls, found.labelled, found.doubtful) == (7, 7, ())
    project.unprepare(FIRST)
    assert json.loads((project.folder / "labels" / f"{FIRST}.json").read_text()) == before
    assert not (project.folder / "prepared" / FIRST).exists()


def test_a_hull_between_two_labels_takes_that_of_its_greater_part_with_less_confidence(tmp_path: Path) -> None:
    write_boxes(tmp_path / "assets/row.obj")
    project = Project.create(tmp_path / "p", [tmp_path / "assets"], vocabulary=["a", "b"])
    project.cut("row.obj", "geom0#1", (2.5, 0, 0), (1, 0, 0))
    project.set_labels("row.obj", {"geom0#1#0": "a", "geom0#1#1": "b"})
    done = project.unprepare("row.obj")
    whole = project.mesh("row.obj").hull_of("geom0#1")
    assert (whole.label, whole.source) == ("a", "propagated")
    assert whole.confidence == pytest.approx(0.75)
    assert done.undone == ("geom0#1 cut into 2 hulls",)
    assert "no hull takes over the label b" in done.notes


def test_a_demonstration_that_names_a_split_hull_names_its_parts_and_is_flagged(tmp_path: Path) -> None:
    project = applied(tmp_path)
    done = project.cut(FIRST, "crumb", (5.05, 5.05, 5.05), (0, 0, 1))
    assert any("look whether all parts are meant" in note for note in done.notes)
    assert project.steps(FIRST)[0].select == frozenset({"crumb#0", "crumb#1"})
    found = project.status(workers=0).assets
    assert found[0].flags == (
        "crumb, which is demonstrated for rule 1, was split into crumb#0, crumb#1: look whether all parts are meant",
    )
    assert found[1].flags == ()
    project.demonstrate(FIRST, [Step(1, {"crumb#0", "crumb#1"}, Delete()), *project.steps(FIRST)[1:]])
    assert project.status(workers=0).assets[0].flags == ()
    assert isinstance(project.synthesize(), Found)


def test_all_that_was_done_can_be_taken_back_also_where_it_is_damaged(tmp_path: Path) -> None:
    project = decomposed(tmp_path)
    project.cut(HIGH, "frame/foot", (0, 0, -1), (1, 0, 0))
    assert len(project.unprepare(HIGH, everything=True).undone) == 2
    assert names(project, HIGH) == ["frame/foot"]
    with pytest.raises(ProjectError, match="nothing was done"):
        project.unprepare(HIGH)
    (project.folder / "prepared" / LOW / "hulls.obj").write_text("o nothing\n")
    with pytest.raises(AssetError, match="damaged"):
        project.mesh(LOW)
    project.unprepare(LOW, everything=True)
    assert names(project, LOW) == ["frame/foot"]


def test_the_status_says_what_could_be_decomposed(tmp_path: Path) -> None:
    project = fresh(tmp_path)
    assert [(a.hulls, a.sources, a.prepared) for a in project.status(workers=0).assets] == [(1, 2, ())] * 2
    path = tmp_path / "assets" / HIGH
    foot = '<collision name="foot"><origin xyz="0 0 -1"/><geometry><box size="4 1 1"/></geometry></collision>'
    path.write_text(path.read_text().replace(foot, ""))
    found = project.status(workers=0)
    assert found.assets[0].hulls == 0
    assert found.next.command == f"meshforge prepare {project.folder} --decompose coacd"
    list(project.decompose(settings=QUICK, execution=IN_PROCESS))
    assert "prepare" not in (project.status(workers=0).next.command or "")


CHANGES: dict[str, Callable[[Project], object]] = {
    "cut": lambda p: p.cut(SECOND, "top", (1, 0, 0), (1, 0, 0)),
    "cut again": lambda p: p.cut(FIRST, "top#0", (0.5, 0, 0), (1, 0, 0)),
    "undo": lambda p: p.unprepare(FIRST),
}


@pytest.mark.slow
@needs_fork
@pytest.mark.parametrize("name", CHANGES)
def test_a_killed_change_leaves_hulls_and_labels_whole(tmp_path: Path, name: str) -> None:
    project = labelled(tmp_path)
    project.cut(FIRST, "top", (1, 0, 0), (1, 0, 0))
    shutil.copytree(project.folder, tmp_path / "before")
    states = [state(project)]

    def afresh() -> None:
        shutil.rmtree(project.folder)
        shutil.copytree(tmp_path / "before", project.folder)
        CHANGES[name](project)

    died = [state(project) for _ in deaths(afresh)]
    states.append(state(project))
    assert len(died) > 1 and all(found in states for found in died)
    assert states[0] != states[1] and {found == states[1] for found in died} == {True, False}


def state(project: Project) -> list[tuple[str, str | None]]:
    return [(hull.name, hull.label) for asset in project.assets() for hull in project.mesh(asset).hulls]
