"""`meshforge label PROJECT ASSET 'HULLS=LABEL'`: what it labels, what it refuses, and that the studio can undo it."""

import json
from pathlib import Path

import pytest

from meshforge.project import Project
from meshforge.store import History
from meshforge.studio.edits.assets import LabelHulls
from meshforge.studio.edits.base import make_edit
from meshforge.symbolic import Label
from tests.unit.batch.families import table_boxes, tree, write_table
from tests.unit.cli.in_process import Run

LEGS = tuple(name for name in table_boxes() if name not in ("top", "crumb"))
FIRST = "a/t0.obj"


@pytest.fixture
def run(run: Run, tmp_path: Path) -> Run:
    """Runs the command line beside a project `p` of three tables without labels, two of them in one folder."""
    for k, name in enumerate((FIRST, "a/t1.obj", "b/t1.obj")):
        write_table(tmp_path / "assets" / name, height=0.8 + 0.3 * k, labels=False)
    Project.create(tmp_path / "p", [tmp_path / "assets"], vocabulary=("top", "leg", "crumb"))
    return run


def labels_of(asset: str = FIRST) -> dict[str, Label]:
    return dict(Project.open("p").labels(asset).labels)


def test_hulls_are_labelled_by_name_and_pattern_as_a_person_does_and_the_last_argument_counts(run: Run) -> None:
    told = run("label", "p", FIRST, "*=leg", "crumb,t?p=top", "crumb = crumb")
    assert (told.code, told.err) == (0, "")
    said = "1 hull labelled top, 4 hulls labelled leg, 1 hull labelled crumb"
    assert told.out == f"{FIRST}: {said}; every hull has a label\n"
    words = {"top": "top", "crumb": "crumb"} | dict.fromkeys(LEGS, "leg")
    assert labels_of() == {name: Label(word, 1.0, "user") for name, word in words.items()}
    assert run("label", "p", FIRST, "top=top").out == f"{FIRST}: nothing to change; every hull has a label\n"


def test_a_machines_label_becomes_a_persons(run: Run) -> None:
    Project.open("p").set_labels(FIRST, {"top": "leg", "crumb": "crumb"}, source="vlm", confidence=0.8)
    told = run("label", "p", FIRST, "top=top", "crumb=crumb", "--json").json
    assert told == {"asset": FIRST, "labels": {"top": "top", "crumb": "crumb"}, "same": 0, "unlabelled": 4}
    assert {label.source for label in labels_of().values()} == {"user"}


def test_an_empty_label_takes_the_label_away(run: Run) -> None:
    run("label", "p", FIRST, "*=leg")
    told = run("label", "p", FIRST, "left_*=", "top=top")
    said = "1 hull labelled top, label of 2 hulls taken away; 2 hulls of 6 without a label"
    assert told.out == f"{FIRST}: {said}\n"
    assert set(labels_of()) == {"top", "right_low", "right_high", "crumb"}
    again = run("label", "p", FIRST, "left_*=", "crumb=leg", "--json").json
    assert again == {"asset": FIRST, "labels": {}, "same": 3, "unlabelled": 2}


def test_the_studio_undoes_one_command_as_one_edit_with_its_vocabulary(run: Run, tmp_path: Path) -> None:
    before = tree(tmp_path / "p")
    run("label", "p", FIRST, "top=lid", "left_*=leg", "--vocabulary", "lid,leg")
    project = Project.open("p")
    after = labels_of(), project.vocabulary
    assert after[1] == ("lid", "leg")
    history = History.open(project.folder)
    assert history.state.undo == f"{FIRST}: 1 hull labelled lid, 2 hulls labelled leg"
    history.undo()
    kept = {name: data for name, data in tree(tmp_path / "p").items() if not name.startswith(".meshforge")}
    assert kept == before
    history.redo()
    assert (labels_of(), project.vocabulary) == after


def test_a_studio_that_is_open_goes_on_with_the_history_that_the_command_made(run: Run) -> None:
    project = Project.open("p")
    studio = History.open(project.folder)
    for hull in ("top", "crumb"):
        make_edit(studio, project, LabelHulls(hulls={FIRST: (hull,)}, label="leg"))
    studio.undo()
    assert not studio.refresh()
    run("label", "p", FIRST, "left_low=leg")
    assert studio.refresh() and not studio.refresh()
    assert (studio.state.undo, studio.state.redoable) == (f"{FIRST}: 1 hull labelled leg", 0)
    run("label", "p", FIRST, "left_high=leg")
    make_edit(studio, project, LabelHulls(hulls={FIRST: ("crumb",)}, label="crumb"))
    assert set(labels_of()) == {"top", "left_low", "left_high", "crumb"}
    assert studio.state.undoable == History.open(project.folder).state.undoable == 4
    while studio.undo():
        pass
    assert labels_of() == {}


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["tpo=top"], "tpo=top: no hull is named 'tpo'\n  Did you mean 'top'?"),
        (["lft_*=top"], "lft_*=top: no hull is named 'lft_*'\n  Did you mean 'left_low'?"),
        (["top,x=top"], f"top,x=top: no hull is named 'x'\n  See the names with: meshforge info {FIRST} --project p"),
        (
            ["top=top", "crumb=crum"],
            "crumb=crum: the label 'crum' is not in the vocabulary\n"
            "  Did you mean 'crumb'? The vocabulary is top, leg, crumb.",
        ),
        (["top"], "top: it needs hulls and a label\n  Write it so: 'HULLS=LABEL'."),
        (["=top"], "=top: it needs hulls and a label\n  Write it so: 'HULLS=LABEL'."),
        ([], f"what is to be labelled on {FIRST} is missing\n  meshforge label p {FIRST} 'top=LABEL'"),
        (["--vocabulary", "leg,a b,a b"], "the label 'a b' is declared twice"),
        (["top=top", "--with", "names"], "--with says nothing on labels by hand\n  Leave it out, or ASSET."),
        (["top=top", "--dry-run"], "--dry-run says nothing on labels by hand\n  Leave it out, or ASSET."),
        (["top=top", "--model", "m"], "--model says nothing on labels by hand\n  Leave it out, or ASSET."),
        (["top=top", "--workers", "1"], "--workers says nothing on labels by hand\n  Leave it out, or ASSET."),
    ],
)
def test_what_is_wrong_is_one_error_and_nothing_is_written(run: Run, words: list[str], said: str) -> None:
    Project.open("p").set_labels(FIRST, {"crumb": "leg"})
    before = tree(Path("p/labels")), Path("p/meshforge.toml").read_bytes()
    told = run("label", "p", FIRST, "left_low=leg", *words) if words else run("label", "p", FIRST)
    assert (told.code, told.out, told.err) == (2, "", f"error: {said}\n")
    assert (tree(Path("p/labels")), Path("p/meshforge.toml").read_bytes()) == before


