"""`meshforge demonstrate`: what stands left of an arrow is hulls by name, number or pattern, or an extractor."""

from pathlib import Path

import pytest

from meshforge.project import Project
from tests.unit.batch.families import write_table
from tests.unit.cli.in_process import Run

LEGS = "left_high, left_low, right_high, right_low"


@pytest.fixture
def run(run: Run, tmp_path: Path) -> Run:
    for name in ("t0.obj", "t1.obj"):
        write_table(tmp_path / "assets" / name)
    project = Project.create(tmp_path / "p", [tmp_path / "assets"], vocabulary=("top", "leg", "misc"))
    legs = dict.fromkeys(LEGS.split(", "), "leg")
    project.set_labels("t0.obj", {"top": "top", **legs}, source="user")
    project.set_labels("t1.obj", {"top": "top", "crumb": "misc", **legs}, source="user")
    return run


@pytest.mark.parametrize(
    ("hulls", "recorded"),
    [
        ("#0", "top"),
        ("#5,#0", "crumb, top"),
        ("left_*, #5", "crumb, left_high, left_low"),
        ("Is(leg)", LEGS),
        ("Union(Is(top), Geo(Is(leg), -X))", "left_high, left_low, top"),
        ("Attach(Is(leg), Is(top))", "left_high, right_high"),
        ("All", f"crumb, {LEGS}, top"),
        ("nothing", "nothing"),
    ],
)
def test_hulls_are_given_by_number_or_by_an_extractor(run: Run, hulls: str, recorded: str) -> None:
    assert run("demonstrate", "p", "t0.obj", f"{hulls} => Delete").out == f"1. {recorded} => Delete\n"


def test_who_asks_what_is_demonstrated_is_told_that_nothing_is(run: Run) -> None:
    assert (run("demonstrate", "p", "t0.obj").out, run("demonstrate", "p", "t0.obj").err) == (
        "",
        "t0.obj: nothing is demonstrated yet\n",
    )
    run("demonstrate", "p", "t0.obj", "#0 => Delete")
    told = run("demonstrate", "p", "t0.obj")
    assert (told.out, told.err) == ("1. top => Delete\n", "")


def test_an_extractor_sees_what_earlier_steps_made_and_numbers_stay_those_of_the_list(run: Run) -> None:
    steps = ("Is(leg) => Merge as misc", "Is(misc) => Each(Replace(box))", "#0 => Replace(box)")
    told = run("demonstrate", "p", "t0.obj", *steps).out.splitlines()
    assert told == [f"1. {LEGS} => Merge as misc", "2. left_low~1 => Each(Replace(box))", "3. top => Replace(box)"]


@pytest.mark.parametrize(
    ("steps", "said"),
    [
        (
            ["#6 => Delete"],
            "step 1: no hull has the number #6\n  Hulls have the numbers #0 to #5: meshforge info ASSET",
        ),
        (["top => Delete", "#0 => Delete"], "step 2: #0 is top, which an earlier step took away"),
        (
            ["Is(legs) => Delete"],
            "step 1: no hull is labelled 'legs'\n  Did you mean 'leg'? Labels are leg, misc, top.",
        ),
        (
            ["Is(top) => Replace(box)", "Diff(Is(leg), All) => Delete"],
            "step 2: Diff(Is(leg), All) selects nothing here\n"
            "  Name hulls, or write `nothing` where this asset has nothing to select.",
        ),
        (["leg(1) => Delete"], "step 1: no hull is named 'leg(1)'\n  See the names with: meshforge info ASSET"),
    ],
)
def test_what_cannot_be_meant_is_one_error(run: Run, steps: list[str], said: str) -> None:
    told = run("demonstrate", "p", "t0.obj", *steps)
    assert (told.code, told.out, told.err) == (2, "", f"error: {said}\n")
    assert not Path("p/demonstrations").exists()


def test_a_label_of_the_family_that_this_asset_lacks_selects_nothing(run: Run) -> None:
    told = run("demonstrate", "p", "t0.obj", "Is(misc) => Delete")
    assert told.code == 2
    assert told.err.startswith(
        "error: step 1: Is(misc) selects nothing here: no hull here is labelled misc\n  Name hulls"
    )
    Project.open("p").set_vocabulary(())  # then it is what the labels files say
    assert run("demonstrate", "p", "t0.obj", "Is(misc) => Delete").err == told.err
    assert (
        "no hull is labelled 'mist'\n  Did you mean 'misc'?"
        in run("demonstrate", "p", "t0.obj", "Is(mist) => Delete").err
    )


@pytest.mark.parametrize("text", ["is(leg)", "Is(leg", "Geo(Is(leg))"])
def test_an_extractor_that_does_not_parse_is_shown_with_a_caret(run: Run, text: str) -> None:
    told = run("demonstrate", "p", "t0.obj", f"{text} => Delete")
    assert told.code == 2 and told.err.startswith("error: step 1:1:") and "^" in told.err


def test_a_hull_that_is_called_as_an_extractor_or_a_number_is_meant_first(run: Run) -> None:
    path = Path("assets/t0.obj")
    path.write_text(path.read_text().replace("o top", "o Is(leg)").replace("o crumb", "o #0"))
    assert run("demonstrate", "p", "t0.obj", "Is(leg) => Delete", "#0 => Delete").out == (
        "1. Is(leg) => Delete\n2. #0 => Delete\n"
    )


def test_each_step_says_how_many_hulls_it_makes_and_which_it_joins(run: Run) -> None:
    said = run(
        "demonstrate", "p", "t0.obj", "left_* => Each(Replace(box, tight))", "right_* => Delete", "nothing => Merge"
    )
    assert said.err.splitlines()[:2] == [
        "   2 hulls -> 1, of which left_low~1 joins left_low, left_high",
        "   2 hulls -> 0",
    ]
    assert "hull" not in run("demonstrate", "p", "t0.obj").err


def test_a_number_without_its_sign_is_an_error_that_shows_it(run: Run) -> None:
    assert "Write it so: '#1-3'" in run("demonstrate", "p", "t0.obj", "#0,1-3 => Delete").err
