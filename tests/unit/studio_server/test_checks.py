from collections.abc import Iterator
from concurrent.futures import CancelledError
from pathlib import Path
from typing import Any, Literal

import pytest

from meshforge.batch import IN_PROCESS, CheckTask, check_asset
from meshforge.batch.provenance import read_stamp, stamp_path
from meshforge.checks import CheckOptions
from meshforge.common import ProjectError
from meshforge.engines import ENGINES
from meshforge.project import Project
from meshforge.studio.jobs.outputs import to_line
from meshforge.studio.output_checks import CHECK_PARTS, OutputChecks, ResultCache, _measure_all
from meshforge.studio.output_measures import MeasureTask, check_key
from meshforge.studio.wire.asset import CheckResult, Fault
from meshforge.studio.workers import Workers, project_of_one
from tests.cup_project import BARE, CUP, FILLED, cup_project


@pytest.fixture(scope="module")
def workers() -> Iterator[Workers]:
    made = Workers(1)
    yield made
    made.close()


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory) -> Project:
    return cup_project(tmp_path_factory.mktemp("cups"))


@pytest.fixture(scope="module")
def checks(project: Project, workers: Workers) -> OutputChecks:
    return OutputChecks(project.folder / ".meshforge" / "studio" / "checks", workers)


def key_of(project: Project, asset: str) -> str:
    key = check_key(read_stamp(project.layout.edited, asset))
    assert key
    return key


def figures(checked: CheckResult) -> dict[str, tuple[float | None, float | None]]:
    return {figure.what: (figure.before, figure.after) for figure in checked.figures}


def told(project: Project, of: Literal["asset", "output"], measures: CheckOptions) -> dict[str, Any]:
    """What `meshforge check` tells of the cup, or of its output against it."""
    source, folder = project.path(CUP), project.layout.edited
    path, against = (source, None) if of == "asset" else (folder / CUP, source)
    return check_asset(path, path.parent, None, CheckTask(measures, against=against)).to_json()


@pytest.mark.slow
def test_the_figures_are_those_of_the_command_line(project: Project, checks: OutputChecks) -> None:
    everything = CheckOptions(("fit", "clearance", "physics"))
    was, now = told(project, "asset", everything), told(project, "output", everything)
    fit = figures(checks.check_part(project, CUP, "fit").result(60))
    assert fit["Hulls stick out, at most"] == (was["fit"]["out"], now["fit"]["out"])
    assert fit["Visual surface uncovered"] == (100 * was["fit"]["bare_share"], 100 * now["fit"]["bare_share"])
    space = figures(checks.check_part(project, CUP, "clearance").result(60))
    assert space["Closed, against the visual"] == (was["clearance"]["closed"], now["clearance"]["closed"])
    assert space["Closed by the edit"] == (None, now["clearance_of_edit"]["closed"])
    rest = figures(checks.check_part(project, CUP, "physics").result(60))
    assert rest["Turned"] == (now["physics_before"]["rest"]["tilt"], now["physics"]["rest"]["tilt"])
    assert rest["Mass"] == pytest.approx((0.424, 1.0))
    parts = [checks.check_part(project, CUP, part).result(60) for part in CHECK_PARTS]
    found = [(f.rule, list(f.hulls), f.text) for part in parts for f in part.findings]
    assert sorted(found) == sorted((f["rule"], f["hulls"], f["message"]) for f in now["findings"])
    assert {name for _, hulls, _ in found for name in hulls} == {FILLED}


def test_limits_of_every_engine_are_told_with_its_name(project: Project, checks: OutputChecks) -> None:
    limits = checks.check_part(project, CUP, "engines").result(60)
    assert {f.engine for f in limits.findings} <= {None, *ENGINES}
    for engine in ENGINES:
        wanted = {f["message"] for f in told(project, "output", CheckOptions((engine,)))["findings"]}
        assert {f.text for f in limits.findings if f.engine in (None, engine)} == wanted