def test_without_a_vocabulary_the_error_says_how_to_set_it(run: Run) -> None:
    Project.open("p").set_vocabulary(())
    said = "The vocabulary is empty. Set it with: --vocabulary a,b,c"
    assert run("label", "p", FIRST, "top=top").err.splitlines()[1] == f"  {said}"


@pytest.mark.parametrize(
    "typed",
    [FIRST, f"assets/{FIRST}", "t0.obj", "t0", "a/t0", f"elsewhere/{FIRST}", "b", "b/t0.obj", "far/t0", "/x/t0.obj"],
)
def test_an_asset_is_known_by_its_file_and_by_what_no_other_has_of_its_id(run: Run, typed: str) -> None:
    assert run("label", "p", typed, "top=top").out.startswith("b/t1.obj: " if typed == "b" else f"{FIRST}: ")
    assert run("demonstrate", "p", typed, "top => Delete").out == "1. top => Delete\n"


def test_an_asset_that_is_not_clear_is_asked_for_by_name(run: Run, tmp_path: Path) -> None:
    twice = run("label", "p", "t1.obj", "top=top").err
    assert twice == f"error: {tmp_path}/p: 't1.obj' may be any of 2 assets\n  Say which: a/t1.obj, b/t1.obj.\n"
    nearest = run("label", "p", "b/far/t1.obj", "top=top").err
    assert nearest.endswith("'b/far/t1.obj' may be any of 2 assets\n  Say which: b/t1.obj, a/t1.obj.\n")
    near = run("label", "p", "far/away/from/here/tt0.obj", "top=top").err
    assert near == f"error: {tmp_path}/p: there is no asset 'far/away/from/here/tt0.obj'\n  Did you mean '{FIRST}'?\n"
    write_table(tmp_path / "t0.obj")
    assert "there is no asset 't0.obj'\n  Did you mean 'a/t0.obj'?" in run("label", "p", "t0.obj", "top=top").err
    none = run("label", "p", "top=top").err
    assert none == "error: top=top: of which asset?\n  meshforge label p ASSET 'top=top'\n"
    assert not Path("p/labels").exists()


def test_status_proposes_the_command_where_nothing_is_labelled(run: Run) -> None:
    Project.open("p").set_vocabulary(("panel", "leg"))
    advised = json.loads(run("status", "p", "--json").out)["next"]
    assert advised["command"] == f"meshforge label p {FIRST} 'top=LABEL'"
    assert advised["text"].endswith(f"label those of {FIRST}.")


def test_a_label_that_no_asset_has_is_named_with_the_nearest(run: Run, tmp_path: Path) -> None:
    run("label", "p", FIRST, "*=leg", "top=top")
    Path("p.mf").write_text("Is(legs) => Delete\nIs(top) => Merge as slab\nIs(slab) => Delete\n")
    words = ("apply", "p.mf", f"assets/{FIRST}", "--out", "out", "--labels", f"p/labels/{FIRST}.json", "--workers", "1")
    said = "the program asks for 'legs', a label that no asset has; did you mean 'leg'?\n"
    assert run(*words).err == said
    assert run(*words).err == said  # that is up to date, and says so again
    selected = run("select", "Is(legs)", FIRST, "--project", "p")
    assert (selected.code, selected.out) == (2, "")
    said = "no hull is labelled 'legs'\n  Did you mean 'leg'? Labels are crumb, leg, top."
    assert selected.err == f"error: {FIRST}: {said}\n"
    selected = run("select", "Is(crumb)", FIRST, "--project", "p")  # a label of the family that this asset lacks
    assert (selected.code, selected.out) == (0, "")
    assert selected.err == "0 of 6 hulls\nno hull here is labelled 'crumb'\n"
    shown = run("demonstrate", "p", FIRST, "top => Merge as tpo").err
    said = "rule 1: the label 'tpo' is not in the vocabulary\n  Did you mean 'top'? The vocabulary is top, leg, crumb."
    assert shown == f"error: {FIRST}: {said}\n"
    assert not Path("p/demonstrations").exists()
    Project.open("p").set_vocabulary(())  # then it is what the steps and the hulls say
    assert run("demonstrate", "p", FIRST, "top => Merge as tpo").code == 0
