from pathlib import Path

import pytest

from meshforge.cli.demo import STUDIO_MARK, create_tables, open_tables
from meshforge.common import UsageError


def test_what_was_done_is_there_when_one_comes_back(tmp_path: Path) -> None:
    open_tables(tmp_path / "demo").set_labels("table_01.obj", {"convex_00": "leg"})
    again = open_tables(tmp_path / "demo")
    assert again.labels("table_01.obj").labels["convex_00"].name == "leg"
    with pytest.raises(UsageError, match="something else"):
        create_tables(tmp_path / "demo")
    assert (tmp_path / "demo" / "project").exists()


def test_a_demo_that_was_killed_while_it_was_made_is_made_anew(tmp_path: Path) -> None:
    (tmp_path / "demo").mkdir()
    (tmp_path / "demo" / STUDIO_MARK).touch()
    (tmp_path / "demo" / "assets").mkdir()
    assert len(open_tables(tmp_path / "demo").assets()) == 14


def test_a_folder_of_yours_is_never_taken(tmp_path: Path) -> None:
    (tmp_path / "thesis.txt").write_text("do not lose me")
    with pytest.raises(UsageError, match="something else"):
        open_tables(tmp_path)
    assert (tmp_path / "thesis.txt").read_text() == "do not lose me"
