"""The report: one page, whole, about every asset and rule, safe with any name."""

import base64
import re
from collections.abc import Sequence
from io import BytesIO
from pathlib import Path
from typing import Any

import lxml.html
import pytest
from PIL import Image

from meshforge.batch import Failed, ReportAsset, ReportHeader, ReportOptions, RunFigures, RunSummary, write_report
from meshforge.batch.outcome import Unchanged
from meshforge.checks import Examination, Finding
from meshforge.language import Program, RuleTrace, explain, show
from meshforge.signoff import Reason, ResultStatus, ResultStatusWord
from meshforge.symbolic import SymbolicMesh
from tests.unit.batch.pages import opened, texts
from tests.unit.rendering.scenes import box, hull, table

PROGRAM = Program.parse(
    """\
labels panel, leg, "odd <label>"

# boards first
Is(panel)              => Merge
Is("odd <label>")      => Delete  # never seen
Attach(All, Is(panel)) => Each(Replace("a <b>.obj"))
"""
)
NASTY = '<script>alert("hull")</script>'


def nasty() -> SymbolicMesh:
    return SymbolicMesh((hull(NASTY, box((0, 0, 0), (1, 1, 1)), "odd <label>"), hull("b", box((2, 0, 0), (1, 1, 1)))))


def assets() -> list[ReportAsset]:
    mesh = table()
    merged = SymbolicMesh((*mesh.hulls[2:], hull("left~1", box((0, 0, 0.7), (1.2, 0.8, 0.04)), "panel")))
    trace = (RuleTrace(1, ("left", "right"), ("left~1",), "a note & more"), RuleTrace(2, ()), RuleTrace(3, ()))
    return [
        ReportAsset("shown/table.urdf", mesh, merged, trace, demonstrated=True),
        ReportAsset(f"{NASTY}.obj", nasty(), nasty(), (RuleTrace(1, ()), RuleTrace(2, (NASTY,))), "unchanged"),
        ReportAsset("broken.obj", None, None, (), "failed", "broken.obj: no <faces>\n  Mend it."),
        ReportAsset("stuck.obj", mesh, None, (), "failed", "stuck.obj: no labels"),
    ]


def written(path: Path, what: Sequence[ReportAsset], **options: Any) -> str:
    header = ReportHeader("Tables & <co>", *(options.pop(key, None) for key in ("about", "seconds", "figures")))
    write_report(path / "report.html", header, what, program=PROGRAM, options=ReportOptions(**options))
    return (path / "report.html").read_text("utf-8")


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> str:
    return written(tmp_path_factory.mktemp("report"), assets(), seconds=3.21, about="four <assets>")


@pytest.fixture(scope="module")
def tree(page: str) -> Any:
    return lxml.html.document_fromstring(page, parser=lxml.html.HTMLParser(recover=False))


def cells(tree: Any, path: str) -> list[list[str]]:
    return [texts(row, "./*") for row in tree.xpath(path)]


def test_the_page_refers_to_nothing_outside_itself(page: str, tree: Any) -> None:
    without_pictures = re.sub(r"data:image/webp;base64,[\w+/=]+", "", page)
    assert not re.search(r"(https?:)?//\w|url\(|@import|<link|<iframe", without_pictures)
    for address in tree.xpath("//@src | //@href"):
        assert address.startswith("data:image/webp;base64,")
    assert "default-src 'none'" in page


def test_every_rule_is_there_with_its_sentence_and_figures(tree: Any) -> None:
    rows = cells(tree, "//table[@class='program']//tr")
    assert len(rows) == 1 + len(PROGRAM.rules)
    for rule, row in zip(PROGRAM.rules, rows[1:], strict=True):
        assert row[1].startswith(show(rule) + explain(rule))
    assert rows[1][1].endswith("# boards first")
    assert rows[1][2] == "2 hulls on 1 of 2 assets, 1 made"
    assert rows[2][1].endswith("# never seen")
    assert rows[3][2] == "selected nothing"


def test_names_are_shown_and_never_run(page: str, tree: Any) -> None:
    assert NASTY not in page
    assert len(tree.xpath("//script")) == 1
    assert any(NASTY in row for row in texts(tree, "//article//tr"))
    assert texts(tree, "//h1") == ["Tables & <co>"]


@pytest.mark.slow
def test_of_a_large_run_the_headline_tells_all_and_how_many_are_shown(tmp_path: Path) -> None:
    summary = RunSummary()
    for k in range(5000):
        summary.add(Failed(f"bad{k}", "no", 0.0) if k < 2 else Unchanged(f"a{k}", "o", (), 3, 2, 0.0))
    page: Any = lxml.html.document_fromstring(written(tmp_path, assets(), figures=RunFigures.of_run(summary)))
    figures = dict(zip(texts(page, "//dl//dt"), texts(page, "//dl//dd"), strict=True))
    assert figures == {"assets": "5,000", "unchanged": "4,998", "failed": "2", "hulls": "14,994 → 9,996 −33 %"}
    assert "4 of 5,000 assets are shown, those that failed first." in texts(page, "//p")


