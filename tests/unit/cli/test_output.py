"""How tables are printed where nobody's terminal bounds them."""

from __future__ import annotations

import pytest

from meshforge.cli import console


def test_a_piped_table_breaks_no_line_however_long(capsys: pytest.CaptureFixture[str]) -> None:
    remark = "word " * 400
    console.print_table(["asset", "remarks"], [["a.obj", remark.strip()], ["b.obj", None]])
    header, rule, first, second = capsys.readouterr().out.splitlines()
    assert header.split() == ["asset", "remarks"] and set(rule) <= {"─", " "}
    assert first.split("  ")[0] == "a.obj" and first.rstrip().endswith(remark.strip())
    assert second.strip() == "b.obj"
