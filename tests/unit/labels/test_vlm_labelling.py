import json
import os
import random
import signal
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

from meshforge.batch import IN_PROCESS, ExecutionOptions
from meshforge.common import MeshForgeError, ProjectError, UsageError
from meshforge.labels.vlm import prompt
from meshforge.labels.vlm.prompt import HullQuestion, MeshHulls, PromptConfig, build_questions
from meshforge.project import Project
from meshforge.symbolic import Label
from tests.loopback import KEY, Asked, Server, labels_as_json, serving, sometimes, status
from tests.unit.batch.families import label_of
from tests.unit.labels.vlm_family import (
    VARIABLE,
    WORDS,
    family,
    forecast,
    hulls,
    label_with_vlm,
    right,
    settings,
    truth,
)

MANY = 200


@pytest.fixture(autouse=True)
def key(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(VARIABLE, KEY)


def labels(project: Project, asset: str) -> dict[str, str]:
    return {name: label.name for name, label in project.labels(asset).labels.items()}


def charged(server: Server) -> float:
    """What the server charged [$], at the prices of `settings`."""
    return (server.usage["input"] + 4 * server.usage["output"]) / 1e6


@pytest.mark.slow
def test_a_model_labels_a_family_and_a_second_run_asks_nothing(tmp_path: Path) -> None:
    project = family(tmp_path, 4)
    with serving(right) as server:
        found = label_with_vlm(project, settings(server))
        assert [report.asset for report in found.outcomes] == list(project.assets())
        assert all((report.taken, report.unlabelled, report.problems) == (6, 0, ()) for report in found.outcomes)
        assert (found.open, found.unasked, found.ended, found.blind) == ({}, (), None, False)
        assert all(labels(project, asset) == truth(asset) for asset in project.assets())
        assert {label.source for label in project.labels("t000.obj").labels.values()} == {"vlm"}
        before, asked = project.labels("t001.obj").labels, len(server.asked)
        again = label_with_vlm(project, settings(server))
        assert [report.same for report in again.outcomes] == [6] * 4
        assert (again.usage.answered, again.usage.cost, len(server.asked)) == (0, 0.0, asked)
        assert project.labels("t001.obj").labels == before


@pytest.mark.slow
def test_drawn_in_worker_processes_it_asks_the_same_and_labels_the_same(tmp_path: Path) -> None:
    asked = []
    for name, spread in (("here", IN_PROCESS), ("workers", ExecutionOptions(workers=2))):
        project = family(tmp_path / name, 5)
        (project.path("t003.obj")).write_text("f 1 2 3\n")
        with serving(right) as server:
            seen = forecast(project, settings(server), spread)
            assert (seen.assets, seen.usage.answered, seen.unreadable) == (4, 4, ("t003.obj",))
            found = label_with_vlm(project, settings(server), execution=spread)
            asked.append(sorted(one.raw for one, _, _ in server.asked))
        assert [report.taken for report in found.outcomes] == [6, 6, 6, 0, 6]
        assert "t003.obj" in found.outcomes[3].problems[0]
        assert all(labels(project, asset) == truth(asset) for asset in project.assets() if asset != "t003.obj")
    assert asked[0] == asked[1]


def lying(asked: Asked) -> str:
    """A model that knows it all, but says for one question in five what is of no use, no vocabulary, or no hull."""
    mood = random.Random(asked.raw).random() * 20
    if mood > 4:
        return right(asked)
    if mood > 3:
        return "As a language model I would rather not."
    if mood > 2:
        return labels_as_json({number: "wheel" for number in asked.numbers if number < 2})
    if mood > 1:
        return labels_as_json({number + 100: "leg" for number in asked.numbers})
    return right(asked)[:-1] + ', "hulls": {"0": "leg", "0": "top"}}'


@pytest.mark.long
def test_two_hundred_meshes_with_a_fifth_of_faults_are_all_labelled_or_named(tmp_path: Path) -> None:
    project = family(tmp_path, MANY)
    hopeless = {f"t{k:03}.obj" for k in (7, 70)}

    def fault(asked: Asked) -> object:
        if asked.asset in hopeless:
            return status(500, "out of order")
        return sometimes(0.2)(asked)

    told = []
    with serving(lying, fault=fault, slow=60.0) as server:
        how = settings(server, concurrency=8, timeout=2.0, retries=6)
        found = label_with_vlm(project, how, report=lambda outcome: told.append(outcome.asset))
        assert len(told) == MANY
        assert [report.asset for report in found.outcomes] == list(project.assets())
        assert (found.unasked, found.ended) == ((), None)
        for report in found.outcomes:  # labelled, or named as unlabelled with the reason
            here = labels(project, report.asset)
            assert here.keys() | found.open.get(report.asset, {}).keys() == set(hulls(report.asset))
            assert here.keys().isdisjoint(found.open.get(report.asset, {}))
            assert report.unlabelled == len(found.open.get(report.asset, {}))
            assert here.items() <= truth(report.asset).items()
            assert bool(report.problems) == (report.asset in hopeless)
        wholly = [asset for asset in project.assets() if labels(project, asset) == truth(asset)]
        assert len(wholly) >= 0.75 * MANY
        assert all(set(found.open[asset].values()) == {"the question got no answer"} for asset in hopeless)
        faults = sum(not whole for asked, _, whole in server.asked if asked.asset not in hopeless)
        assert faults > 0.1 * MANY
        assert max(Counter(asked.raw for asked in server.answered).values()) == 1  # nothing asked twice
        assert found.usage.cost == pytest.approx(charged(server))
        assert (found.usage.input, found.usage.output) == (server.usage["input"], server.usage["output"])
        broken = sum(not whole for _, _, whole in server.asked)  # slow ones may be under way there still
        assert found.usage.retries + len(hopeless) >= broken


def test_assets_that_are_labelled_by_hand_are_not_asked_about(tmp_path: Path) -> None:
    project = family(tmp_path, 2)
    first, second = project.assets()
    project.set_labels(first, truth(first))
    with serving(right) as server:
        found = label_with_vlm(project, settings(server))
        assert {asked.asset for asked in server.answered} == {second}
        assert [report.taken for report in found.outcomes] == [0, 6]


@pytest.fixture
def many_clusters(monkeypatch: pytest.MonkeyPatch) -> None:
    """The tables are so much alike that one shows all clusters."""
    monkeypatch.setattr("meshforge.label_model.similar.RADIUS", 1.0)


@pytest.mark.usefixtures("many_clusters")
@pytest.mark.slow
def test_exemplars_are_asked_about_and_the_rest_is_propagated(tmp_path: Path) -> None:
    project = family(tmp_path, 30)
    first = project.assets()[0]
    project.set_labels(first, truth(first))
    with serving(right) as server:
        found = label_with_vlm(project, settings(server, every_hull=False))
        assert (found.unasked, found.ended, found.open) == ((), None, {})
        asked = server.answered
        assert 1 <= len(asked) <= 7 and all(len({asset for asset, _ in one.hulls.values()}) <= 4 for one in asked)
        assert all("assistant" in {message["role"] for message in one.body["messages"]} for one in asked)  # the example
        assert [report.asset for report in found.outcomes] == list(project.assets())
        assert all(labels(project, asset) == truth(asset) for asset in project.assets())
        said = {(a, h) for a in project.assets() for h, one in project.labels(a).labels.items() if one.source == "vlm"}
        wanted = {hull for one in asked for number, hull in one.hulls.items() if number in one.numbers}
        assert said == {(asset, hull) for asset, hull in wanted if asset != first} and len(said) < 60
        before = len(server.asked)
        again = label_with_vlm(project, settings(server, every_hull=False))
        assert len(server.asked) == before and not any(outcome.taken for outcome in again.outcomes)


@pytest.mark.usefixtures("many_clusters")
@pytest.mark.slow
def test_of_exemplars_what_is_unknown_stays_open_and_an_early_end_propagates_nothing(tmp_path: Path) -> None:
    project = family(tmp_path, 12)

    def unsure(asked: Asked) -> str:
        known = {number: label_of(asked.hulls[number][1]) for number in asked.numbers}
        return labels_as_json({number: "unknown" if label == "misc" else label for number, label in known.items()})

    with serving(unsure) as server:
        how = settings(server, every_hull=False)
        ended = label_with_vlm(project, how.model_copy(update={"max_cost": 0.009, "concurrency": 1}))
        assert ended.ended and ended.unasked
        assert all(one.source == "vlm" for a in project.assets() for one in project.labels(a).labels.values())
        found = label_with_vlm(project, how)
        assert found.ended is None
        assert {hull for own in found.open.values() for hull in own} == {"crumb"}
        assert len({why for own in found.open.values() for why in own.values()}) == 2
        assert all(labels(project, a) == {h: one for h, one in truth(a).items() if h != "crumb"} for a in found.open)
        assert len(found.open) == 12
        assert max(Counter(asked.raw for asked in server.answered).values()) == 1


def test_a_correction_afterwards_does_not_make_the_rest_be_asked_about_again(tmp_path: Path) -> None:
    project = family(tmp_path, 1)
    asset = project.assets()[0]
    with serving(right) as server:
        label_with_vlm(project, settings(server))
        project.set_labels(asset, {"top": "misc"})
        before = len(server.asked)
        label_with_vlm(project, settings(server))
        assert len(server.asked) == before
    assert project.labels(asset).labels["top"] == Label("misc")


def test_a_label_given_by_hand_while_the_model_thinks_stays(tmp_path: Path) -> None:
    project = family(tmp_path, 1)
    asset = project.assets()[0]

    def meanwhile(asked: Asked) -> str:
        project.set_labels(asset, {"top": "misc"})
        return right(asked)

    with serving(meanwhile) as server:
        (report,) = label_with_vlm(project, settings(server)).outcomes
    assert report.taken == 5
    assert labels(project, asset) == truth(asset) | {"top": "misc"}


@pytest.mark.slow
def test_the_forecast_sends_nothing_and_says_what_is_sent_then(tmp_path: Path) -> None:
    project = family(tmp_path, 3)
    (tmp_path / "assets/broken.obj").write_text("nothing of use")
    project = Project.open(project.folder)
    with serving(right) as server:
        how = settings(server)
        told = forecast(project, how)
        assert not server.asked
        assert not (project.layout.vlm).exists()
        found = label_with_vlm(project, how)
        assert told.usage.answered == len(server.answered)
        assert told.pictures == sum(len(asked.pictures) for asked in server.answered)
        assert (told.assets, told.hulls, told.usage.cached, told.unreadable) == (3, 18, 0, ("broken.obj",))
        assert told.usage.cost == pytest.approx((told.usage.input + 4 * told.usage.output) / 1e6)
        assert told.usage.output / 4 < server.usage["output"] < told.usage.output * 3
        after = forecast(project, how)
        assert (after.usage.cached, after.pictures, after.usage.input, after.usage.cost) == (3, 0, 0, 0.0)
    (broken,) = [report for report in found.outcomes if report.problems]
    assert broken.asset == "broken.obj"


@pytest.mark.slow
def test_a_limit_on_the_cost_ends_it_and_a_higher_one_goes_on(tmp_path: Path) -> None:
    project = family(tmp_path, 12)
    with serving(right) as server:
        how = settings(server, max_cost=0.02, concurrency=2)
        found = label_with_vlm(project, how)
        assert charged(server) <= 0.02
        assert found.usage.cost == pytest.approx(charged(server))
        assert found.ended and "of $0.02 are spent" in found.ended
        done = [report.asset for report in found.outcomes]
        assert done and len(done) + len(found.unasked) == 12
        assert all(labels(project, asset) == truth(asset) for asset in done)
        assert not any(labels(project, asset) for asset in found.unasked)
        rest = label_with_vlm(project, how.model_copy(update={"max_cost": 1.0}))
        assert rest.ended is None
        assert max(Counter(asked.raw for asked in server.answered).values()) == 1
    assert all(labels(project, asset) == truth(asset) for asset in project.assets())


@pytest.mark.slow
def test_a_stop_keeps_what_was_answered_and_the_next_run_goes_on(tmp_path: Path) -> None:
    project = family(tmp_path, 10)
    with serving(right, delay=0.01) as server:
        found = label_with_vlm(project, settings(server, concurrency=2), stop=lambda: len(server.answered) >= 4)
        assert found.ended
        assert 4 <= len(server.answered) < 10
        assert len(found.outcomes) + len(found.unasked) == 10
        assert [report.asset for report in found.outcomes if report.taken] == [
            asset for asset in project.assets() if labels(project, asset)
        ]
        label_with_vlm(project, settings(server))
        assert max(Counter(asked.raw for asked in server.answered).values()) == 1
    assert all(labels(project, asset) == truth(asset) for asset in project.assets())


_RUN = """
import sys
import time
from meshforge.project import Project
from meshforge.labels import VlmLabeler
from meshforge.store import VlmSettings
Project.open(sys.argv[1]).label(VlmLabeler(VlmSettings.model_validate_json(sys.argv[2])))
"""


@pytest.mark.slow
def test_a_killed_run_loses_nothing_that_was_paid_for_but_what_was_under_way(tmp_path: Path) -> None:
    project = family(tmp_path, 16)
    kills = iter([4, 9])
    with serving(right, delay=0.02) as server:
        how = settings(server, concurrency=2)
        for answers in kills:
            run = subprocess.Popen([sys.executable, "-c", _RUN, str(project.folder), how.model_dump_json()])
            while len(server.answered) < answers and run.poll() is None:
                time.sleep(0.005)
            os.kill(run.pid, signal.SIGKILL)
            run.wait()
            assert all(labels(project, asset).items() <= truth(asset).items() for asset in project.assets())
        kept = list((project.layout.vlm / "answers").glob("*.json"))
        assert len(kept) >= 9 - 2 * how.concurrency
        label_with_vlm(project, how)
        often = Counter(asked.raw for asked in server.answered)
        assert sum(often.values()) - len(often) <= 2 * how.concurrency
        assert len(often) == 16
    assert all(labels(project, asset) == truth(asset) for asset in project.assets())


def test_the_settings_of_the_project_say_whom_to_ask(tmp_path: Path) -> None:
    project = family(tmp_path, 2)
    project.set_labels("t000.obj", truth("t000.obj"))
    with serving(right) as server:
        path = project.layout.settings
        path.write_text(
            f'{path.read_text()}\n[vlm]\nbase_url = "{server.base_url}"\nmodel = "{server.model}"\n'
            f'key_env = "{VARIABLE}"\nevery_hull = true\nsize = 256\nnames = true\n'
            'about = "small tables"\n'
            '[vlm.descriptions]\nmisc = "what fell off"\n[vlm.extra]\ntop_k = 1\n'
        )
        found = label_with_vlm(project)
        (asked,) = server.answered
        assert "- misc: what fell off" in asked.text
        assert "The objects are: small tables." in asked.text
        assert asked.body["top_k"] == 1
        assert json.loads(asked.body["messages"][2]["content"])["hulls"]["5"] == "top"
        assert found.usage.cost is None
    project.set_vocabulary([*WORDS, "handle"])  # a change of another setting leaves the table alone
    assert project.settings.vlm.descriptions == {"misc": "what fell off"}


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        ('modell = "x"', "there is no such field as vlm.modell"),
        ("size = 3", "the field vlm.size"),
    ],
)
def test_settings_that_do_not_fit_are_told_with_the_field(tmp_path: Path, lines: str, message: str) -> None:
    project = family(tmp_path, 1)
    path = project.layout.settings
    path.write_text(f"{path.read_text()}\n[vlm]\n{lines}\n")
    with pytest.raises(ProjectError, match=message):
        label_with_vlm(project)


