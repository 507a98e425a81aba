"""`meshforge label` from names and files: shown before it is taken, with patterns, and each misuse told once."""

import json
from pathlib import Path

import numpy as np
import pytest

from meshforge.project import Project
from tests.unit.batch.families import tree
from tests.unit.cli.in_process import Run
from tests.unit.labels.partnet import write_partnet

VOCABULARY = ("drawer", "door", "handle", "frame")
CLASSES = {
    "link_0/geom0": "drawer",
    "link_0/geom1": "handle-7",
    "link_1/geom0": "rotation_door",
    "link_1/geom1": "rotation_door",
    "link_2/geom0": "frame_side-1",
    "link_2/geom1": "furniture_body",
}


@pytest.fixture
def run(run: Run, tmp_path: Path) -> Run:
    """Runs the command line beside a project `p` of two cabinets as PartNet has them."""
    for name in ("7119", "7120"):
        write_partnet(tmp_path / "assets" / name)
    project = Project.create(tmp_path / "p", [tmp_path / "assets"], vocabulary=VOCABULARY)
    for asset in project.assets():
        hulls = project.mesh(asset).hulls
        points, names = np.concatenate([hull.vertices for hull in hulls]), sorted({*CLASSES.values()})
        kinds = np.repeat([names.index(CLASSES[hull.name]) for hull in hulls], [len(hull.vertices) for hull in hulls])
        np.savez(project.path(asset).with_suffix(".points.npz"), points=points, labels=kinds, names=names)
    return run


def told(text: str) -> str:
    """A printed text without the blanks at the ends of its lines."""
    return "\n".join(line.rstrip() for line in text.splitlines())


NAMES = """\
label    from                names            hulls   assets   confidence
─────────────────────────────────────────────────────────────────────────
drawer   visual              drawer_front-5       2        2   0.70
handle   visual              handle-7             2        2   0.70
handle   visual by synonym   knob-3               2        2   0.50
frame    visual              frame_side-1         2        2   0.70
(none)   nothing said        geom0, geom1         4        2
8 labels would be taken; 4 hulls left without one. Nothing was written."""
PATTERNS = """\
label    from                names                    hulls   assets   confidence
─────────────────────────────────────────────────────────────────────────────────
drawer   visual              drawer_front-5               2        2   0.70
handle   visual              handle-7                     2        2   0.70
handle   visual by pattern   knob-3                       2        2   0.90
frame    visual by pattern   bottom-2, frame_side-1       4        2   0.90
(none)   mesh by pattern     original-10                  2        2
10 labels would be taken; 2 hulls left without one. Nothing was written."""
FILES = """\
label    from           names           hulls   assets   confidence
─────────────────────────────────────────────────────────────────────
drawer   points         drawer              2        2   0.57
door     points         rotation_door       4        2   0.56
handle   points         handle-7            2        2   0.56
frame    points         frame_side-1        2        2   0.31, unsure
(none)   nothing said   link_2/geom1        2        2
10 labels would be taken; 2 hulls left without one. Nothing was written.
    left out: 7119/mobility.urdf: 1 hull left out: 'furniture_body' is not in the vocabulary, and no pattern says what it means
    left out: 7120/mobility.urdf: 1 hull left out: 'furniture_body' is not in the vocabulary, and no pattern says what it means"""  # noqa: E501


@pytest.mark.slow
def test_names_are_shown_before_they_are_taken(run: Run, tmp_path: Path) -> None:
    before = tree(tmp_path / "p")
    shown = run("label", "p", "--with", "names", "--dry-run")
    assert (shown.code, told(shown.out), shown.err) == (0, NAMES, "")
    more = ("--pattern", "*knob*=handle", "--pattern", "/^(frame|bottom)/=frame", "--pattern", "*-10=")
    assert told(run("label", "p", "--with", "names", "--dry-run", *more).out) == PATTERNS
    assert {name: data for name, data in tree(tmp_path / "p").items() if "survey" not in name} == before
    done = run("label", "p", "--with", "names", *more)
    assert "7119/mobility.urdf: 5 labels taken, 1 hull without a label\n" in done.out


