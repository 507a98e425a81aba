"""`meshforge label --with propagate`: what it says, in words and as JSON."""

import json
import re
from pathlib import Path

import pytest

from meshforge.project import Project
from tests.unit.batch.families import tree
from tests.unit.cli.in_process import Run
from tests.unit.cli.test_label_sources import told
from tests.unit.labels.test_label_by_propagation import family
from tests.unit.labels.test_weighed_labels import RIGHT, guessed


@pytest.fixture
def run(run: Run, tmp_path: Path) -> Run:
    """Runs the command line beside a project `p` of six tables that a model labelled, not all of them rightly."""
    guessed(tmp_path)
    return run


SURE = re.compile(r"0\.\d\d$", re.MULTILINE)
SHOWN = """\
label   from                names      hulls   assets   confidence
──────────────────────────────────────────────────────────────────
top     likeness, not leg   top            1        1   SURE
leg     likeness            left_low       1        1   SURE
2 labels would be taken; 0 hulls left without one; 34 hulls would stay as they are. Nothing was written."""
DONE = """\
t0.obj: 0 labels taken, 6 there already
t1.obj: 1 label taken, 5 there already
t2.obj: 1 label taken, 5 there already
t3.obj: 0 labels taken, 6 there already
t4.obj: 0 labels taken, 6 there already
t5.obj: 0 labels taken, 6 there already

labels from   sure   likely   unsure
────────────────────────────────────
a model          0       34        0
propagation      2        0        0
no label                           0

1 hull got a label; 1 label was replaced:
    leg -> top: 1 hull in 1 asset
If some are wrong, label or correct this one next:"""


@pytest.mark.slow
def test_it_shows_what_it_would_do_and_does_it(run: Run, tmp_path: Path) -> None:
    before = tree(tmp_path / "p/labels")
    shown = run("label", "p", "--with", "propagate", "--dry-run")
    assert (shown.code, SURE.sub("SURE", told(shown.out)), shown.err) == (0, SHOWN, "")
    assert tree(tmp_path / "p/labels") == before
    done = run("label", "p", "--with", "propagate")
    assert (done.code, done.err) == (0, "6 assets (6 OBJ), 6 with labels\n")
    assert told(done.out).replace(f"{tmp_path}/", "").rpartition(" ")[0] == DONE
    again = told(run("label", "p", "--with", "propagate").out)
    assert "\nEvery hull keeps its label.\n" in again and again.count("0 labels taken, 6 there already") == 6


@pytest.mark.slow
def test_json_says_the_same(run: Run) -> None:
    *reports, closing, last = map(json.loads, run("label", "p", "--with", "propagate", "--json").out.splitlines())
    assert [row["taken"] for row in reports] == [0, 1, 1, 0, 0, 0]
    assert {share["source"] for share in closing["labels"]["shares"]} == {"vlm", "propagated"}
    new, replaced = {"was": None, "label": "leg"}, {"was": "leg", "label": "top"}
    assert last["changes"] == [{**new, "hulls": 1, "assets": 1}, {**replaced, "hulls": 1, "assets": 1}]
    assert last["alike"] == [] and last["next"].endswith(".obj")


@pytest.mark.slow
def test_labels_of_people_alone_leave_nothing_to_do(run: Run, tmp_path: Path) -> None:
    project = Project.open(tmp_path / "p")
    for asset in project.assets():
        project.set_labels(asset, RIGHT)
    told_again = run("label", "p", "--with", "propagate")
    assert told_again.code == 0
    assert told_again.out.endswith("\nPeople labelled every hull: nothing is left to do.\n")


@pytest.mark.slow
def test_two_names_of_one_part_are_named_with_the_remedy(run: Run, tmp_path: Path) -> None:
    project = Project.open(tmp_path / "p")
    project.set_vocabulary(("top", "leg", "legs", "misc"))
    for asset in project.assets()[::2]:
        legs = {name: "legs" for name, label in RIGHT.items() if label == "leg"}
        project.set_labels(asset, legs, source="vlm", confidence=0.8)
    remedy = "meshforge label p --with propagate --vocabulary top,leg,misc"
    said = f"leg and legs are on hulls that look alike, and hardly an asset has both. If they are one part, {remedy}"
    found = run("label", "p", "--with", "propagate").out.replace(f"{tmp_path}/", "")
    assert said.replace("part, ", "part, leave one of them out: ") in found
    after = run(*remedy.split()[1:])
    assert after.code == 0 and "look alike" not in after.out
    labels = [project.labels(asset).labels for asset in project.assets()]
    assert {label.name for one in labels for label in one.values()} == {"top", "leg", "misc"}


@pytest.mark.slow
def test_without_any_label_there_is_one_error_with_the_remedy(run: Run, tmp_path: Path) -> None:
    family(tmp_path / "bare")
    told_it = run("label", "bare/p", "--with", "propagate")
    assert told_it.code == 2 and not told_it.out
    assert told_it.err.count("there is no label that others could be taken from") == 1
    assert "Label the hulls of one asset first, best t" in told_it.err


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--with", "propagate", "--labels", "p"), "--labels is for --with file"),
        (("--with", "propagate", "--pattern", "a=b"), "--pattern is for --with names and --with file"),
        (("--with", "propagate", "--model", "x"), "--model is for --with vlm"),
    ],
)
def test_misuse_is_told_in_one_message(run: Run, words: tuple[str, ...], message: str) -> None:
    done = run("label", "p", *words)
    assert done.code == 2 and not done.out
    assert done.err.count(message) == 1