def test_what_cannot_be_asked_is_told_before_anything_is_sent(tmp_path: Path) -> None:
    project = family(tmp_path, 2)
    with serving(right) as server:
        how = settings(server)
        bad: dict[str, dict[str, Any]] = {
            "no model is named": {"model": ""},
            "needs to know the prices": {"max_cost": 1.0, "input_price": None},
            "'wheel' is described, but is not in the vocabulary": {"descriptions": {"wheel": "round"}},
        }
        for message, change in bad.items():
            with pytest.raises(UsageError, match=message):
                label_with_vlm(project, how.model_copy(update=change))
        project.set_vocabulary(())
        with pytest.raises(ProjectError, match="the vocabulary is empty"):
            label_with_vlm(project, how)
        assert not server.asked


def test_a_wrong_key_is_one_error_and_changes_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    project = family(tmp_path, 3)
    monkeypatch.setenv(VARIABLE, "sk-wrong")
    with serving(right) as server:
        with pytest.raises(MeshForgeError, match="does not accept the key"):
            label_with_vlm(project, settings(server))
        assert len(server.asked) == 1
    assert not project.layout.labels.ids


def test_an_asset_that_cannot_be_drawn_is_named_and_the_others_are_labelled(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    project = family(tmp_path, 3)

    def draw(meshes: Sequence[MeshHulls], config: PromptConfig) -> tuple[HullQuestion, ...]:
        if meshes[0].name == "t001.obj":
            raise ZeroDivisionError("no room for the picture")
        return build_questions(meshes, config)

    monkeypatch.setattr(prompt, "build_questions", draw)
    with serving(right) as server:
        assert forecast(project, settings(server)).unreadable == ("t001.obj",)
        found = label_with_vlm(project, settings(server))
    assert [report.taken for report in found.outcomes] == [6, 0, 6]
    assert "t001.obj: ZeroDivisionError: no room for the picture" in found.outcomes[1].problems[0]
