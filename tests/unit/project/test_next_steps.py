"""What `status` proposes next is typed word for word, in each state of a project; it has to work, and to lead on."""

import shlex
from collections.abc import Callable
from pathlib import Path

import pytest

from meshforge.project import Project, Status
from tests.unit.batch.families import label_of, table_boxes, write_table
from tests.unit.cli.in_process import Run
from tests.unit.project.shelves import ambiguous
from tests.unit.project.tables import FIRST, SECOND, THIRD, applied, demonstrated, fresh, labelled, learned
from tests.urdf_sample import corner_obj

LABELS = {name: label_of(name) for name in table_boxes()}


def of(project: Project) -> Status:
    return Project.open(project.folder).status(workers=0)


def bare(folder: Path) -> Project:
    """Three tables with no label anywhere."""
    for name in ("a", "b", "c"):
        write_table(folder / f"assets/{name}.obj", labels=False)
    return Project.create(folder / "tables", [folder / "assets"], vocabulary=["top", "leg", "misc"])


def one_labelled(folder: Path) -> Project:
    project = bare(folder)
    project.set_labels("a.obj", LABELS)
    return project


def one_named(folder: Path) -> Project:
    """Names that say what hulls are."""
    project = bare(folder)
    project.set_vocabulary(("top", "left", "right", "crumb"))
    return project


def new_asset(folder: Path) -> Project:
    project = applied(folder)
    write_table(folder / "assets/new/model.obj", 1.7, labels=False)
    return project


def new_asset_with_labels(folder: Path) -> Project:
    project = applied(folder)
    write_table(folder / "assets/new/model.obj", 1.7)
    return project


def changed_asset(folder: Path) -> Project:
    project = applied(folder)
    write_table(folder / "assets" / THIRD, 4.0)
    return project


def without_hulls(folder: Path) -> Project:
    """A piece that is not convex and has to be decomposed."""
    (folder / "assets").mkdir(parents=True)
    (folder / "assets/angle.obj").write_text(corner_obj())
    return Project.create(folder / "tables", [folder / "assets"], vocabulary=["top"])


def signed_off(folder: Path) -> Project:
    project = applied(folder)
    project.set_verdict([FIRST, SECOND, THIRD], "accepted")
    return project


def open_rule(folder: Path) -> Project:
    """Racks of which learning leaves open what a rule means."""
    project = ambiguous(folder)
    project.synthesize()
    return project


STATES: dict[str, tuple[Callable[[Path], Project], str, tuple[int, ...]]] = {
    "labels files beside the assets": (fresh, "label tables", (0,)),
    "names that say labels": (one_named, "label tables", (0,)),
    "one asset labelled": (one_labelled, "label tables", (0,)),
    "demonstrated": (demonstrated, "synthesize tables", (0,)),
    "an open question": (open_rule, "review {0}", (0, 1)),
    "learned": (learned, "apply tables", (0,)),
    "applied": (applied, "review tables", (0, 1)),
    "signed off": (signed_off, "check tables/edited", (0,)),
    "an asset changed": (changed_asset, "apply tables", (0,)),
    "a new asset": (new_asset, "label tables", (0,)),
    "a new asset with a labels file": (new_asset_with_labels, "label tables", (0,)),
    "pieces to be decomposed": (without_hulls, "prepare tables --decompose coacd", (0,)),
}
"""How each is made, the command that is proposed, and the exit codes that mean it did what it should."""


@pytest.mark.slow
@pytest.mark.parametrize("state", STATES)
def test_what_is_proposed_works_and_something_else_is_proposed_then(state: str, tmp_path: Path, run: Run) -> None:
    make, command, codes = STATES[state]
    project = make(tmp_path)
    advice = of(project).next
    assert advice.command == f"meshforge {command.format(project.folder.name)}", advice
    shown = run("status", project.folder.name).out
    assert f"\nNext: {advice.text}\n  {advice.command}" in shown
    done = run(*shlex.split(advice.command)[1:])
    assert done.code in codes, (done.out, done.err)
    if state not in ("an open question", "applied", "signed off"):  # which a person has to answer, or are the end
        assert of(project).next != advice


def test_by_hand_the_proposed_command_needs_but_the_label(tmp_path: Path, run: Run) -> None:
    project = bare(tmp_path)
    project.set_vocabulary(("panel", "leg", "misc"))
    command = of(project).next.command
    assert command == "meshforge label tables a.obj 'top=LABEL'"
    before = sum(asset.labelled for asset in of(project).assets)
    assert run(*shlex.split(command.replace("LABEL", "leg"))[1:]).code == 0
    assert sum(asset.labelled for asset in of(project).assets) == before + 1


def test_to_demonstrate_the_proposed_command_needs_but_the_steps(tmp_path: Path, run: Run) -> None:
    project = labelled(tmp_path)
    command = of(project).next.command or ""
    assert command.startswith("meshforge demonstrate tables ") and command.endswith(" 'HULLS => ACTION' ...")
    assert run(*shlex.split(command.replace("'HULLS => ACTION' ...", "'crumb => Delete'"))[1:]).code == 0
    assert of(project).next.command == "meshforge synthesize tables"


@pytest.mark.parametrize("words", ["", "top,leg,misc"])
def test_propagation_of_nothing_shows_how_to_label_the_advised_asset(words: str, tmp_path: Path, run: Run) -> None:
    project = bare(tmp_path)
    project.set_vocabulary(tuple(words.split(",")) if words else ())
    told = run("label", "tables", "--with", "propagate")
    assert told.code == 2 and "there is no label that others could be taken from" in told.err
    shown = told.err.partition("studio, or: ")[2].splitlines()[0]
    assert shown.startswith("meshforge label tables ") and ("--vocabulary a,b,c" in shown) == (not words)
    typed = shown.replace("LABEL", "leg").replace("a,b,c", "top,leg,misc")
    assert run(*shlex.split(typed)[1:]).code == 0