def test_the_legend_counts_labels_before_and_after(tree: Any) -> None:
    legend = texts(tree, "//ul[@class='legend']/li")
    assert legend == ["panel 2 → 1", "leg 2", "odd <label> 1", "no label 2", "hatched: an unsure label"]
    assert texts(tree, "//ul[@class='legend of-changes']/li") == ["removed 2", "made 1", "kept 5"]


def test_of_a_project_what_is_held_or_failed_comes_first_then_alarms_the_least_sure_first(tmp_path: Path) -> None:
    def asset(name: str, word: ResultStatusWord, probability: float | None, **more: Any) -> ReportAsset:
        standing = ResultStatus(
            probability, (Reason("candidate", "rule 1 may mean <b>"),), word, found_since=("<now>",)
        )
        return ReportAsset(name, table(), table(), result_status=standing, **more)

    shown = [
        asset("surest", "signed off", 0.99),
        asset("given up", "excluded", 0.2),
        asset("odd", "signed off", 0.98, alarms=("volume +480%",)),
        asset("needs review", "needs review", 0.94),
        asset("unwritten", "sure", 0.97, error="no room on the disk", status="failed"),
        asset("least", "needs review", 0.3),
        asset("unknown", "needs review", None),
    ]
    page: Any = lxml.html.document_fromstring(written(tmp_path, shown, pictured=0))
    names = ["unknown", "least", "needs review", "unwritten", "odd", "given up", "surest"]
    assert texts(page, "//article//bdi") == names
    assert page.xpath("//article/@data-kind")[3:] == [
        "failed sure",
        "edited signed-off doubtful",
        "edited excluded",
        "edited signed-off",
    ]
    assert texts(page, "//article/p[@class='result-status needs-review']") == [
        f"{share}needs review; found since: <now>" for share in ("", "30% sure, ", "94% sure, ")
    ]
    assert texts(page, "//ul[@class='reasons']/li") == ["rule 1 may mean <b>"] * 7
    words = ["all", "edited", "failed", "needs review", "sure", "signed off", "excluded", "doubtful"]
    assert texts(page, "//span[@id='kinds']/button") == words
    assert page.xpath("//div[@class='bar']/i/@class") == ["needs-review", "sure", "signed-off", "excluded"]


def test_long_lists_of_notes_and_findings_are_cut_and_counted(tmp_path: Path) -> None:
    mesh = SymbolicMesh(table().hulls[:1])
    found = Examination(tuple(Finding("odd", "warning", (), f"odd {k}", "Mend it.") for k in range(50)))
    notes = tuple(f"note {k}" for k in range(9))
    asset = ReportAsset("a", mesh, mesh, notes=notes, checked=found)
    write_report(tmp_path / "r.html", ReportHeader("Checks"), [asset], options=ReportOptions(pictured=0))
    page = opened(tmp_path / "r.html")
    assert texts(page, "//article/p") == list(notes[:6]) and texts(page, "//summary")[0] == "and 3 more"
    assert texts(page, "//ul[@class='findings']/li")[39:] == ["warning odd 39 Mend it.", "and 10 more"]


def test_what_each_rule_did_to_an_asset_is_listed(tree: Any) -> None:
    rows = cells(tree, "(//article)[1]//tbody/tr")
    assert rows[0] == ["1", "Is(panel) => Mergea note & more", "2 left, right", "1 left~1"]
    assert rows[1] == ["2", 'Is("odd <label>") => Delete', "–", "–"]
    assert len(rows) == 3


def test_edited_assets_have_three_pictures_and_others_one_or_none(tree: Any) -> None:
    kinds = [[i.get("class") for i in article.xpath(".//img")] for article in tree.xpath("//article")]
    assert kinds == [["before", "after", "changes"], ["only"], [], ["only"]]
    for source in tree.xpath("//img/@src"):
        with Image.open(BytesIO(base64.b64decode(source.partition(",")[2]))) as picture:
            assert picture.size == (600, 450)
            assert picture.mode == "RGBA"


def test_only_so_many_assets_get_pictures_demonstrated_and_failed_ones_first(tmp_path: Path) -> None:
    mesh = SymbolicMesh(table().hulls[:1])
    many = [ReportAsset(f"{k}.obj", mesh, mesh, (), "unchanged", demonstrated=k == 3) for k in range(4)]
    done: list[int] = []
    text = written(tmp_path, many, pictured=2, progress=lambda: done.append(1))
    tree: Any = lxml.html.document_fromstring(text)
    assert [len(a.xpath(".//img")) for a in tree.xpath("//article")] == [1, 0, 0, 1]
    assert len(done) == 4


def test_characters_that_no_page_can_hold_are_replaced(tmp_path: Path) -> None:
    mesh = SymbolicMesh((hull("a\x00b\x1b", box((0, 0, 0), (1, 1, 1))),))
    trace = (RuleTrace(1, ("a\x00b\x1b",)),)
    text = written(tmp_path, [ReportAsset("odd\x07.obj", mesh, mesh, trace, "unchanged")], pictured=0)
    assert r"a\x00b\x1b" in text
    assert "odd�.obj" in text
