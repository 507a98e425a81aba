import json
from pathlib import Path

import pytest

from meshforge.batch import ReportAsset, ReportHeader, write_report
from meshforge.checks import CheckOptions, draw_examination, examine_mesh
from meshforge.language import Program
from tests.cup_project import cup_urdf
from tests.cups import BOTTOM, WALLS, WHOLE, cup
from tests.unit.cli.in_process import Run

ALL = CheckOptions.of(["mujoco", "fit", "clearance", "physics"])


@pytest.fixture
def run(run: Run) -> Run:
    for folder, hulls in (("before", (BOTTOM, *WALLS)), ("after", (WHOLE,))):
        Path(folder).mkdir()
        Path(folder, "cup.urdf").write_text(cup_urdf(True, hulls))
    return run


def test_all_that_is_asked_for_comes_with_its_findings() -> None:
    found = examine_mesh(cup(WHOLE), ALL, cup(BOTTOM, *WALLS))
    assert {f.rule for f in found.findings} == {"fit-out", "clearance-closed"}
    assert sorted(found.to_json()) == ["clearance", "clearance_of_edit", "fit", "physics", "physics_before"]
    assert len(found.descriptions) == 5


def test_what_is_not_asked_for_is_not_measured() -> None:
    found = examine_mesh(cup(WHOLE), CheckOptions())
    assert found.to_json() == {} and found.descriptions == () and found.findings == ()


def test_an_asset_that_shows_nothing_says_so() -> None:
    found = examine_mesh(cup(WHOLE, shown=()), CheckOptions(("fit", "clearance")))
    assert found.descriptions == (f"note: {found.notes[0]}",) and "nothing is shown" in found.notes[0]
    assert list(draw_examination(cup(WHOLE, shown=()), found)) == []


@pytest.mark.slow
def test_the_command_line_measures_an_edit_against_what_was_before(run: Run) -> None:
    told = run(
        "check", "after", "--fit", "--clearance", "--physics", "--against", "before", "--pictures", "out", "--json"
    )
    line = json.loads(told.out)
    assert told.code == 0
    assert line["clearance"]["closed"] == pytest.approx(0.576, rel=0.1)
    assert line["clearance_of_edit"]["reference"] == "hulls before"
    assert line["clearance_of_edit"]["closed"] == pytest.approx(0.576, rel=0.05)
    assert line["fit"]["out"] == pytest.approx(0.04, rel=0.02)
    assert line["physics"]["rest"]["tilt"] < 1
    assert sorted(Path(name).name for name in line["pictures"]) == [
        "cup.urdf.clearance-of-edit.png",
        "cup.urdf.clearance.png",
        "cup.urdf.fit-bare.png",
        "cup.urdf.fit-out.png",
    ]
    assert all(Path(name).read_bytes().startswith(b"\x89PNG") for name in line["pictures"])


def test_the_text_tells_each_measure_in_a_line(run: Run) -> None:
    told = run("check", "before", "--fit", "--clearance", "--physics").out.splitlines()
    assert [line.split(":")[0] for line in told[1:]] == ["  fit", "  clearance", "  physics"]


def test_a_missing_asset_to_compare_with_is_told(run: Run) -> None:
    Path("empty").mkdir()
    told = run("check", "after", "--clearance", "--against", "empty")
    assert told.code == 1 and "there is no such asset to compare with" in told.out


@pytest.mark.parametrize(
    ("words", "problem"),
    [
        (("--cell", "0.1"), "--cell says nothing without --fit or --clearance"),
        (("--pictures", "out"), "--pictures says nothing without --fit, --clearance or --pairs"),
        (("--fit", "--against", "before"), "--against says nothing without --clearance or --physics"),
    ],
)
def test_options_that_say_nothing_are_refused(run: Run, words: tuple[str, ...], problem: str) -> None:
    told = run("check", "after", *words)
    assert told.code == 2 and problem in told.err


@pytest.mark.slow
def test_the_report_shows_what_was_found_failures_first(tmp_path: Path) -> None:
    good, bad = cup(BOTTOM, *WALLS), cup(WHOLE)
    assets = [
        ReportAsset("unmeasured", good, good),
        ReportAsset("fine", good, good, checked=examine_mesh(good, ALL)),
        ReportAsset("filled", bad, bad, checked=examine_mesh(bad, ALL)),
        ReportAsset("gone", None, status="failed", error="it cannot be read"),
    ]
    write_report(tmp_path / "report.html", ReportHeader("Cups"), assets, program=Program())
    page = (tmp_path / "report.html").read_text("utf-8")
    places = [page.index(f'data-name="{name}"') for name in ("gone", "filled", "unmeasured", "fine")]
    assert places == sorted(places)
    assert "checks: 0 errors, 2 warnings" in page and "checks: no findings" in page
    assert "free and reachable in the visual mesh, closed by h0" in page
    assert page.count("<figure>") == 2 + 3  # two heat maps each, and what is closed
    assert 'data-kind="edited doubtful"' in page