@pytest.mark.slow
def test_files_are_shown_before_they_are_taken(run: Run, tmp_path: Path) -> None:
    before = tree(tmp_path / "p")
    assert told(run("label", "p", "--with", "file", "--dry-run").out) == FILES
    assert {name: data for name, data in tree(tmp_path / "p").items() if "survey" not in name} == before
    done = run("label", "p", "--pattern", "furniture_body=frame")
    assert done.code == 0 and "7120/mobility.urdf: 6 labels taken, 1 unsure\n" in done.out
    again = run("label", "p", "--pattern", "furniture_body=frame", "--dry-run")
    assert (
        again.out
        == "0 labels would be taken; 0 hulls left without one; 12 hulls would stay as they are. Nothing was written.\n"
    )


@pytest.mark.slow
def test_json_says_the_same(run: Run) -> None:
    shown = json.loads(run("label", "p", "--with", "names", "--dry-run", "--json").out)
    assert shown["take"][0] == {
        "label": "drawer",
        "kind": "visual",
        "names": ["drawer_front-5"],
        "hulls": 2,
        "assets": 2,
        "low": 0.7,
        "high": 0.7,
        "unsure": False,
    }
    assert [row["hulls"] for row in shown["leave"]] == [4]
    assert shown["keep"] == 0 and shown["problems"] == []
    files = json.loads(run("label", "p", "--with", "file", "--dry-run", "--json").out)
    assert len(files["problems"]) == 2 and {row["kind"] for row in files["take"]} == {"points"}


def test_another_vocabulary_is_tried_without_being_set(run: Run, tmp_path: Path) -> None:
    shown = run("label", "p", "--with", "names", "--dry-run", "--vocabulary", "bottom,knob").out
    assert "bottom" in shown and "knob" in shown and "drawer_front" not in shown
    assert Project.open(tmp_path / "p").vocabulary == VOCABULARY


@pytest.mark.slow
def test_segmented_points_are_read_with_the_names_that_are_given(run: Run, tmp_path: Path) -> None:
    mesh = Project.open(tmp_path / "p").mesh("7119/mobility.urdf")
    points = np.concatenate([hull.vertices for hull in mesh.hulls])
    kinds = np.repeat(np.arange(6) % 4, [len(hull.vertices) for hull in mesh.hulls])
    (tmp_path / "out/7119").mkdir(parents=True)
    np.savez(tmp_path / "out/7119/mobility.npz", points=points * 2, labels=kinds)
    refused = run("label", "p", "--with", "file", "--labels", "out", "--dry-run")
    assert "nothing names them" in refused.out
    refused = run("label", "p", "--with", "file", "--labels", "out", "--classes", "vocabulary")
    assert refused.code == 1 and "They would fit with --align box." in refused.out
    done = run("label", "p", "--with", "file", "--labels", "out", "--classes", "vocabulary", "--align", "box")
    assert done.code == 0 and "7119/mobility.urdf: 6 labels taken\n" in done.out
    assert "1 asset without a labels file" in done.out


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--with", "names", "--classes", "a"), "--classes is for --with file"),
        (("--with", "propagate", "--align", "box"), "--align is for --with file"),
        (("--with", "names", "--align", "box"), "--align is for --with file"),
        (("--with", "propagate", "--pattern", "a=b"), "--pattern is for --with names and --with file"),
        (("--with", "names", "--pattern", "knob"), "--pattern knob: it needs a pattern and a label"),
        (("--with", "names", "--pattern", "=knob"), "--pattern =knob: it needs a pattern and a label"),
        (("--with", "names", "--pattern", "*=knob"), "the pattern * means 'knob', which is not in the vocabulary"),
        (("--pattern", "/(/=door"), "the pattern /(/ is no regular expression"),
        (("--labels", "p/meshforge.toml"), "this is no kind of file that labels are read from"),
    ],
)
def test_misuse_is_told_in_one_message(run: Run, tmp_path: Path, words: tuple[str, ...], message: str) -> None:
    before = tree(tmp_path / "p")
    done = run("label", "p", *words)
    assert done.code == 2 and not done.out
    assert done.err.count(message) == 1
    assert tree(tmp_path / "p") == before
