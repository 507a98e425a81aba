"""A project without names on the command line: what each command says that cannot go on, and what to do then."""

from pathlib import Path

import pytest

from tests.unit.batch.families import write_table
from tests.unit.cli.in_process import Run

SHOW = "meshforge demonstrate p ASSET 'HULLS => ACTION' ..."


@pytest.fixture
def run(run: Run, tmp_path: Path) -> Run:
    """Runs the command line beside a project `p` of three tables without labels."""
    for k in range(3):
        write_table(tmp_path / f"assets/t{k}.obj", height=0.8 + 0.3 * k, labels=False)
    assert run("new", "p", "assets/*.obj").code == 0
    return run


@pytest.fixture
def learned(run: Run) -> Run:
    """The same, where one table was shown and a program was learned."""
    assert run("demonstrate", "p", "t0.obj", "crumb => Delete", "left_*,right_* => Each(Merge)").code == 0
    assert run("synthesize", "p").code == 0
    return run


@pytest.mark.parametrize("words", ["label p", "label p --with propagate", "synthesize p", "apply p"])
def test_each_command_that_cannot_go_on_says_what_comes_first(run: Run, words: str) -> None:
    told = run(*words.split())
    assert told.code == 2 and told.err.count("error: ") == 1 and SHOW in told.err
    run("demonstrate", "p", "t0.obj", "crumb => Delete")
    told = run(*words.split())
    assert told.code == 0 if words == "synthesize p" else "meshforge synthesize p" in told.err


def test_where_steps_gave_classes_they_are_named_as_labels_are(learned: Run) -> None:
    assert "\nvocabulary: none; of steps: part_a, part_b\n" in learned("status", "p").out
    assert "Or name the hulls that a step takes: meshforge label p --rename part_a=NAME" in learned("label", "p").err
    Path("assets/t9.obj").write_text(Path("assets/t1.obj").read_text())
    assert learned("select", "Is(part_a)", "t9.obj", "--project", "p").err.endswith(
        "no hull here is labelled 'part_a'\n"
    )
    told = learned("apply", "p/program.mf", "assets/t9.obj", "--out", "out", "--workers", "1")
    assert "Learning gives them to the assets of a project, by its demonstrations" in told.out


def test_a_class_is_corrected_by_hand_as_a_label_is(learned: Run) -> None:
    assert learned("label", "p", "t1.obj", "top=part_a", "crumb=").out.startswith("t1.obj: 1 hull labelled part_a, ")
    assert learned("select", "Is(part_a)", "t1.obj", "--project", "p").out == "top\n"
    refused = learned("label", "p", "t1.obj", "top=leg").err
    assert refused.endswith("The vocabulary is part_a, part_b. Set it with: --vocabulary a,b,c\n")
    assert learned("label", "p", "--rename", "part_a=slab").code == 0
    assert learned("select", "Is(slab)", "t1.obj", "--project", "p").out == "top\n"


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["part_b=leg", "--dry-run"], "--dry-run does not go with --rename"),
        (["part_b=leg", "--with", "names"], "--with does not go with --rename"),
        (["part_z=leg"], "there is no label 'part_z'\n  Did you mean 'part_b'?"),
        (["no part=rest"], "there is no label 'no part'"),
        (["part_a=part_c"], "'part_c' is a name that MeshForge gives to hulls that steps take"),
        (["part_a="], "--rename part_a=: it needs a label and its new name"),
        (["part_a=\udcff"], "--rename part_a=\\xff: it needs a label and its new name, in UTF-8"),
    ],
)
def test_a_name_that_cannot_be_is_one_error_and_changes_nothing(learned: Run, words: list[str], said: str) -> None:
    before = Path("p/program.mf").read_text()
    told = learned("label", "p", "--rename", *words)
    assert told.code == 2 and said in told.err and not told.out
    assert Path("p/program.mf").read_text() == before


def test_what_was_shown_on_an_asset_whose_file_has_another_name_comes_back_with_its_name(learned: Run) -> None:
    Path("assets/t0.obj").rename("assets/u0.obj")
    said = "kept for an asset that is not there: t0.obj (a file of that name gets it back)"
    assert said in learned("status", "p").out
    Path("assets/u0.obj").rename("assets/t0.obj")
    assert learned("synthesize", "p").code == 0
