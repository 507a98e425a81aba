"""What the browser takes away: how it is asked for, what is in it, and what is said of what is not."""

from __future__ import annotations

import re
import time
from collections.abc import Iterator
from io import BytesIO
from pathlib import Path
from typing import Any
from zipfile import ZipFile

import pytest
from starlette.testclient import TestClient

from meshforge.batch import IN_PROCESS, ExecutionOptions, write_archive
from meshforge.common import StoppedError
from meshforge.studio import transfers
from meshforge.studio.api.server import build_app
from meshforge.studio.errors import NotHereError
from meshforge.studio.host import Host
from meshforge.studio.session.session import StudioOptions
from meshforge.studio.transfers import Downloads, to_file_name
from tests.unit.batch.families import tree
from tests.unit.project.tables import FIRST, SECOND, THIRD, applied

TOKEN = "a-token_1"
PATIENCE = 60.0


# Tickets


def test_a_ticket_is_good_once_and_not_for_ever(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    kept = Downloads(tmp_path / "downloads")
    path = kept.path_for("1", "tables.zip")
    path.parent.mkdir(parents=True)
    path.write_bytes(b"zip")
    kept.add("download-1", path)
    ticket, late = kept.give_ticket("download-1"), kept.give_ticket("download-1")
    assert ticket != late and kept.redeem(ticket) == path
    now = time.monotonic()
    monkeypatch.setattr(transfers, "monotonic", lambda: now + transfers.TICKET_SECONDS + 1)
    for bad in (ticket, late, "", "../../meshforge.toml"):
        with pytest.raises(NotHereError, match="good for one download"):
            kept.redeem(bad)
    with pytest.raises(NotHereError):
        kept.give_ticket("download-2")
    kept.clear()
    assert not path.exists()
    with pytest.raises(NotHereError):
        kept.give_ticket("download-1")


def test_only_the_last_files_are_kept(tmp_path: Path) -> None:
    kept = Downloads(tmp_path / "downloads")
    for number in range(transfers.MOST_DOWNLOADS + 2):
        path = kept.path_for(str(number), "report.html")
        path.parent.mkdir(parents=True)
        path.write_text("report")
        kept.add(f"download-{number}", path)
    assert len(list((tmp_path / "downloads").rglob("*.html"))) == transfers.MOST_DOWNLOADS


@pytest.mark.parametrize(
    ("words", "name"),
    [
        (("tables", "results"), "tables-results"),
        (("my tables / old: 1", "report"), "my-tables-old-1-report"),
        (("Möbel", "report"), "Möbel-report"),
        (("../..", ""), "meshforge"),
    ],
)
def test_a_file_has_a_name_that_every_system_takes(words: tuple[str, ...], name: str) -> None:
    assert to_file_name(*words) == name


# Zip files


def test_the_same_files_are_the_same_zip_whenever_they_were_written(tmp_path: Path) -> None:
    for folder, text in (("one", "v 0 0 0\n"), ("two", "v 0 0 0\n")):
        (tmp_path / folder / "sub").mkdir(parents=True)
        (tmp_path / folder / "b.obj").write_text(text)
        (tmp_path / folder / "sub" / "a.obj").write_text(text * 9)
    (tmp_path / "two" / "b.obj").chmod(0o600)
    names = ["sub/a.obj", "b.obj"]
    write_archive(tmp_path / "1.zip", tmp_path / "one", names, "two files")
    write_archive(tmp_path / "2.zip", tmp_path / "two", names[::-1], "two files")
    assert (tmp_path / "1.zip").read_bytes() == (tmp_path / "2.zip").read_bytes()
    with ZipFile(tmp_path / "1.zip") as archive:
        assert archive.namelist() == ["b.obj", "sub/a.obj"] and archive.comment == b"two files"
        assert archive.read("sub/a.obj") == (tmp_path / "one" / "sub" / "a.obj").read_bytes()
    with pytest.raises(StoppedError):
        write_archive(tmp_path / "3.zip", tmp_path / "one", names, execution=ExecutionOptions(stop=lambda: True))


# The whole way


class Person:
    """Somebody who has the token. host: the studio that is served."""

    def __init__(self, client: TestClient, host: Host) -> None:
        self.client, self.host = client, host

    def post(self, path: str, **body: Any) -> Any:
        return self.client.post(path, json=body, headers={"Authorization": f"Bearer {TOKEN}"})

    def make(self, **request: Any) -> dict[str, Any]:
        """Have a file made; the job when it is over."""
        answer = self.post("/api/jobs", kind="download", **request)
        assert answer.status_code == 200, answer.text
        return self.wait(answer.json()["id"])

    def wait(self, job: str) -> dict[str, Any]:
        until = time.monotonic() + PATIENCE
        while True:
            found = next(one for one in self.host.session.pages._jobs.values() if one.id == job)
            if found.state != "running":
                return found.model_dump()
            assert time.monotonic() < until
            time.sleep(0.02)

    def fetch(self, job: dict[str, Any]) -> Any:
        """The file of a job, by a ticket: without the token."""
        return self.client.get("/" + self.post("/api/download", job=job["id"]).json())


@pytest.fixture
def person(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Person]:
    """Somebody at three tables: one is accepted, one wrong, one has no output."""
    monkeypatch.setenv("MESHFORGE_STATE", str(tmp_path / "state"))
    project = applied(tmp_path)
    project.set_verdict([FIRST], "accepted")
    project.set_verdict([SECOND], "wrong")
    for path in (project.folder / "edited").rglob("*"):
        if THIRD.split("/")[0] in path.parts and path.is_file():
            path.unlink()
    (project.folder / "edited" / ".meshforge" / "stamps" / f"{THIRD}.json").unlink(missing_ok=True)
    page = tmp_path / "page"
    page.mkdir()
    (page / "index.html").write_text("<!doctype html>")
    host = Host(StudioOptions(project.folder))
    host.open(project.folder)
    try:
        with TestClient(build_app(host, TOKEN, page), base_url="http://127.0.0.1") as client:
            until = time.monotonic() + PATIENCE
            while any(card.hulls is None for card in host.session.pages.cards) or not _is_reviewed(host):
                assert time.monotonic() < until
                time.sleep(0.05)
            yield Person(client, host)
    finally:
        host.close()


def _is_reviewed(host: Host) -> bool:
    verdicts = {card.asset: card.review for card in host.session.pages.cards}
    return (verdicts.get(FIRST), verdicts.get(SECOND)) == ("accepted", "wrong")


@pytest.mark.slow
def test_a_zip_has_what_apply_writes_and_says_what_is_not_in_it(person: Person, tmp_path: Path) -> None:
    project = person.host.session.project
    job = person.make(what="results", signed_only=False)
    assert (job["state"], job["out"]) == ("done", "tables-results.zip")
    assert job["message"].startswith("2 of 3 results; not in it: 1 without output"), job["message"]
    assert [(line["asset"], line["status"]) for line in job["lines"]] == [(THIRD, "skipped")]
    answer = person.fetch(job)
    assert answer.headers["content-disposition"] == 'attachment; filename="tables-results.zip"'
    assert answer.headers["cache-control"] == "no-store"
    list(project.apply([FIRST, SECOND], out=tmp_path / "out", execution=IN_PROCESS))
    wanted = {name: data for name, data in tree(tmp_path / "out").items() if not name.endswith("/lock")}
    with ZipFile(BytesIO(answer.content)) as archive:
        assert {name: archive.read(name) for name in archive.namelist()} == wanted
        assert archive.comment.decode() == f"MeshForge, tables: {job['message']}"
    again = person.make(what="results", signed_only=False)
    assert person.fetch(again).content == answer.content
    assert person.client.get(str(answer.url)).status_code == 404, "a ticket is good once"
    some = person.make(what="results")
    assert some["message"] == "1 of 3 results; not in it: 1 without output, 1 wrong."


@pytest.mark.slow
def test_the_report_shows_the_assets(person: Person) -> None:
    report = person.make(what="report")
    assert (report["state"], report["out"]) == ("done", "tables-report.html"), report
    assert "Not in it: 1 without output." in report["message"]
    text = person.fetch(report).text
    assert FIRST in text and SECOND in text and "data:image/webp" in text
    assert not re.search(r"""(src|href)=["']?(https?:)?//""", text)


@pytest.mark.slow
def test_what_cannot_be_made_says_why_and_what_is_cancelled_leaves_nothing(person: Person, tmp_path: Path) -> None:
    assert person.post("/api/jobs", kind="download", what="gone").status_code == 400
    assert person.post("/api/download", job="download-7").status_code == 404
    assert person.client.post("/api/download", json={"job": "download-1"}).status_code == 401
    assert person.client.get("/download/nothing").status_code == 404
    job = person.post("/api/jobs", kind="download", what="report").json()["id"]
    assert person.post("/api/jobs", kind="download", what="report").status_code == 400, "one at a time"
    person.post("/api/jobs/cancel", id=job)
    assert person.wait(job)["message"] == "Cancelled: nothing was made."
    assert person.post("/api/download", job=job).status_code == 404
    assert not list((person.host.session.project.folder / ".meshforge" / "studio" / "downloads").rglob("*"))
    edited = person.host.session.project.layout.edited
    (edited / FIRST).write_text("changed by hand")
    broken = person.make(what="results", signed_only=False)
    assert "1 changed since it was written" in broken["message"]
    assert [line["asset"] for line in broken["lines"] if line["status"] == "failed"] == [FIRST]
    only = person.make(what="results")
    assert (only["state"], only["message"]) == ("failed", "no result is whole\n  Apply the program again."), only
