"""How far work is, said on stderr: lines in a pipe, one line at a terminal, also while the work is silent."""

import os
import re
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any

import pytest

from meshforge import formats
from meshforge.cli import console
from meshforge.cli.console import Progress, progress
from meshforge.project.prepare import count_pieces
from tests.unit.batch.preparation.samples import write_stand
from tests.unit.cli.in_process import Run
from tests.urdf_sample import boxes_obj

Capture = pytest.CaptureFixture[str]


@pytest.fixture(autouse=True)
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    """The first line comes soon, and stderr is no terminal."""
    monkeypatch.setattr(console, "QUIET_SECONDS", 0.2)
    monkeypatch.setenv("MESHFORGE_PROGRESS_AFTER", "0.2")
    for name in ("FORCE_COLOR", "TTY_COMPATIBLE"):
        monkeypatch.delenv(name, raising=False)


def test_quick_work_says_nothing_in_a_pipe(capsys: Capture) -> None:
    with progress(3, "editing") as advance:
        for _ in range(3):
            advance()
    assert capsys.readouterr().err == ""


def test_silent_work_says_how_long_it_takes_more_and_more_seldom(capsys: Capture) -> None:
    with progress(None, "decomposing") as shown:
        shown.show("round 2")
        time.sleep(1.1)
    told = capsys.readouterr().err
    lines = told.splitlines()
    assert 2 <= len(lines) <= 4 and "\r" not in told  # after 0.2, 0.4, 0.8 seconds
    assert all(re.fullmatch(r"decomposing: round 2, \d+ s", line) for line in lines)


def test_the_estimate_is_what_the_rest_takes_at_the_same_pace(monkeypatch: pytest.MonkeyPatch) -> None:
    now = [100.0]
    monkeypatch.setattr(console, "monotonic", lambda: now[0])
    shown = Progress(4, "checking", None)
    now[0] += 30
    assert shown.describe() == "checking: 0 of 4, 30 s"
    for _ in range(3):
        shown()
    assert shown.describe() == "checking: 3 of 4, 30 s, about 10 s left"
    shown()
    assert shown.describe() == "checking: 4 of 4, 30 s"


def test_pieces_of_one_asset_are_its_share_and_words_say_theirs(monkeypatch: pytest.MonkeyPatch) -> None:
    now = [0.0]
    monkeypatch.setattr(console, "monotonic", lambda: now[0])
    pieces = Progress(1, "decomposing", lambda: (2, 8))
    parts = Progress(None, "coacd on mug.obj", None)
    now[0] = 20.0
    assert pieces.describe() == "decomposing: 0 of 1, 2 of 8 pieces, 20 s, about 60 s left"
    parts.show("part 3 of 4, handle")
    assert parts.describe() == "coacd on mug.obj: part 3 of 4, handle, 20 s, about 20 s left"


@pytest.mark.skipif(not hasattr(signal, "SIGALRM"), reason="no alarms there")
def test_nothing_of_it_is_left_and_no_thread_runs_till_it_takes_long() -> None:
    before = threading.active_count()
    with progress(1, "editing"):
        assert threading.active_count() == before and signal.getitimer(signal.ITIMER_REAL)[0] > 0
        with progress(None, "inner"):  # the alarm is taken: a thread at once
            assert threading.active_count() == before + 1
        time.sleep(0.3)
        assert threading.active_count() == before + 1
    assert threading.active_count() == before and signal.getitimer(signal.ITIMER_REAL)[0] == 0
    assert signal.getsignal(signal.SIGALRM) is signal.SIG_DFL


def test_at_a_terminal_one_line_goes_before_results(capsys: Capture, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("FORCE_COLOR", "1")
    monkeypatch.setattr(sys.stdout, "isatty", lambda: True)
    with progress(2, "editing") as advance:
        time.sleep(0.15)
        advance()
        print("a result")
        told = capsys.readouterr()
        assert told.err.endswith("editing: 1 of 2, 0 s, about 0 s left\r\x1b[K") and told.out == "a result\n"
        time.sleep(0.3)
    assert re.fullmatch(r"(\r\x1b\[Kediting: 1 of 2, [^\r\n]*)+\r\x1b\[K", capsys.readouterr().err)


def test_a_reader_of_stderr_that_has_gone_ends_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    class Gone:
        def isatty(self) -> bool:
            return False

        def write(self, text: str) -> int:
            raise BrokenPipeError

        flush = isatty

    monkeypatch.setattr(sys, "stderr", Gone())
    Progress(1, "editing", None).clear("a line")


def test_pieces_are_counted_of_all_assets(tmp_path: Path) -> None:
    assert count_pieces(tmp_path) == (0, 0)
    (tmp_path / "0").write_text("2 5")
    (tmp_path / "1").write_text("1 1")
    (tmp_path / ".0.x.tmp").write_text("half")
    assert count_pieces(tmp_path) == (3, 6)


SLOW = """
import sys, time
from meshforge.batch.preparation import decompose
from meshforge.cli import console, main
own = decompose.decompose_surface
def slowly(*words, **more):
    time.sleep(1.5)
    return own(*words, **more)
decompose.decompose_surface, console.QUIET_SECONDS, console._SELDOM = slowly, 0.3, 0.3
sys.argv = ["meshforge", "new", "p", "in/stand.urdf", "--decompose", "hull", "--workers", "1"]
main()
"""


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="workers start by a fork there")
def test_a_decomposition_in_a_pipe_says_pieces_seconds_and_estimate(tmp_path: Path) -> None:
    write_stand(tmp_path / "in")
    done = subprocess.run([sys.executable, "-c", SLOW], cwd=tmp_path, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    assert re.search(r"^decomposing: 0 of 1, 0 of 2 pieces, \d+ s$", done.stderr, re.M)
    assert re.search(r"^decomposing: 0 of 1, 1 of 2 pieces, \d+ s, about \d+ s left$", done.stderr, re.M)
    assert "2 pieces into 2 hulls" in done.stdout and "decomposing" not in done.stdout


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="workers start by a fork there")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_stop_leaves_no_warning_of_semaphores(tmp_path: Path, number: signal.Signals) -> None:
    write_stand(tmp_path / "in")
    code = SLOW.replace("1.5", "60")
    running = subprocess.Popen(
        [sys.executable, "-c", code], cwd=tmp_path, stderr=subprocess.PIPE, text=True, start_new_session=True
    )
    assert running.stderr is not None
    said = running.stderr.readline()
    assert said.startswith("decomposing: 0 of 1")
    os.killpg(running.pid, number)
    _, rest = running.communicate(timeout=60)
    assert "semaphore" not in rest and "Traceback" not in rest


@pytest.mark.parametrize("words", [("info", "a.obj", "--json"), ("convert", "a.obj", "b.stl", "--json")])
def test_reading_one_asset_says_how_long_it_takes_and_json_stays_json(
    words: tuple[str, ...], run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    own = formats.load

    def slowly(*given: Any, **more: Any) -> Any:
        time.sleep(0.5)
        return own(*given, **more)

    monkeypatch.setattr(formats, "load", slowly)
    Path("a.obj").write_text(boxes_obj(((0, 0, 0), (1, 1, 1))))
    told = run(*words)
    assert told.code == 0 and told.err.startswith("reading a.obj: 0 s\n") and told.json
