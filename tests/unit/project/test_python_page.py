"""The page on Python: its examples run, in the order of the page and in one folder, and it names what there is."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import meshforge as mf
from meshforge.samples import TABLES

PAGE = (Path(__file__).parents[3] / "docs" / "python.md").read_text(encoding="utf-8")


def test_every_example_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("table_01.obj", "table_01.labels.json"):
        (tmp_path / name).write_bytes((TABLES / name).read_bytes())
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"^```python\n(.*?)^```$", PAGE, re.DOTALL | re.MULTILINE)
    assert len(blocks) == 4
    for block in blocks:
        exec(block, {})


def test_every_name_that_the_page_gives_is_one_of_the_interface() -> None:
    assert set(re.findall(r"\bmf\.(\w+)", PAGE)) <= set(mf.__all__)
