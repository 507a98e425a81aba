"""The committed table of the corpus: complete, without faults of ours, and true of what is read today."""

from __future__ import annotations

import pytest

from script.corpus_rows import entries, row
from script.corpus_table import PAGE, TABLE, differences, page, parse, rows, table
from tests.corpus_path import corpus

_EVERY = 8  # one file in so many is read again; `script/corpus --check` reads all


def committed() -> dict[str, str]:
    return parse(TABLE.read_text(encoding="utf-8"))


def test_every_file_of_the_corpus_has_a_row() -> None:
    assert list(committed()) == entries(corpus())


def test_no_row_holds_nothing_and_none_is_a_fault_of_ours() -> None:
    for line in committed().values():
        _, _, hulls, _, opaque, _, notes, message = line.split("\t")
        assert int(hulls) or int(opaque) or message or "no collision geometry" in notes, line
        assert "Traceback" not in line and "fault of MeshForge" not in line, line
        assert "warning: " not in notes and "stderr: " not in notes, line


@pytest.mark.slow
@pytest.mark.parametrize("start", range(0, _EVERY, 4))
def test_files_read_as_the_table_says(start: int) -> None:
    root = corpus()
    names = [name for name in list(committed())[start::_EVERY] if not name.endswith("/")]
    after = parse(table(row((str(root), name)) for name in names))
    assert differences({name: committed()[name] for name in names}, after) == []


def test_the_page_lists_what_the_table_holds() -> None:
    names = [name for name in committed() if committed()[name].split("\t")[7]]
    text = PAGE.read_text(encoding="utf-8")
    assert names and all(f"| {name} |" in text for name in names)


def test_a_worker_reads_as_this_process_does() -> None:
    root = corpus()
    names = ["weird/02_flat_pieces_collision.obj", "weird/20_empty_nodes.glb"]
    found = rows(root, names, workers=1)
    assert found == [row((str(root), name)) for name in names]
    assert "## Refused (1)" in page(found)
