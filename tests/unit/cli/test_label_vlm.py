"""`meshforge label --with vlm`: what is sent, said and paid, as a person reads it."""

import json
import os
import signal
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import pytest

from meshforge.project import Project
from tests.loopback import KEY, Asked, Server, labels_as_json, serving
from tests.unit.cli.in_process import Run
from tests.unit.labels.vlm_family import VARIABLE, family, right, truth

_RUN = "from meshforge.cli import main; main()"


def answer(asked: Asked) -> str:
    """Right, but of the third table, of which the model knows nothing of one hull and calls another by a wrong word."""
    said = {int(number): label for number, label in json.loads(right(asked))["hulls"].items()}
    return labels_as_json(said | ({0: "unknown", 1: "wheel"} if asked.asset == "t002.obj" else {}))


@pytest.fixture
def server(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Server]:
    """A server, and beside it a project `p` of three tables whose settings lead there."""
    monkeypatch.setenv(VARIABLE, KEY)
    monkeypatch.chdir(tmp_path)
    project = family(tmp_path, 3)
    with serving(answer) as made:
        with project.layout.settings.open("a") as file:
            file.write(
                f'\n[vlm]\nbase_url = "{made.base_url}"\nmodel = "{made.model}"\nkey_env = "{VARIABLE}"\nnames = true\n'
                "every_hull = true\nsize = 256\ninput_price = 1\noutput_price = 4\n"
            )
        yield made


@pytest.mark.slow
def test_it_says_what_was_labelled_what_was_not_and_what_it_cost(run: Run, server: Server, tmp_path: Path) -> None:
    told = run("label", "p", "--with", "vlm")
    assert told.code == 0
    lines = told.out.splitlines()
    assert lines[:5] == [
        "t000.obj: 6 labels taken",
        "t001.obj: 6 labels taken",
        "t002.obj: 4 labels taken, 2 hulls without a label",
        "    no label: top (the model does not know)",
        "    no label: left_low (the model said wheel, which is no label)",
    ]
    price = (server.usage["input"] + 4 * server.usage["output"]) / 1e6
    assert lines[-2] == (
        f"4 answers; {server.usage['input']:,} tokens in, {server.usage['output']:,} out; ${price:.4f}"
    )
    assert lines[-1].startswith("what was sent and what came back: ")
    assert len([*(Path(lines[-1].partition(": ")[2]) / "answers").iterdir()]) == 3
    again = run("label", "p", "--with", "vlm")
    assert "t000.obj: 0 labels taken, 6 there already\n" in again.out
    assert "0 answers, 3 more from earlier; 0 tokens in, 0 out; $0.0000\n" in again.out


@pytest.mark.slow
def test_json_has_a_line_an_asset_and_one_for_the_bill(run: Run, server: Server) -> None:
    lines = run("label", "p", "--with", "vlm", "--json").lines
    assert lines[2]["open"] == {"top": "the model does not know", "left_low": "the model said wheel, which is no label"}
    assert lines[-1]["bill"]["answered"] == 4
    assert (lines[-1]["ended"], lines[-1]["unasked"], lines[-1]["blind"]) == (None, [], False)


@pytest.mark.slow
def test_a_dry_run_says_what_would_be_sent_and_sends_nothing(run: Run, server: Server, tmp_path: Path) -> None:
    told = run("label", "p", "--with", "vlm", "--dry-run")
    assert told.code == 0
    lines = told.out.splitlines()
    host = server.base_url.split("/")[2]
    assert lines[0] == f"loopback-vl at {host}: 3 assets with 18 hulls to be labelled"
    assert lines[1].startswith("would send 3 questions with ")
    assert " out: about $0.0" in lines[2]
    assert lines[-1] == "nothing was sent"
    assert not server.asked
    assert {path.name for path in (tmp_path / "p/.meshforge").iterdir()} == {"survey.json"}
    run("label", "p", "--with", "vlm", "--dry-run", "--vocabulary", "top,foot")
    assert Project.open(tmp_path / "p").vocabulary == ("top", "leg", "misc")
    found = json.loads(run("label", "p", "--with", "vlm", "--dry-run", "--json", "--model", "other").out)
    assert (found["model"], found["hulls"]) == ("other", 18)


@pytest.mark.slow
def test_a_dry_run_says_that_the_key_or_the_prices_are_not_there(
    run: Run, server: Server, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv(VARIABLE)
    settings = tmp_path / "p/meshforge.toml"
    settings.write_text(settings.read_text().replace("input_price = 1\n", ""))
    told = run("label", "p", "--with", "vlm", "--dry-run").out
    assert f"the environment variable {VARIABLE}, which holds the key, is not set\n" in told
    assert "out: price not known\n" in told


@pytest.mark.slow
def test_the_limit_of_the_command_line_ends_it_with_what_is_left(run: Run, server: Server) -> None:
    told = run("label", "p", "--with", "vlm", "--max-cost", "0.0105")
    assert told.code == 1
    assert "The asking ended early: the next question could cost up to $" in told.err
    assert "  Raise --max-cost to go on; what was answered is not paid for again.\n" in told.err
    assert "not labelled: t00" in told.err
    assert "; run it again to go on\n" in told.err


@pytest.mark.slow
@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--model", "another"), "there is no model 'another' here: The model `another` does not exist"),
        (("--model", ""), "no model is named"),
        (("--base-url", "loopback"), "'loopback' is no address"),
        (("--labels", "x"), "--labels is for --with file"),
    ],
)
def test_what_does_not_fit_is_one_message(run: Run, server: Server, words: tuple[str, ...], message: str) -> None:
    told = run("label", "p", "--with", "vlm", *words)
    assert told.code == 2
    assert message in told.err
    assert told.err.count("error:") == 1
    assert not told.out


@pytest.mark.slow
def test_a_model_that_may_not_see_is_told(run: Run, server: Server) -> None:
    server._probed = lambda asked: "Green."  # type: ignore[method-assign]
    told = run("label", "p", "--with", "vlm")
    assert told.code == 0
    assert "The model took a red picture for another one: it may not see pictures at all." in told.err


@pytest.mark.slow
def test_ctrl_c_waits_for_what_is_under_way_and_the_next_run_goes_on(server: Server, tmp_path: Path) -> None:
    server.delay = 0.3
    settings = tmp_path / "p/meshforge.toml"
    settings.write_text(settings.read_text() + "concurrency = 1\n")
    words = [sys.executable, "-c", _RUN, "label", "p", "--with", "vlm"]
    first = subprocess.Popen(words, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    while not server.answered and first.poll() is None:
        time.sleep(0.01)
    time.sleep(0.1)  # the second question is under way
    first.send_signal(signal.SIGINT)
    out, err = first.communicate(timeout=60)
    assert first.returncode == 1
    assert "Traceback" not in err
    assert "stopping: waiting for the answers that are under way" in err
    assert "The asking ended early: stopped" in err
    assert "t000.obj: 6 labels taken" in out
    done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, env=os.environ, check=True)
    assert "Traceback" not in done.stderr
    assert max(Counter(asked.raw for asked in server.answered).values()) == 1
    labels = Project.open(tmp_path / "p").labels("t001.obj").labels
    assert {name: label.name for name, label in labels.items()} == truth("t001.obj")
