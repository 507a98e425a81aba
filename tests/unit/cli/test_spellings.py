"""One spelling for each thing on the command line: another one is an error that names it."""

from itertools import chain

import pytest

from meshforge.cli.main import COMMANDS, OTHER_SPELLINGS, load_command
from tests.unit.cli.in_process import Run


@pytest.mark.parametrize(
    ("words", "old", "new"),
    [
        (("apply", "p", "--fresh"), "--fresh", "--again"),
        (("apply", "p", "--force", "--out", "o"), "--force", "--again"),
        (("review", "p", "--redo"), "--redo", "--again"),
        (("review", "p", "--sure", "0.5"), "--sure", "--min-confidence"),
        (("prepare", "p", "--engine", "coacd"), "--engine", "--decompose"),
        (("new", "p", "a.obj", "--method=vhacd"), "--method", "--decompose"),
        (("decompose", "a.obj", "-o", "b.obj", "--method", "vhacd"), "--method", "--decompose"),
    ],
)
def test_another_spelling_is_an_error_that_names_the_one(run: Run, words: tuple[str, ...], old: str, new: str) -> None:
    told = run(*words)
    assert told.code == 2
    assert told.err == (
        f"error: meshforge {words[0]} has no {old}: it is {new}\n  All options: meshforge {words[0]} --help\n"
    )


@pytest.mark.parametrize(
    "words", [("check", "nope.obj", "--engine", "unreal"), ("apply", "p", "--out", "o", "--", "--fresh")]
)
def test_what_means_something_else_is_left_alone(run: Run, words: tuple[str, ...]) -> None:
    assert ": it is --" not in run(*words).err


@pytest.mark.parametrize("command", COMMANDS)
def test_no_command_has_two_spellings(command: str) -> None:
    options = set(chain.from_iterable(parameter.opts for parameter in load_command(command).params))
    assert not {other for other in options & OTHER_SPELLINGS.keys() if OTHER_SPELLINGS[other] in options}
    assert not options & {"--fresh", "--redo", "--force", "--method"}
