"""What `check --engine` would refuse is never written without a note: each action, each format with engines. What is
said of how an asset was read, in the outcome of its edit: as far as it is still true of what was written."""

from __future__ import annotations

from pathlib import Path

import pytest

from meshforge.batch import IN_PROCESS, AssetJob, Failed, apply, expand, load_templates, make_jobs
from meshforge.checks import check
from meshforge.engines import ENGINES
from meshforge.formats import list_formats, load, save
from meshforge.geometry import Aabb, Box
from meshforge.language import Program
from meshforge.symbolic import Hull, Label, SymbolicMesh, write_labels
from tests.soups import ball
from tests.unit.cli.in_process import Run
from tests.urdf_sample import boxes_obj, corner_obj

SUFFIXES = {"mjcf": ".xml", "urdf": ".urdf", "sdf": ".sdf", "usd": ".usda"}
ENGINES_OF = {known.name: known.engines for known in list_formats() if known.name in SUFFIXES}
ACTIONS = (
    *("Merge", "Replace(cylinder)", "Replace(cylinder, native)", "Replace(capsule, native)"),
    *("Replace(sphere, native)", "Scale(all, 0.00001)", 'Each(Replace("ball.obj"))', 'Add(+Z, "ball.obj")'),
)
BALL = SymbolicMesh((Hull("ball", "body", ball(300)),))


def table() -> SymbolicMesh:
    top = Box.of_bounds(Aabb([0, 0, 1], [2, 1, 1.1])).tessellate()
    leg = Box.of_bounds(Aabb([0, 0, 0], [0.1, 0.2, 1])).tessellate()
    return SymbolicMesh((Hull("top", "body", top, Label("top")), Hull("leg", "body", leg, Label("leg"))))


@pytest.mark.slow
@pytest.mark.parametrize("form", SUFFIXES)
@pytest.mark.parametrize("action", ACTIONS)
def test_each_hull_that_an_engine_of_the_format_refuses_or_lacks_is_in_a_note(
    form: str, action: str, tmp_path: Path
) -> None:
    saved = save(table(), tmp_path / f"in/table{SUFFIXES[form]}")
    labels = tmp_path / "labels.json"
    mesh = load(saved.path)
    names = {hull.name: hull.name.split("/")[-1] for hull in mesh.hulls}
    write_labels(
        labels, mesh.with_hulls(Hull(h.name, h.body, h.shape, Label(names[h.name])) for h in mesh.hulls), ("top", "leg")
    )
    save(BALL, tmp_path / "ball.obj")
    program = Program.parse(f"labels top, leg\nIs(leg) => {action}\n")
    (outcome,) = apply(
        program,
        [AssetJob(saved.path.name, saved.path, saved.path.parent, labels)],
        tmp_path / "out",
        templates=load_templates(program.templates, [tmp_path]),
        execution=IN_PROCESS,
    )
    assert not isinstance(outcome, Failed), outcome.error
    written = load(outcome.out)
    for engine in ENGINES_OF[form]:
        title = ENGINES[engine].title
        notes = [note for note in outcome.notes if title in note.partition(":")[0]]
        for finding in check(written, engine):
            if finding.severity == "error" or finding.rule.endswith("-primitives"):
                about = [note for note in notes if all(name in note for name in finding.hulls)]
                assert about, (finding, outcome.notes)
                assert finding.remedy.split(" that ")[0] in about[0]


def test_a_conversion_notes_what_the_engine_of_its_format_refuses(run: Run) -> None:
    save(BALL, "ball.obj")
    said = "PhysX on the CPU: ball (300): more than 255 vertices; PhysX makes a coarser hull of it. Reduce it"
    assert f"note: {said}" in run("convert", "ball.obj", "ball.usda").err
    assert any(note.startswith(said) for note in run("convert", "ball.obj", "b.usda", "--json").json["notes"])
    godot = run("convert", "ball.obj", "ball.glb", "--names", "godot").err
    said = "Godot with Jolt: ball-convcolonly (300): more than 256 vertices; Jolt leaves part of the hull out"
    assert f"note: {said}" in godot
    unity = run("convert", "ball.obj", "u.glb", "--names", "unity").err
    assert unity.count("more than 255 vertices") == 1
    assert "more than" not in run("convert", "ball.obj", "ball.ply").err


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
def test_a_note_that_the_edit_has_dealt_with_is_not_repeated(
    run: Run, meshes: list[str], before: str, after: str | None
) -> None:
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