@pytest.mark.slow
def test_an_asset_that_shows_nothing_says_so_and_is_measured_otherwise(project: Project, checks: OutputChecks) -> None:
    fit = checks.check_part(project, BARE, "fit").result(60)
    assert fit.figures == () and not fit.pictured and "nothing is shown" in fit.notes[0]
    space = checks.check_part(project, BARE, "clearance").result(60)
    assert set(figures(space)) == {"Closed by the edit", "Opened by the edit"} and space.pictured
    (picture,) = checks.draw_pictures(project, BARE, "clearance", "mm").result(60)
    assert picture.source.startswith("data:image/webp") and "mm" not in picture.text


@pytest.mark.slow
def test_all_results_are_checked_once_and_known_after_a_restart(project: Project, checks: OutputChecks) -> None:
    over: list[None] = []
    first = dict(checks.check_all(project, (CUP, BARE), lambda: over.append(None), lambda: False))
    assert len(over) == 2
    assert all(isinstance(found, tuple) and found for found in first.values())
    workers_never = Workers(1)
    workers_never.close()
    again = OutputChecks(project.folder / ".meshforge" / "studio" / "checks", workers_never)
    assert dict(again.check_all(project, (CUP, BARE), lambda: None, lambda: True)) == first
    assert again.faults_of(key_of(project, CUP)) == first[CUP]
    assert again.check_part(project, CUP, "fit").result(0).part == "fit"


def test_another_output_is_checked_anew_and_a_changed_asset_not_at_all(tmp_path: Path, workers: Workers) -> None:
    project = cup_project(tmp_path)
    checks, before = OutputChecks(tmp_path / "checks", workers), key_of(project, BARE)
    output = project.layout.edited / BARE
    text = output.read_text()
    output.write_text(text + " ")
    with pytest.raises(ProjectError, match="files of its output are gone or changed"):
        checks.check_part(project, BARE, "engines").result(60)
    output.write_text(text)
    source = project.path(BARE)
    source.write_text(source.read_text() + " ")
    with pytest.raises(ProjectError, match="the asset changed since its output was made"):
        checks.check_part(project, BARE, "engines").result(60)
    list(project.apply([BARE], execution=IN_PROCESS))
    assert key_of(project, BARE) != before
    assert checks.faults_of(key_of(project, BARE)) is None
    assert checks.check_part(project, BARE, "engines").result(60).findings == ()
    gone = MeasureTask(project_of_one(project, BARE), BARE, before)
    assert "another by now" in (_measure_all((gone, ResultCache(tmp_path / "other"))) or "")


def test_an_output_that_went_meanwhile_does_not_stop_the_others(project: Project, checks: OutputChecks) -> None:
    found = dict(checks.check_all(project, (CUP, BARE), lambda: None, lambda: False))
    stamp = stamp_path(project.layout.edited, CUP)
    kept = stamp.read_bytes()
    stamp.unlink()
    try:
        later = dict(checks.check_all(project, (CUP, BARE), lambda: None, lambda: False))
    finally:
        stamp.write_bytes(kept)
    assert "no output" in str(later[CUP]) and later[BARE] == found[BARE]


def test_what_nobody_waits_for_any_more_ends(project: Project, tmp_path: Path) -> None:
    workers = Workers(1)
    try:
        running = OutputChecks(tmp_path, workers).check_part(project, CUP, "fit")
        assert running.cancel()
        with pytest.raises(CancelledError):
            running.result(60)
        assert OutputChecks(tmp_path, workers).check_part(project, BARE, "fit").result(60).part == "fit"
    finally:
        workers.close()


def test_a_file_that_cannot_be_read_counts_as_not_measured(tmp_path: Path) -> None:
    shelf = ResultCache(tmp_path)
    for part in CHECK_PARTS:
        shelf.write("k", CheckResult(part=part))
    assert shelf.missing_parts("k") == () and shelf.read_faults("k") == ()
    (tmp_path / "k.fit.json").write_text("{")
    assert shelf.read("k", "fit") is None and shelf.read_faults("k") is None and shelf.missing_parts("k") == ("fit",)


def test_a_line_tells_what_does_not_hold_or_why_that_is_not_known() -> None:
    own = Fault(rule="fit-out", severity="warning")
    engines = Fault(rule="unity-thin", severity="warning", engine="unity")
    assert to_line("a", (own, engines)).text == "fit-out"
    assert to_line("a", ()).status == "done"
    assert to_line("a", "it died").status == "failed"
