"""What `meshforge review` prints, from the first look to the last, is the text in tests/golden/review; rewrite it with:
`python -m tests.loop.test_review_texts`.
"""

from __future__ import annotations

import io
import json
import os
import re
import sys
from collections.abc import Iterator
from contextlib import chdir, redirect_stderr, redirect_stdout
from pathlib import Path
from shutil import copyfile
from tempfile import TemporaryDirectory
from unittest.mock import patch

import pytest

from meshforge.cli import main
from meshforge.cli.review_session import draw_question
from meshforge.formats import load
from meshforge.samples import TABLES
from tests.loop.mistaken_tables import create_project, reply_to

GOLDEN = Path(__file__).parents[1] / "golden" / "review"
SHOWN, CHANGED, MOST_REPLIES = "table_08.obj", "table_02.obj", 24


def run(*words: str) -> str:
    """What a command prints, as one types it, and its exit code."""
    printed = io.StringIO()
    with redirect_stdout(printed), redirect_stderr(printed), patch.object(sys, "argv", ["meshforge", *words]):
        try:
            main()
            code: object = 0
        except SystemExit as left:
            code = left.code
    here = re.escape(f"{os.path.realpath(Path.cwd())}{os.sep}")
    text = re.sub(here, "", printed.getvalue())
    return f"$ meshforge {' '.join(words)}\n{text}exit code {code or 0}\n"


def make_texts() -> Iterator[tuple[str, str]]:
    """The name and the text of each scene, in a folder that is empty at first."""
    project = create_project(Path.cwd(), ())
    yield "00_nothing_demonstrated", run("review", "tables")
    copyfile(TABLES / "demonstrations" / f"{SHOWN}.json", project.folder / "demonstrations" / f"{SHOWN}.json")
    said, words = Path("said.json"), ["review", "tables"]
    for number in range(1, MOST_REPLIES):
        with patch("meshforge.cli.review.draw_question", wraps=draw_question) as drawn:
            text = run(*words)
        question = drawn.call_args.args[-1] if drawn.called else None
        yield f"{number:02}_{question.kind if question else 'signed_off'}", text
        if question is None:
            break
        said.write_text(json.dumps([{"id": question.id, **reply_to(question.to_json(), project)}]))
        words = ["review", "tables", "--answers", "said.json"]
    said.write_text(json.dumps([{"id": "reading-of-old", "choice": "a"}]))
    yield "not_asked_any_more", run("review", "tables", "--answers", "said.json")
    yield "a_higher_bar", run("review", "tables", "--min-confidence", "0.9999")
    run("apply", "tables", "--workers", "1")
    run("review", "tables")
    project.set_labels(CHANGED, {load(TABLES / CHANGED).hulls[0].name: "misc"}, source="name")
    yield "signed_off_no_longer", run("review", "tables")


def test_a_review_says_what_it_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    texts = dict(make_texts())
    assert texts.keys() == {path.stem for path in GOLDEN.glob("*.txt")}
    for name, text in texts.items():
        assert text == (GOLDEN / f"{name}.txt").read_text(encoding="utf-8"), name


if __name__ == "__main__":
    GOLDEN.mkdir(exist_ok=True)
    for path in GOLDEN.glob("*.txt"):
        path.unlink()
    with TemporaryDirectory() as folder, chdir(folder):
        for title, made in make_texts():
            (GOLDEN / f"{title}.txt").write_text(made, encoding="utf-8")
