"""Golden programs: `NAME.mf` lies beside its canonical form, `NAME.out`, or the error that it gives, `NAME.err`."""

from pathlib import Path

import pytest

from meshforge.common import ProgramError
from meshforge.language import Program

GOLDEN = Path(__file__).parents[2] / "golden"


def text_of(path: Path) -> str:
    return path.read_bytes().decode()


@pytest.mark.parametrize("path", sorted(GOLDEN.glob("*.out")), ids=lambda path: path.stem)
def test_a_program_is_formatted_in_its_canonical_form(path: Path) -> None:
    program = Program.parse(text_of(path.with_suffix(".mf")), path.stem)
    assert str(program) == text_of(path)
    assert Program.parse(str(program)) == program
    assert str(Program.parse(str(program))) == str(program)


@pytest.mark.parametrize("path", sorted(GOLDEN.glob("*.err")), ids=lambda path: path.stem)
def test_an_error_names_its_line_and_column_and_what_is_expected(path: Path) -> None:
    source = path.with_suffix(".mf")
    with pytest.raises(ProgramError) as error:
        Program.parse(text_of(source), source.name)
    assert f"{error.value}\n" == text_of(path)


def test_every_golden_program_has_an_outcome() -> None:
    outcomes = {path.stem for path in GOLDEN.iterdir() if path.suffix in (".out", ".err")}
    assert {path.stem for path in GOLDEN.glob("*.mf")} == outcomes != set()
