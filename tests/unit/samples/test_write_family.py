"""Writing a family into a folder: nothing of the user's is replaced, and nothing is added to it."""

from pathlib import Path

import pytest

from meshforge.common import UsageError
from meshforge.samples import family_of, write_family

TABLES = family_of("tables")


def test_files_that_are_missing_are_written_again(tmp_path: Path) -> None:
    assert write_family(TABLES, tmp_path / "new" / "tables") == len(TABLES.read())
    assert write_family(TABLES, tmp_path / "new" / "tables") == 0
    (tmp_path / "new" / "tables" / "table_05.obj").unlink()
    assert write_family(TABLES, tmp_path / "new" / "tables") == 1
    assert (tmp_path / "new" / "tables" / "table_05.obj").read_bytes() == TABLES.read()["table_05.obj"]


def test_a_file_of_the_user_is_never_replaced(tmp_path: Path) -> None:
    (tmp_path / "table_05.obj").write_text("mine")
    with pytest.raises(UsageError, match=r"something else: table_05\.obj"):
        write_family(TABLES, tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["table_05.obj"]
    assert (tmp_path / "table_05.obj").read_text() == "mine"


def test_what_a_user_added_beside_all_files_stays(tmp_path: Path) -> None:
    write_family(TABLES, tmp_path)
    (tmp_path / "notes.txt").write_text("mine")
    assert write_family(TABLES, tmp_path) == 0
    assert (tmp_path / "notes.txt").read_text() == "mine"
