"""What is said of how an asset was read, in the outcome of its edit: as far as it is still true of what was written."""

from pathlib import Path

import pytest

from meshforge.batch import apply, expand, make_jobs
from meshforge.language import Program
from tests.unit.cli.in_process import Run
from tests.urdf_sample import boxes_obj, corner_obj

CUT = '<mesh optimization="convex_decomposition"><uri>{}.obj</uri></mesh>'
MODEL = '<sdf version="1.11"><model name="m"><link name="l">{}</link></model></sdf>'
ANSWERS = "{} to be decomposed by Gazebo when loaded, shown as authored"


def write_model(folder: Path, *meshes: str) -> Path:
    """A model whose meshes Gazebo is to decompose."""
    folder.mkdir()
    (folder / "corner.obj").write_text(corner_obj())
    (folder / "far.obj").write_text(boxes_obj(((9, 9, 9), (10, 10, 10))))
    rows = (f'<collision name="{m}"><geometry>{CUT.format(m)}</geometry></collision>' for m in meshes)
    path = folder / "m.sdf"
    path.write_text(MODEL.format("".join(rows)))
    return path


@pytest.mark.parametrize(
    ("meshes", "before", "after"),
    [(["corner"], "1 mesh", None), (["corner", "far"], "2 meshes", "1 mesh")],
    ids=["the only one", "one of two"],
)
def test_a_note_that_the_edit_settles_is_left_out(run: Run, meshes: list[str], before: str, after: str | None) -> None:
    write_model(Path("in"), *meshes)
    assert ANSWERS.format(before) in run("info", "in/m.sdf").out
    assert run("new", "p", "in/m.sdf", "--decompose", "hull", "--workers", "1").code == 0
    Path("p/program.mf").write_text("labels x\n")
    told = run("apply", "p").out
    assert "optimization" not in Path("p/edited/m.sdf").read_text().partition("far")[0]
    assert [line.strip() for line in told.splitlines() if "Gazebo" in line] == (
        [f"note: {ANSWERS.format(after)}"] if after else []
    )


def test_convert_says_of_its_own_format_what_is_true_of_the_output(run: Run) -> None:
    write_model(Path("in"), "corner")
    assert "Gazebo" not in run("convert", "in/m.sdf", "a/m.sdf", "--concave", "hull").err
    assert ANSWERS.format("1 mesh") in run("convert", "in/m.sdf", "b/m.sdf").err


def test_what_is_true_still_is_said_and_no_folder_of_drafts(tmp_path: Path) -> None:
    write_model(tmp_path / "in", "corner")
    (outcome,) = apply(Program(), make_jobs(expand([str(tmp_path / "in")])), tmp_path / "out")
    assert not hasattr(outcome, "error")
    assert ANSWERS.format("1 mesh") in outcome.notes and "drafts" not in " ".join(outcome.notes)


@pytest.mark.parametrize("words", [("out.xml",), ("out", "--to", "xml")], ids=["one", "many"])
def test_of_another_format_is_said_what_its_own_file_is(run: Run, words: tuple[str, ...]) -> None:
    write_model(Path("in"), "corner")
    told = run("convert", "in/m.sdf", *words)
    said = told.out + told.err
    assert told.code == 0 and "Gazebo" not in said
    assert said.count("71%") == 1, "what MuJoCo makes of it is said once"
