import asyncio
import json
from pathlib import Path

from meshforge.labels import OfferCache
from meshforge.project import NextStep, Project
from meshforge.store import History
from meshforge.store.history import HistoryState
from meshforge.studio.label_changes import LabelChanges
from meshforge.studio.output_checks import OutputChecks
from meshforge.studio.pages import PageConnection, PageHub, PageState
from meshforge.studio.session.refresh import Refresher
from meshforge.studio.wire.events import OutcomeChanged, ProgramChanged, ProjectChanged
from meshforge.studio.wire.family import Card, OrientView, ProjectView
from meshforge.studio.wire.jobs import Job
from meshforge.studio.wire.program import OutcomeView, ProgramView
from meshforge.studio.workers import Workers
from tests.studio_project import demo_project

NO_HISTORY = HistoryState(None, None, 0, 0)
PROJECT = ProjectView(name="p", folder="/p", vocabulary=(), next=NextStep("label", "Label."), orient=OrientView())


def test_a_page_is_told_everything_first_and_then_only_what_changes() -> None:
    async def told() -> list[str]:
        shown = PageState(PageHub(), PROJECT, NO_HISTORY, "1", tour=False)
        shown.set_assets(["a", "b"])
        page = PageConnection(asyncio.get_running_loop())
        shown.join(page)
        shown.set_cards([Card(asset="a"), Card(asset="b", hulls=1)])
        shown.show(ProjectChanged(project=PROJECT))
        shown.set_assets(["b", "c"])
        await asyncio.sleep(0)
        return [await page.events.get() or "" for _ in range(page.events.qsize())]

    hello, cards, assets = map(json.loads, asyncio.run(told()))
    assert [card["asset"] for card in hello["cards"]] == ["a", "b"]
    assert [(card["asset"], card["hulls"]) for card in cards["cards"]] == [("b", 1)]
    assert [card["asset"] for card in assets["cards"]] == ["c"] and assets["gone"] == ["a"]


def test_a_card_of_an_asset_that_went_meanwhile_does_not_bring_it_back() -> None:
    shown = PageState(PageHub(), PROJECT, NO_HISTORY, "1", tour=False)
    shown.set_assets(["a", "b"])
    shown.set_assets(["a"])
    shown.set_cards([Card(asset="a", hulls=1), Card(asset="b", error="it is gone")])
    assert shown.cards == (Card(asset="a", hulls=1),)


def test_a_page_that_left_is_told_nothing() -> None:
    async def told() -> int:
        hub = PageHub()
        page = PageConnection(asyncio.get_running_loop())
        hub.join(page, PROJECT)
        hub.leave(page)
        hub.broadcast(PROJECT)
        await asyncio.sleep(0)
        return page.events.qsize()

    assert asyncio.run(told()) == 1


def test_the_next_step_is_never_to_learn_what_is_being_learned(tmp_path: Path) -> None:
    project = demo_project(tmp_path)
    history = History.open(project.folder)
    shown = PageState(PageHub(), PROJECT, NO_HISTORY, "1")
    checks = OutputChecks(tmp_path / "checks", Workers(1))
    refresher = Refresher(lambda: project, shown, checks, LabelChanges(history), OfferCache())

    def next_text() -> str:
        refresher.refresh(())
        return shown.shown.project.next.text

    shown.set_assets(project.assets())
    refresher.refresh(project.assets())
    assert next_text() == "Learn the program from what is demonstrated."
    shown.show(OutcomeChanged(outcome=None, learning=True))
    assert next_text() == "The program is being learned."
    program = ProgramView(text="All => Delete\n", version="1")
    shown.show(ProgramChanged(program=program))  # before pages see that the run is over
    assert next_text() == "The program is being learned."
    shown.show(OutcomeChanged(outcome=OutcomeView(number=1, status="found", program="All => Delete\n"), learning=False))
    assert "Apply" in next_text()


def test_the_next_step_is_never_what_a_job_does_now(tmp_path: Path) -> None:
    project = demo_project(tmp_path)
    (project.folder / "program.mf").write_text("All => Delete\n")
    shown = PageState(PageHub(), PROJECT, NO_HISTORY, "1")
    checks, history = OutputChecks(tmp_path / "checks", Workers(1)), History.open(project.folder)
    refresher = Refresher(lambda: project, shown, checks, LabelChanges(history), OfferCache())
    shown.set_assets(project.assets())
    shown.show(ProgramChanged(program=ProgramView(text="All => Delete\n", version="1")))
    refresher.refresh(project.assets())
    assert "Apply" in shown.shown.project.next.text
    job = Job(id="1", kind="apply", title="Applying the program to 14 assets")
    refresher.show_job(job)
    assert shown.shown.project.next.text == job.title, "at once"
    refresher.refresh(())
    assert shown.shown.project.next.text == job.title
    refresher.show_job(job.model_copy(update={"state": "cancelled"}))
    refresher.refresh(())
    assert "Apply the program" in shown.shown.project.next.text


def test_a_project_that_cannot_be_read_shows_what_its_settings_say_now(tmp_path: Path) -> None:
    project = demo_project(tmp_path)
    text = project.layout.settings.read_text() + '\n[goals]\nbad = "flies("\n'
    project.layout.settings.write_text(text)
    changed = Project.open(project.folder)
    shown = PageState(PageHub(), PROJECT, NO_HISTORY, "1")  # as a refresh leaves it that began before
    checks = OutputChecks(tmp_path / "checks", Workers(1))
    Refresher(lambda: changed, shown, checks, LabelChanges(History.open(project.folder)), OfferCache()).refresh(())
    view = shown.shown.project
    assert view.problem and "bad" in view.problem
    assert [(goal.name, bool(goal.error)) for goal in view.goals] == [("bad", True)]
    assert [label.name for label in view.vocabulary] == list(changed.words)
