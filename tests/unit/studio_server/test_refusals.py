"""What a page is told where files are damaged, gone, or refused by the disk: where, what is wrong, and the remedy."""

import errno
import os
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NoReturn

import pytest
from starlette.testclient import TestClient

from meshforge.project import Project
from meshforge.studio.api.server import build_app
from meshforge.studio.host import Host
from meshforge.studio.session.session import StudioOptions
from tests.unit.project.tables import FIRST, LEGS, demonstrated

LABEL = {"kind": "label", "hulls": {FIRST: sorted(LEGS)}, "label": "leg"}
VOCABULARY = {"kind": "vocabulary", "labels": ["leg", "arm"]}
EXCLUDE = {"kind": "exclude", "ids": [FIRST], "reason": "not of this family"}


@pytest.fixture
def host(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Host]:
    monkeypatch.setenv("MESHFORGE_STATE", str(tmp_path / "state"))
    folder = demonstrated(tmp_path).folder
    host = Host(StudioOptions(folder))
    host.open(folder)
    yield host
    host.close()


def ask(host: Host, tmp_path: Path, path: str, edit: dict[str, Any] | None = None) -> tuple[int, dict[str, Any]]:
    """The status and the body of an answer; edit: the one to make."""
    (tmp_path / "index.html").touch()
    app = build_app(host, "t", tmp_path)
    with TestClient(app, "http://127.0.0.1", raise_server_exceptions=False) as client:
        client.headers["authorization"] = "Bearer t"
        answer = client.post(path, json=edit) if edit else client.get(path, params={"asset": FIRST})
        return answer.status_code, answer.json()


def until(host: Host, problem: str | None) -> None:
    """Wait until pages show a problem, or none."""
    end = time.monotonic() + 60
    while (shown := host.session.pages.shown.project.problem) != problem and not (problem and problem in str(shown)):
        assert time.monotonic() < end, shown
        time.sleep(0.05)


@pytest.mark.parametrize(
    ("name", "content", "path", "edit", "message"),
    [
        (f"labels/{FIRST}.json", b'{"\xff', "/api/edit", LABEL, "not UTF-8"),
        ("program.mf", b"\xff Delete", "/api/guesses", None, "not text in UTF-8"),
        ("meshforge.toml", b"assets = [", "/api/edit", VOCABULARY, "no TOML"),
        ("meshforge.toml", b"# \xff", "/api/edit", VOCABULARY, "not text in UTF-8"),
        ("events.jsonl", b"\xff", "/api/edit", EXCLUDE, "not text in UTF-8"),
        ("events.jsonl", b"{", "/api/edit", EXCLUDE, "line 1: this is no JSON"),
        (f"demonstrations/{FIRST}.json", b"\xff", "/api/asset", None, "no JSON"),
        (f"../assets/{FIRST}", b"\xff\xfev", "/api/asset", None, "UTF-16"),
        (f"../assets/{FIRST}", None, "/api/asset", None, "there is no"),
    ],
)
def test_a_file_that_cannot_be_read_is_named_with_what_to_do(
    host: Host, tmp_path: Path, name: str, content: bytes | None, path: str, edit: dict[str, Any] | None, message: str
) -> None:
    file = host.session.project.folder / name
    file.write_bytes(content) if content is not None else file.unlink()
    host.session._poll_files()
    status, problem = ask(host, tmp_path, path, edit)
    assert status in (400, 404)
    said = "\n".join(str(problem[part]) for part in ("where", "message", "remedy"))
    assert message in said
    assert Path(name).name in said
    assert len(said.splitlines()) > 2
    assert not problem["message"].startswith("Unicode")


def test_settings_that_are_damaged_meanwhile_are_named_and_mended(host: Host) -> None:
    settings = host.session.project.folder / "meshforge.toml"
    until(host, None)
    good = settings.read_bytes()
    settings.write_bytes(good + b"vocabulary = [")
    until(host, "this is no TOML")
    assert "this is no TOML" in host.session.pages.shown.project.next.text
    settings.write_bytes(good + b"\n")
    until(host, None)


def test_a_program_that_is_no_text_is_kept_when_another_takes_its_place(host: Host) -> None:
    project = Project.open(host.session.project.folder)
    project.synthesize()
    program = project.program()
    assert program
    project.layout.program.write_bytes(b"\xff")
    project.accept(program)
    assert project.layout.previous_program.read_bytes() == b"\xff"
    assert project.program() == program


@pytest.mark.parametrize("code", [errno.ENOSPC, errno.EACCES, errno.EROFS])
def test_what_the_disk_refuses_is_said(host: Host, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, code: int) -> None:
    def refuse(*_: Any, **__: Any) -> NoReturn:
        raise OSError(code, os.strerror(code))

    file = host.session.project.layout.labels(FIRST)
    before = file.read_bytes()
    edit = LABEL | {"label": None}
    with monkeypatch.context() as full:
        full.setattr(tempfile, "mkstemp", refuse)
        status, problem = ask(host, tmp_path, "/api/edit", edit)
    assert status == 500
    assert problem["message"] == os.strerror(code)
    assert str(host.session.project.folder) in problem["where"]
    assert "do the same again" in problem["remedy"]
    assert (file.read_bytes(), host.session.history.state.undoable) == (before, 0)
    assert ask(host, tmp_path, "/api/edit", edit)[0] == 200
