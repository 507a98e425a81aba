"""What a page gets from the studio, and what others do not get."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx
import pytest
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

from tests.e2e.studio import Studio, ok, opened, protocols
from tests.loop.command import meshforge_here as meshforge
from tests.studio_project import demo_project
from tests.unit.studio.packets import read_packet

FIRST, THIRD = "table_01.obj", "table_03.obj"


@pytest.fixture(scope="module")
def studio(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Studio]:
    """The demonstrated tables; nothing here changes them."""
    folder = tmp_path_factory.mktemp("tables")
    with opened(folder, demo_project(folder).folder) as found:
        found.settled()
        yield found


def test_hello_tells_everything(studio: Studio) -> None:
    hello = studio.settled()
    assert [card["asset"] for card in hello["cards"]] == [f"table_{k:02}.obj" for k in range(1, 15)]
    panel = {"name": "panel", "text": "panel", "color": "#E69F00", "is_class": False}
    assert hello["project"]["vocabulary"][0] == panel
    assert hello["project"]["rules"][0]["action"]["text"] == "Delete"
    assert len(hello["language"]["actions"]) == 6
    assert hello["outcome"]["status"] == "found"
    assert hello["program"]["text"] == hello["outcome"]["program"]
    assert not hello["program"]["by_hand"]
    assert hello["history"] == {"undo": None, "redo": None, "undoable": 0, "redoable": 0}
    assert studio.until(lambda hello: hello["project"]["next"]["kind"] == "answer")


@pytest.mark.parametrize(
    ("path", "query"),
    [("/api/shapes", {}), ("/api/visual", {}), ("/api/stage", {"steps": 2}), ("/api/result", {"of": "program"})],
)
def test_packets_come_whole(studio: Studio, path: str, query: dict[str, str | int]) -> None:
    answer = studio.get(path, asset=FIRST, **query)
    assert answer.status_code == 200, answer.text
    header, rows = read_packet(answer.content)
    assert len(rows) == len(header["rows"])


def test_a_preview_a_selection_and_a_generalisation(studio: Studio) -> None:
    chosen = ok(studio.post("/api/select", {"asset": FIRST, "extractor": "Is(leg)"}))["select"]
    assert chosen
    request = {"asset": FIRST, "select": chosen, "action": {"name": "Delete"}}
    header, _ = read_packet(studio.post("/api/preview", request).content)
    assert set(header["removed"]) == set(chosen)
    everywhere = ok(studio.post("/api/generalise", {"extractor": "Is(leg)"}))["assets"]
    assert len(everywhere[FIRST]) == len(chosen)
    assert len(everywhere) == 14


def test_guesses_are_those_of_the_program(studio: Studio) -> None:
    guesses: Any = ok(studio.get("/api/guesses", asset=THIRD))
    assert [guess["rule"] for guess in guesses] == [1, 2, 3, 4, 5]


def test_a_thumbnail_is_drawn_once_and_kept_for_ever(studio: Studio) -> None:
    digest = studio.settled()["cards"][0]["picture"]
    pictures = [studio.get("/api/thumbnail", asset=FIRST, of="source", v=digest) for _ in range(2)]
    assert {picture.content for picture in pictures} == {pictures[0].content}
    assert pictures[0].content.startswith(b"\x89PNG")
    assert "immutable" in pictures[0].headers["Cache-Control"]


def test_a_picture_for_a_question_tells_the_names(studio: Studio) -> None:
    answer = studio.get("/api/picture", asset=FIRST, rule=2, show="convex_00")
    length = int.from_bytes(answer.content[:4], "little")
    assert b'"names"' in answer.content[4 : 4 + length]
    assert answer.content[4 + length :].startswith(b"\x89PNG")


def test_texts_are_checked_with_the_place_of_the_error(studio: Studio) -> None:
    good = ok(studio.post("/api/program/check", {"text": "labels leg\nIs(leg) => Delete\n"}))
    assert good["mark"] is None
    assert good["rules"][0]["sentence"]
    bad = ok(studio.post("/api/program/check", {"text": "labels leg\nIs(leg) = Delete\n"}))
    assert bad["mark"]["line"] == 2
    assert ok(studio.get("/api/labels/sources")) == {"files": 0, "names": 0}


@pytest.mark.parametrize(
    ("path", "query", "status"),
    [
        ("/api/asset", {"asset": "no.obj"}, 404),
        ("/api/asset", {}, 400),
        ("/api/stage", {"asset": FIRST, "steps": "many"}, 400),
        ("/api/result", {"asset": FIRST, "of": "output"}, 400),
        ("/api/thumbnail", {"asset": FIRST, "of": "source", "v": "../../../etc/passwd"}, 404),
        ("/api/nothing", {}, 404),
    ],
)
def test_what_cannot_be_given_is_one_message(studio: Studio, path: str, query: dict[str, str], status: int) -> None:
    answer = studio.client.get(path, params=query)
    assert answer.status_code == status
    assert set(answer.json()) == {"message", "where", "remedy", "conflict"}
    assert answer.json()["message"]


@pytest.mark.parametrize(
    ("headers", "status"),
    [
        ({"Authorization": "Bearer wrong"}, 401),
        ({"Authorization": ""}, 401),
        ({"Host": "evil.example"}, 403),
        ({"Host": "127.0.0.1.evil.example"}, 403),
        ({"Origin": "https://evil.example"}, 403),
        ({"Origin": "null"}, 403),
        ({"Origin": "http://127.0.0.1:1"}, 403),
    ],
)
def test_strangers_get_nothing(studio: Studio, headers: dict[str, str], status: int) -> None:
    answer = studio.client.get("/api/asset", params={"asset": FIRST}, headers=headers)
    assert answer.status_code == status
    assert "hulls" not in answer.text
    assert answer.headers["X-Content-Type-Options"] == "nosniff"


@pytest.mark.parametrize(
    ("token", "origin"), [("wrong", None), ("", None), (None, "https://evil.example"), (None, "null")]
)
def test_strangers_get_no_connection(studio: Studio, token: str | None, origin: str | None) -> None:
    offered = protocols(studio.token if token is None else token)
    headers = {"Origin": origin} if origin else None
    with pytest.raises(InvalidStatus), connect(studio.socket, subprotocols=offered, additional_headers=headers):
        pass


def test_the_page_itself_needs_no_token_and_is_confined(studio: Studio) -> None:
    answer = httpx.get(studio.base + "/")
    assert answer.status_code == 200
    policy = answer.headers["Content-Security-Policy"]
    assert "script-src 'self';" in policy and "frame-ancestors 'none'" in policy
    assert answer.headers["Referrer-Policy"] == "no-referrer"
    assert httpx.get(studio.base + "/%2e%2e/%2e%2e/meshforge.toml").status_code == 404


def test_a_second_studio_on_the_project_is_refused(studio: Studio, tmp_path: Path) -> None:
    folder = studio.settled()["project"]["folder"]
    (tmp_path / "page").mkdir()
    (tmp_path / "page" / "index.html").touch()
    words = ("studio", folder, "--no-browser", "--page", tmp_path / "page")
    assert "open on this project already" in meshforge(*words, cwd=tmp_path, code=2).err


def test_a_studio_without_project_or_page_says_what_to_do(tmp_path: Path) -> None:
    (tmp_path / "page").mkdir()
    missing = meshforge("studio", "nowhere", "--page", "page", cwd=tmp_path, code=2)
    assert "not built" in missing.err and "script/build-web" in missing.err
    (tmp_path / "page" / "index.html").touch()
    assert "this is no project" in meshforge("studio", "nowhere", "--page", "page", cwd=tmp_path, code=2).err
