"""Labels from a model in the studio: the cost is told first, nothing is sent for that, and all is one step back."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser

from tests.e2e.hand import hand, windows
from tests.e2e.studio import Page, Studio, ok, opened
from tests.e2e.walk import PAGE, address
from tests.loopback import KEY, Server, serving
from tests.unit.batch.families import tree
from tests.unit.labels.vlm_family import VARIABLE, family, right, truth

COUNT = 3


@contextmanager
def asking(tmp_path: Path, server: Server | None, *words: str) -> Iterator[Studio]:
    """A studio with tables without labels, whose project names the model of a server, or none."""
    project = family(tmp_path, COUNT)
    if server:
        told = f"""
[vlm]
base_url = "{server.base_url}"
model = "{server.model}"
key_env = "{VARIABLE}"
every_hull = true
size = 256
names = true
input_price = 1.0
output_price = 4.0
"""
        settings = project.folder / "meshforge.toml"
        settings.write_text(settings.read_text(encoding="utf-8") + told, encoding="utf-8")
    with opened(tmp_path, project.folder, *words) as studio:
        studio.settled()
        yield studio


def run(studio: Studio, page: Page, **job: Any) -> dict[str, Any]:
    return page.job(ok(studio.post("/api/jobs", job))["id"])


def model(studio: Studio) -> Any:
    return ok(studio.get("/api/labels/sources"))["model"]


def test_the_cost_comes_first_then_the_labels_as_one_step(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(VARIABLE, KEY)
    with serving(right) as server, asking(tmp_path, server) as studio, studio.page() as page:
        told = model(studio)
        assert (told["name"], told["every_hull"], told["max_cost"], told["why"]) == (server.model, True, None, None)
        forecast = run(studio, page, kind="forecast", every_hull=True)
        assert forecast["message"].startswith(f"{COUNT} questions with ")
        assert "about $0." in forecast["message"]
        assert server.asked == []
        before = tree(tmp_path / "p/labels")
        job = run(studio, page, kind="ask", every_hull=True)
        assert (job["state"], job["done"], job["total"]) == ("done", COUNT, COUNT)
        assert job["message"].startswith(f"{COUNT * len(truth('t000.obj'))} labels taken; $")
        assert len(server.answered) == COUNT
        after = tree(tmp_path / "p/labels")
        assert ok(studio.post("/api/undo"))["message"] == f"labels from {server.model}"
        assert tree(tmp_path / "p/labels") == before
        ok(studio.post("/api/redo"))
        assert tree(tmp_path / "p/labels") == after
        again = run(studio, page, kind="forecast", every_hull=True)
        assert again["message"].startswith("Every question has its answer already")
        assert run(studio, page, kind="ask", every_hull=True)["state"] == "done"
        assert len(server.answered) == COUNT


def test_without_a_key_or_a_model_it_is_said_and_nothing_begins(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv(VARIABLE, raising=False)
    with serving(right) as server, asking(tmp_path / "a", server) as studio:
        assert VARIABLE in model(studio)["why"]
        refused = studio.post("/api/jobs", {"kind": "ask", "every_hull": True})
        assert refused.status_code == 400
        assert VARIABLE in refused.text
        assert server.asked == []
    with asking(tmp_path / "b", None) as studio:
        assert model(studio) is None
        assert studio.post("/api/jobs", {"kind": "forecast", "every_hull": True}).status_code == 400


def test_a_person_labels_meanwhile_and_keeps_what_was_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(VARIABLE, KEY)
    with serving(right) as server, asking(tmp_path, server) as studio, studio.page() as page:
        server.delay = 1.0
        job = ok(studio.post("/api/jobs", {"kind": "ask", "every_hull": True}))["id"]
        studio.edit("label", hulls={"t001.obj": ["crumb"]}, label="leg")
        assert page.job(job)["state"] == "done"
        saved = (tmp_path / "p/labels/t001.obj.json").read_text(encoding="utf-8")
        assert '"label": "leg", "confidence": 1.0, "source": "user"' in saved


def test_a_person_sees_the_cost_before_asking_and_takes_it_all_back(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, browser: Browser
) -> None:
    monkeypatch.setenv(VARIABLE, KEY)
    with serving(right) as server, asking(tmp_path, server, "--page", str(PAGE)) as studio, windows(browser):
        person = hand(browser)
        person.open(address(studio))
        person.click(person.page.get_by_role("button", name="Cost… of asking"))
        person.sees(f"{COUNT} questions with")
        assert server.asked == []
        person.click(person.page.get_by_role("button", name=f"Ask {server.model}"))
        person.sees("labels taken; $")
        person.page.get_by_text("without a label").wait_for(state="hidden")
        person.press("Control+z")
        person.sees("18 without a label")
        assert not person.complaints
