"""Names that would control a terminal are printed as text, on every road to it; JSON stays exact."""

import io
import json
import subprocess
import sys
from contextlib import redirect_stdout
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.cli.terminal import escape_output, print_json
from meshforge.common import MeshForgeError, escape_name, escape_text, quote_path
from meshforge.project import Project
from tests.unit.batch.families import obj
from tests.unit.cli.in_process import Run
from tests.unit.cli.terminal import Terminal

HULL = "a\x1b]0;owned\x07\x9b31m\u202egpj"
FILE = "b\x1b[31m\u202e\nc.obj"
CONTROLS = ("\x1b]", "\x1b[31m", "\x07", "\x9b", "\u202e")

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="no such file names there")


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A family of two: one file and its hull are named by somebody who wishes ill."""
    assets = tmp_path / "assets"
    assets.mkdir()
    (assets / FILE).write_text(obj({HULL: ((0, 0, 0), (1, 1, 1)), "other": ((0, 0, 0), (2, 2, 2))}), encoding="utf-8")
    (assets / "d.obj").write_text(obj({HULL: ((0, 0, 0), (3, 3, 3))}), encoding="utf-8")
    Project.create(tmp_path / "p", [assets / "*.obj"], vocabulary=("leg",))
    (tmp_path / "p/program.mf").write_text("labels leg\n\nAll => Replace(box)\n")
    monkeypatch.chdir(tmp_path)
    return tmp_path


@given(st.text())
def test_an_escaped_name_is_one_line_without_controls_and_a_second_time_the_same(text: str) -> None:
    escaped = escape_name(text)
    assert not any(letter < " " or "\x7f" <= letter <= "\x9f" or letter in "\u2028\u2029\u202e" for letter in escaped)
    assert escape_name(escaped) == escape_text(escaped) == escaped
    escaped.encode()  # no half of a pair is left


@given(st.text())
def test_json_reads_back_as_it_was_and_controls_nothing(text: str) -> None:
    with redirect_stdout(io.StringIO()) as printed, escape_output():
        print_json({"name": text})
    assert json.loads(printed.getvalue()) == {"name": text}
    assert escape_text(printed.getvalue()) == printed.getvalue()


@pytest.mark.parametrize(
    "words",
    [
        ["info", f"assets/{FILE}"],
        ["select", "All", f"assets/{FILE}"],
        ["check", "assets"],
        ["check", "assets", "--engine", "unreal"],
        ["status", "p"],
        ["label", "p", "--with", "names", "--pattern", "a*=leg"],
        ["label", "p", FILE, "no such hull=leg"],
        ["apply", "p", "--workers", "1"],
        ["convert", f"assets/{FILE}", f"{FILE}.stl"],
        ["convert", "assets", "out", "--to", ".stl"],
        ["info", f"assets/no{FILE}"],
        ["diff", f"assets/{FILE}", "assets/d.obj"],
        ["render", f"assets/{FILE}", "--out", f"{FILE}.png"],
    ],
    ids=lambda words: " ".join(words).encode("unicode_escape").decode(),
)
def test_every_command_prints_names_as_text(project: Path, run: Run, words: list[str]) -> None:
    done = run(*words)
    text = done.out + done.err
    assert not any(control in text for control in CONTROLS), text
    assert "\nc.obj" not in text, text
    assert "\\x1b" in text or "\\u202e" in text, text


@pytest.mark.slow
def test_a_terminal_gets_no_controls_of_names_beside_a_bar_and_in_tables(project: Path) -> None:
    for words in (["check", "assets", "--workers", "1"], ["apply", "p", "--again", "--workers", "1"], ["status", "p"]):
        with Terminal(*words, cwd=project) as terminal:
            terminal.end()
        assert not any(control in terminal.text for control in CONTROLS), terminal.text
        assert r"b\x1b[31m\u202e\nc.obj" in terminal.text, terminal.text


def test_json_of_commands_names_exactly(project: Path, run: Run) -> None:
    done = run("info", f"assets/{FILE}", "--json")
    assert json.loads(done.out)["hulls"][0]["name"] == HULL
    assert "\u202e" not in done.out


def test_an_error_names_a_file_in_one_line_and_a_command_to_type_is_whole(project: Path) -> None:
    assert str(MeshForgeError("is no mesh", where=FILE)) == r"b\x1b[31m\u202e\nc.obj: is no mesh"
    for name in (FILE, "it's\n\\", "plain name", "a\udcff"):
        echo = ["bash", "-c", f"printf %s {quote_path(Path(name))}"]
        printed = subprocess.run(echo, capture_output=True, check=True, env={"LC_ALL": "C.UTF-8"}).stdout
        assert printed == name.encode("utf-8", "surrogateescape")


def test_a_program_that_is_formatted_into_a_pipe_stays_exact(project: Path, run: Run) -> None:
    (project / "p.mf").write_text("All => Replace(box)  # 👩\u200d🔧\n", encoding="utf-8")
    assert "👩\u200d🔧" in run("fmt", "p.mf").out
