"""Programs and their nodes made in Python, and programs read from files."""

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import meshforge.language
from meshforge.common import ProgramError
from meshforge.language import (
    All,
    Delete,
    Each,
    Geo,
    Is,
    LandmarkPair,
    Merge,
    Orient,
    Program,
    Rule,
    Union,
    parse_extractor,
)

GEO = Geo(Is("leg"), "+X")
UNTYPED: Any = meshforge.language  # to write what a type checker refuses


@pytest.mark.parametrize(
    ("wrong", "problem"),
    [
        (lambda: Is(""), "at least one character"),
        (lambda: UNTYPED.Geo(GEO, "+X"), r"Geo takes All or Is\(label\)"),
        (lambda: UNTYPED.Geo(All(), "X"), "unknown direction 'X'"),
        (lambda: UNTYPED.Attach(All(), Union(All(), All())), r"Attach takes All or Is\(label\)"),
        (lambda: UNTYPED.Diff(All(), "leg"), "Diff takes extractors"),
        (lambda: UNTYPED.LandmarkPair("+Z", GEO, All()), r"LandmarkPair takes All or Is\(label\)"),
        (lambda: Orient(()), "one or two landmark pairs, not 0"),
        (lambda: Orient((LandmarkPair("+Z", All(), All()), LandmarkPair("-Z", All(), All()))), "axis Z twice"),
        (lambda: Rule(All(), Each(Delete()), "leg"), "makes no hull that could take the label 'leg'"),
        (lambda: Rule(All(), Merge(), ""), "at least one character"),
        (lambda: Program(("leg", "leg")), "declared twice"),
        (lambda: Program(("panel",), rules=(Rule(GEO, Delete()),)), "unknown label 'leg'"),
        (lambda: Program(contact=0.0), "contact is a share"),
        (lambda: Program(extremity=float("nan")), "extremity is a share"),
    ],
)
def test_a_node_that_cannot_be_is_refused_at_birth(wrong: Callable[[], object], problem: str) -> None:
    with pytest.raises(ProgramError, match=problem):
        wrong()


def test_a_program_without_declared_labels_declares_those_it_uses() -> None:
    program = Program.parse("orient +Z: Is(leg) -> Is(top)\nAttach(Is(knob), Is(leg)) => Merge as grip")
    assert program.labels == ("leg", "top", "knob", "grip")
    assert str(program).startswith("labels leg, top, knob, grip\n")


def test_a_program_names_its_templates_once_each_in_order() -> None:
    text = 'All => Add(+X, "b.obj")\nAll => Each(Replace("a.obj"))\nAll => Replace("b.obj")\nAll => Replace(box)'
    assert Program.parse(text).templates == ("b.obj", "a.obj")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("Is(leg", "extractor:1:7: expected `)`, not the end of the line"),
        ("Is(leg) => Delete", "extractor:1:9: expected the end of the line, not `=>`"),
        ("", "extractor:1:1: expected an extractor"),
    ],
)
def test_errors_in_an_extractor_have_their_place(text: str, message: str) -> None:
    with pytest.raises(ProgramError) as error:
        parse_extractor(text)
    assert str(error.value).startswith(message)


def test_a_program_is_read_from_a_file(tmp_path: Path) -> None:
    path = tmp_path / "tables.mf"
    path.write_text("\ufeffIs(leg) => Merge\n", encoding="utf-8")
    assert Program.read(path) == Program.parse("Is(leg) => Merge")
    path.write_text("Is(leg) =>", encoding="utf-8")
    with pytest.raises(ProgramError) as error:
        Program.read(path)
    assert error.value.where == f"{path}:1:11"


def test_a_program_that_cannot_be_read_is_named(tmp_path: Path) -> None:
    with pytest.raises(ProgramError, match=r"none.mf: the program cannot be read"):
        Program.read(tmp_path / "none.mf")
    (tmp_path / "bytes.mf").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(ProgramError, match=r"bytes.mf: the program is not text in UTF-8"):
        Program.read(str(tmp_path / "bytes.mf"))


@pytest.mark.slow
def test_the_language_is_imported_without_the_parser_library() -> None:
    code = "import sys, meshforge.language; sys.exit('lark' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
