"""How tables are printed where nobody's terminal bounds them."""

import pytest

from meshforge.cli import console


def test_a_piped_table_breaks_no_line_however_long(capsys: pytest.CaptureFixture[str]) -> None:
    remark = "word " * 400
    console.print_table(["asset", "remarks"], [["a.obj", remark.strip()], ["b.obj", None]])
    header, rule, first, second = capsys.readouterr().out.splitlines()
    assert header.split() == ["asset", "remarks"] and set(rule) <= {"─", " "}
    assert first.split("  ")[0] == "a.obj" and first.rstrip().endswith(remark.strip())
    assert second.strip() == "b.obj"


def test_a_piped_table_is_what_rich_prints(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    columns, right = ("asset", "hulls", "remarks"), ("hulls",)
    tables: list[list[tuple[object, ...]]] = [
        [],
        [("a.obj", 12, None), ("a longer name.obj", None, "[bold]not bold[/]")],
        [("", "", ""), ("x", 123456, "two  blanks ")],
    ]
    for rows in tables:
        console.print_table(columns, rows, right=right)
        plain = capsys.readouterr().out
        with monkeypatch.context() as forced:
            forced.setattr(console, "_print_plain_table", None)
            forced.setattr(console, "_TERMINAL_SETTINGS", frozenset({"PATH"}))
            console.print_table(columns, rows, right=right)
        assert capsys.readouterr().out == plain


def test_names_that_are_no_plain_letters_are_aligned_by_rich(capsys: pytest.CaptureFixture[str]) -> None:
    console.print_table(("asset", "hulls"), [("卓子.obj", 3), ("a.obj", 4)])
    _, _, first, second = capsys.readouterr().out.splitlines()
    assert first.index("3") == second.index("4") - 2
