"""What `check --engine` would refuse is never written without a note: each action, each format with engines."""

from __future__ import annotations

from pathlib import Path

import pytest

from meshforge.batch import IN_PROCESS, AssetJob, Failed, apply, load_templates
from meshforge.checks import check
from meshforge.engines import ENGINES
from meshforge.formats import list_formats, load, save
from meshforge.geometry import Aabb, Box
from meshforge.language import Program
from meshforge.symbolic import Hull, Label, SymbolicMesh, write_labels
from tests.soups import ball
from tests.unit.cli.in_process import Run

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
