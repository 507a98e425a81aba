"""`meshforge apply --report`: how sure each result of a project is, and nothing of it without a project."""

import re
from pathlib import Path

import pytest

from meshforge.project import Project
from meshforge.signoff import THRESHOLD
from tests.unit.batch.families import write_tables
from tests.unit.batch.pages import figures, kinds, names, opened, texts
from tests.unit.cli.in_process import Run, runner
from tests.unit.project.tables import FIRST, SECOND, THIRD, applied

HELD = f"2 of 3 are at least {100 * THRESHOLD:g}% sure, or were looked at; look at this one:"


@pytest.fixture
def run(run: Run, tmp_path: Path) -> Run:
    """Runs the command line beside a project of three edited tables, of which two are demonstrated."""
    applied(tmp_path)
    return run


@pytest.fixture
def run_doubtful(run: Run, tmp_path: Path) -> Run:
    """The same with a wrong label on the third table, which a file gave."""
    labels = (tmp_path / "assets" / THIRD).with_suffix(".labels.json")
    labels.write_text(labels.read_text().replace('"left_low": "leg"', '"left_low": "misc"'))
    run("label", "tables", "--with", "file")
    return run


@pytest.mark.slow
def test_what_is_held_comes_first_with_its_doubts_and_nothing_is_green(run_doubtful: Run) -> None:
    run_doubtful("review", "tables", "--json")
    run_doubtful("apply", "tables", "--report", "r.html")
    page = opened("r.html")
    assert names(page) == [THIRD, FIRST, SECOND] and texts(page, "//h1") == ["tables"]
    assert page.xpath("//article/@data-kind")[0] == "edited needs-review"
    assert re.fullmatch(
        r"\d+% sure, needs review", texts(page, "//article[1]/p[@class='result-status needs-review']")[0]
    )
    doubts = [doubt.text for doubt in Project.open("tables").status().open_assets[0].result_status.reasons]
    assert doubts and texts(page, "//article[1]/ul[@class='reasons']/li") == doubts
    assert figures(page) == {
        "assets": "3",
        "edited": "1",
        "skipped": "2",
        "needs review": "1",
        "signed off": "2",
        "hulls": "18 → 9 −50 %",
    }
    assert page.xpath("//div[@class='bar']/i/@class") == ["needs-review", "signed-off"]
    assert "green" not in page.xpath("//style")[0].text and "--good" not in page.xpath("//style")[0].text
    assert texts(page, "//span[@id='kinds']/button") == [
        "all",
        "edited",
        "skipped",
        "needs review",
        "signed off",
        "demonstrated",
    ]


@pytest.mark.slow
def test_the_head_says_what_status_says(run_doubtful: Run) -> None:
    run_doubtful("review", "tables", "--json")
    run_doubtful("apply", "tables", "--report", "r.html")
    head = texts(opened("r.html"), "//div[@class='result-statuses']/p")
    assert head[0] == HELD and re.match(rf"{THIRD} \(\d+%\): left_low, crumb are called misc, and may be leg", head[1])
    assert "\n  ".join(head) in run_doubtful("status", "tables").out


@pytest.mark.slow
def test_what_is_signed_off_says_by_whom(run: Run) -> None:
    run("review", "tables", "--min-confidence", "0.5")
    run("apply", "tables", "--report", "r.html")
    page = opened("r.html")
    told = dict(zip(names(page), texts(page, "//article/p[@class='result-status signed-off']"), strict=True))
    assert told[THIRD].endswith("% sure, signed off by MeshForge")
    assert told[FIRST] == told[SECOND] == "99% sure, signed off by a person"
    Project.open("tables").set_verdict(THIRD, "accepted")
    Project.open("tables").set_verdict(SECOND, "wrong")
    run("apply", "tables", "--report", "r.html")
    page = opened("r.html")
    told = dict(zip(names(page), texts(page, "//article/p[contains(@class, 'result-status')]"), strict=True))
    assert told[THIRD].endswith("signed off by a person") and told[SECOND].endswith("needs review")


@pytest.mark.slow
def test_what_was_not_reviewed_is_held(run: Run) -> None:
    run("apply", "tables", "--report", "r.html")
    page = opened("r.html")
    assert (
        texts(page, "//p[@class='result-status needs-review']") == ["not looked at as it is now (meshforge review)"] * 3
    )
    assert figures(page)["needs review"] == "3" and "signed off" not in figures(page)


@pytest.mark.slow
def test_what_was_held_back_is_shown_as_it_would_be(run: Run) -> None:
    Path("tables/edited", THIRD).unlink()
    run("apply", "tables", "--min-confidence", "1", "--report", "r.html")
    page = opened("r.html")
    assert (names(page), kinds(page)) == ([THIRD, FIRST, SECOND], ["not-written", "skipped", "skipped"])
    assert figures(page) | {"hulls": ""} == {
        "assets": "3",
        "skipped": "2",
        "not written": "1",
        "needs review": "1",
        "signed off": "2",
        "hulls": "",
    }
    assert page.xpath("//article[1]//img/@class") == ["before", "after", "changes"]
    told = texts(page, "//article[1]/p[@class='note']")
    assert told == ["Nothing was written: this is what the program would make of it."]
    assert not Path("tables/edited", THIRD).exists()


def test_of_very_many_what_is_held_is_shown_though_it_came_last(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    for module in ("meshforge.batch.report.outcomes", "meshforge.batch.outcome"):
        monkeypatch.setattr(f"{module}.MOST_SHOWN", 1)
    run("review", "tables", "--min-confidence", "1")
    run("apply", "tables", "--report", "r.html")
    page = opened("r.html")
    assert names(page) == [THIRD]
    assert "1 of 3 assets are shown, those that failed or need review first." in texts(page, "//p")


@pytest.mark.slow
def test_without_a_project_nothing_is_said_of_how_sure_it_is_but_alarms_are(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    monkeypatch.chdir(tmp_path)
    write_tables(tmp_path / "assets", 2)
    labels = (tmp_path / "assets" / SECOND).with_suffix(".labels.json")
    labels.write_text(labels.read_text().replace(': "leg"', ': "misc"').replace(': "top"', ': "misc"'))
    Path("p.mf").write_text("Is(misc) => Merge\n")
    run = runner(monkeypatch, capsys)
    assert run("apply", "p.mf", "assets", "--out", "out", "--report", "r.html").code == 0
    page = opened("r.html")
    assert names(page) == [FIRST, SECOND]
    alarms = texts(page, "//p[@class='alarm']")
    assert [alarm.split(":")[:2] for alarm in alarms] == [["This result stands out", " nearly one solid block"]]
    assert page.xpath("//article/@data-kind") == ["unchanged", "edited doubtful"]
    assert page.xpath("//*[contains(@class, 'result-status')]") == []
    assert figures(page) == {"assets": "2", "edited": "1", "unchanged": "1", "hulls": "12 → 7 −42 %"}
    assert " sure" not in page.text_content().replace("unsure", "")
