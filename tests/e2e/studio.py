"""The studio as another process, as a person starts it, and a page that talks to it."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from threading import Thread
from typing import Any

import httpx
from websockets.sync.client import ClientConnection, connect
from websockets.typing import Subprotocol

from meshforge.studio.api.connection import PROTOCOL

_RUN = "from meshforge.cli import main; main()"
PATIENCE = 60.0
"""Seconds that anything may take before a test gives up; nothing is measured by it."""


@dataclass(frozen=True)
class Studio:
    process: subprocess.Popen[str]
    base: str
    token: str
    client: httpx.Client

    def get(self, path: str, **query: str | int) -> httpx.Response:
        return self.client.get(path, params=query)

    def post(self, path: str, body: Any = None, page: str | None = None) -> httpx.Response:
        return self.client.post(path, json={} if body is None else body, headers={"X-Page": page} if page else {})

    def put(self, path: str, content: bytes, /, **query: str) -> httpx.Response:
        return self.client.put(path, params=query, content=content)

    def edit(self, kind: str, page: str | None = None, **fields: Any) -> dict[str, Any]:
        """Make an edit that succeeds."""
        return ok(self.post("/api/edit", {"kind": kind, **fields}, page))

    def steps(self, asset: str) -> dict[str, Any]:
        """The fields of an edit of the steps of an asset, as they are now."""
        view = ok(self.get("/api/asset", asset=asset))
        fields = ("name", "arguments", "each", "label")
        steps = [{"select": s["select"], "action": {key: s["action"][key] for key in fields}} for s in view["steps"]]
        return {"asset": asset, "version": view["version"], "steps": steps}

    def run_job(self, **request: Any) -> dict[str, Any]:
        """Begin a job and wait for its end."""
        with self.page() as page:
            assert page.hello
            return page.job(ok(self.post("/api/jobs", request))["id"])

    @property
    def folder(self) -> Path:
        """The folder of the project, when all is quiet."""
        return Path(self.settled()["project"]["folder"])

    @contextmanager
    def page(self) -> Iterator[Page]:
        with connect(self.socket, subprotocols=protocols(self.token), max_size=None) as connection:
            yield Page(connection)

    @property
    def socket(self) -> str:
        """The address of the connection of pages."""
        return f"{self.base.replace('http', 'ws')}/ws"

    def settled(self) -> dict[str, Any]:
        """What a page is told on connecting, once the assets are read and the outcome is over."""
        return self.until(
            lambda hello: (
                all(card["hulls"] is not None or card["error"] for card in hello["cards"])
                and hello["project"]["next"]["text"] != "The assets are being read."
                and not hello["learning"]
            )
        )

    def undo_all(self) -> None:
        """Take all edits back, so that the next test finds the project as the first one did."""
        while self.settled()["history"]["undoable"]:
            ok(self.post("/api/undo"))

    def cards(self, holds: Callable[[dict[str, dict[str, Any]]], bool]) -> dict[str, dict[str, Any]]:
        """The cards by asset, once a condition holds for them."""
        hello = self.until(lambda hello: holds({card["asset"]: card for card in hello["cards"]}))
        return {card["asset"]: card for card in hello["cards"]}

    def until(self, holds: Callable[[dict[str, Any]], bool]) -> dict[str, Any]:
        """What a page is told on connecting, once a condition holds for it."""
        until = time.monotonic() + PATIENCE
        while True:
            with self.page() as page:
                hello = page.hello
                if holds(hello):
                    return hello
                assert time.monotonic() < until, "the studio does not come to that"
                page.until(lambda event: event["kind"] in ("cards", "outcome", "project", "reach", "assessment"))


@dataclass
class Page:
    """A page: all that it was told so far, in order."""

    connection: ClientConnection
    events: list[dict[str, Any]] = field(default_factory=list)

    @property
    def hello(self) -> dict[str, Any]:
        if not self.events:
            self._receive()
        assert self.events[0]["kind"] == "hello"
        return self.events[0]

    def until(self, holds: Callable[[dict[str, Any]], bool]) -> dict[str, Any]:
        """The next event that a condition holds for."""
        while True:
            event = self._receive()
            if event["kind"] != "hello" and holds(event):
                return event

    def kind(self, kind: str) -> dict[str, Any]:
        """The next event of a kind."""
        return self.until(lambda event: event["kind"] == kind)

    def job(self, job: str) -> dict[str, Any]:
        """A job when it is over."""
        event = self.until(lambda e: e["kind"] == "job" and e["job"]["id"] == job and e["job"]["state"] != "running")
        found: dict[str, Any] = event["job"]
        return found

    def _receive(self) -> dict[str, Any]:
        event: dict[str, Any] = json.loads(self.connection.recv(timeout=PATIENCE))
        self.events.append(event)
        return event


def protocols(token: str) -> list[Subprotocol]:
    """What a connection offers: the protocol of pages, and the token."""
    return [Subprotocol(word) for word in (PROTOCOL, token) if word]


def ok(response: httpx.Response) -> dict[str, Any]:
    """The body of an answer that is no error."""
    assert response.status_code == 200, response.text
    body: dict[str, Any] = response.json()
    return body


def start(folder: Path, project: Path, *words: str) -> Studio:
    """Start a studio on a project, with a page that is built of nothing. folder: where that is kept."""
    page = folder / "page"
    page.mkdir(exist_ok=True)
    (page / "index.html").write_text("<!doctype html><title>MeshForge</title>")
    return started("studio", str(project), "--page", str(page), *words)


def started(*words: str) -> Studio:
    """Run `meshforge WORDS`, which starts a studio."""
    command = [sys.executable, "-c", _RUN, *words, "--no-browser"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert process.stdout and process.stderr
    line = process.stdout.readline()
    assert line.startswith("Studio: http://127.0.0.1:"), line + process.stderr.read()
    base, _, token = line.removeprefix("Studio: ").strip().partition("/?token=")
    client = httpx.Client(base_url=base, headers={"Authorization": f"Bearer {token}"}, timeout=PATIENCE)
    return Studio(process, base, token, client)


@contextmanager
def opened(folder: Path, project: Path, *words: str) -> Iterator[Studio]:
    """A studio on a project for a block."""
    with ending(start(folder, project, *words)) as studio:
        yield studio


@contextmanager
def ending(studio: Studio) -> Iterator[Studio]:
    """A studio for a block; it comes to its end when it is asked to, and leaves no message behind."""
    complaints: list[str] = []
    assert studio.process.stderr
    listener = Thread(target=lambda: complaints.extend(studio.process.stderr or ()))
    listener.start()
    try:
        yield studio
    finally:
        studio.client.close()
        if studio.process.poll() is None:
            studio.process.send_signal(signal.SIGTERM)
        try:
            code = studio.process.wait(PATIENCE)
        finally:
            studio.process.kill()
            listener.join()
            for stream in (studio.process.stdout, studio.process.stderr):
                stream.close() if stream else None
    if code != -signal.SIGKILL:  # who is killed has no time to clean up after its processes
        assert (code, complaints) == (0, [])
