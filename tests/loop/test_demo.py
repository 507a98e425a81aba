"""The demo, as a newcomer runs it."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from lxml import html

from meshforge.formats import load
from meshforge.language import Program
from meshforge.samples import TABLES
from meshforge.symbolic import mask_of, split_by_contact
from tests.loop.command import Done, meshforge, meshforge_here


@pytest.fixture(scope="module")
def shown(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Done]:
    """The folder of a demo, and what it printed."""
    folder = tmp_path_factory.mktemp("demo")
    return folder, meshforge("demo", cwd=folder)


def test_the_demo_learns_the_five_rules(shown: tuple[Path, Done]) -> None:
    learned = Program.read(shown[0] / "meshforge-demo" / "project" / "program.mf")
    assert learned == Program.read(TABLES / "tables.mf")
    assert len(learned.rules) == 5


def test_the_demo_tells_what_happened_and_where_the_report_is(shown: tuple[Path, Done]) -> None:
    said = shown[1].out
    assert "14 tables" in said
    assert re.search(r"It ran on all 14 in [\d.]+ s: \d+ hulls became \d+, every hull legal", said)
    assert "meshforge-demo/report.html" in said
    prose = [line for line in said.splitlines() if line and not line.startswith("    ")]
    assert len(prose) <= 10


def test_every_table_comes_back_mended(shown: tuple[Path, Done]) -> None:
    for source in sorted(TABLES.glob("*.obj")):
        before, after = load(source), load(shown[0] / "meshforge-demo" / "project" / "edited" / source.name)
        count = {label: sum(h.label == label for h in after.hulls) for label in ("misc", "panel", "leg", "drawer")}
        assert count["misc"] == 0
        assert count["drawer"] % 5 == 0  # every tray is a floor and four walls
        assert [h.volume for h in after.hulls if h.source != "edit"] == [
            before.hull_of(h.name).volume for h in after.hulls if h.source != "edit"
        ]
        legs = split_by_contact(before, mask_of(k for k, hull in enumerate(before.hulls) if hull.label == "leg"))
        assert count["leg"] == len(legs)


def test_simcheck_finds_no_error_in_the_tables(shown: tuple[Path, Done]) -> None:
    edited = shown[0] / "meshforge-demo" / "project" / "edited"
    found = meshforge_here("check", edited, "--second-opinion", "simcheck", "--json", cwd=shown[0]).lines
    assert len(found) == 14 and all(one["simcheck"]["counts"]["error"] == 0 for one in found)


def test_the_report_shows_every_table_and_every_rule(shown: tuple[Path, Done]) -> None:
    page = html.document_fromstring((shown[0] / "meshforge-demo" / "report.html").read_bytes())
    text = "".join(map(str, page.itertext()))
    assert all(source.name in text for source in TABLES.glob("*.obj"))
    assert text.count("demonstrated") >= 2
    assert "Each connected group of leg hulls is merged" in text
    assert len(page.findall(".//img")) >= 28


def test_a_demo_never_replaces_a_folder_of_yours(tmp_path: Path) -> None:
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "thesis.txt").write_text("do not lose me")
    refused = meshforge_here("demo", "--out", "mine", cwd=tmp_path, code=2)
    assert "holds something else" in refused.err
    assert (tmp_path / "mine" / "thesis.txt").read_text() == "do not lose me"
