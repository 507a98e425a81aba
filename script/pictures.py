"""Pictures for the README and the documentation, of the bundled tables and a cup, seen upright."""

from __future__ import annotations

import sys
import tempfile
from dataclasses import replace
from pathlib import Path

from PIL import Image

from meshforge.batch import load_templates
from meshforge.cli.demo import create_tables
from meshforge.formats import load
from meshforge.language import Program, to_canonical_frame
from meshforge.project import Project
from meshforge.rendering import compare, draw_labeling_pictures, label_colors, make_contact_sheet, render, write_png
from meshforge.samples import TABLES
from meshforge.symbolic import SymbolicMesh, read_labels
from script.sign_off_picture import draw_sign_off
from script.span_picture import draw_spans

SHOWN = ("table_03", "table_08", "table_09", "table_11")
CHOICES = (
    "Attach(Is(handle), Is(drawer))",
    "Geo(Is(handle), -Z)",
    "Diff(Geo(Is(handle), -Z), Attach(Is(handle), Is(panel)))",
)
"""Three readings of a rule of docs/learning.md, on the table that it is asked about."""
BY_HAND = ("table_02", "table_09")
"""The tables that somebody labels who follows the advice."""


GOALS = {
    "carries": "supports(Geo(Is(panel), +Z))",
    "holds": "contains(Is(drawer), size = 8 cm)",
    "grip": "graspable(Attach(Is(handle), Is(drawer)), width = 20 mm)",
}
FAILING = (("carries", "table_06.obj"), ("holds", "table_13.obj"), ("grip", "table_01.obj"))


def main(folder: Path) -> None:
    """Write the pictures into a folder."""
    _tables(folder / "tables.png")
    _question(folder / "question.png")
    _draw_numbers(folder / "numbers.png")
    _labels(folder / "labels.png")
    _draw_goals(folder / "goals.png")
    draw_sign_off(folder / "signoff.png")
    draw_spans(folder / "spans.png")


def _tables(path: Path) -> None:
    program = Program.read(TABLES / "tables.mf")
    templates = load_templates(program.templates, (TABLES, TABLES / "templates"))
    pairs, titles = [], []
    for name in SHOWN:
        mesh = load(TABLES / f"{name}.obj")
        upright, pose = to_canonical_frame(mesh, program.orient)
        edited = program.run(mesh, templates).mesh
        after: SymbolicMesh = replace(edited, hulls=tuple(hull.move(pose) for hull in edited.hulls))
        pairs.append(compare(upright, after, size=(520, 400), color_by="hull"))
        titles.append((f"{len(mesh.hulls)} hulls", f"{len(after.hulls)} hulls"))
    pictures = [image for k in (0, 1) for image in (pair[k] for pair in pairs)]
    words = [text for k in (0, 1) for text in (title[k] for title in titles)]
    write_png(path, make_contact_sheet(pictures, columns=len(SHOWN), titles=words))


def _draw_goals(path: Path) -> None:
    """Goals that fail on the tables as they were decomposed, one of each way."""
    with tempfile.TemporaryDirectory() as folder:
        project = create_tables(Path(folder) / "demo")
        found = {one.asset: one for one in project.try_goals(GOALS)}
        failing = [(found[asset].after[name].why, found[asset].pictures[name]) for name, asset in FAILING]
        pictures = [Image.open(picture).convert("RGB") for _, picture in failing]
    write_png(path, make_contact_sheet(pictures, columns=len(pictures), titles=[why for why, _ in failing]))


def _question(path: Path) -> None:
    mesh, _ = to_canonical_frame(load(TABLES / "table_02.obj"), Program.read(TABLES / "tables.mf").orient)
    drawn = []
    for text in CHOICES:
        (rule,) = Program.parse(f"{text} => Delete").rules
        chosen = frozenset(mesh.hulls[k].name for k in rule.extractor.select(mesh))
        drawn.append(render(mesh, highlight=chosen, size=(520, 400), up="Z"))
    write_png(
        path, make_contact_sheet(drawn, columns=len(drawn), titles=[f"choice {k}" for k in range(1, len(drawn) + 1)])
    )


def _draw_numbers(path: Path) -> None:
    """What a model is shown of a table at first: some hulls with numbers, and beside them the table as it looks."""
    mesh = load(TABLES / "table_03.obj")
    first, *_ = draw_labeling_pictures(mesh, hulls=[*mesh.index][::3], size=760)
    write_png(path, make_contact_sheet([first.marked, first.plain], columns=2))


def _labels(path: Path) -> None:
    """The contact sheet of all tables after the labels of two were propagated."""
    with tempfile.TemporaryDirectory() as scratch:
        program = Program.read(TABLES / "tables.mf")
        project = Project.create(Path(scratch) / "p", sorted(TABLES.glob("*.obj")), vocabulary=program.labels)
        for name in BY_HAND:
            true = read_labels(TABLES / f"{name}.labels.json").labels
            project.set_labels(f"{name}.obj", {hull: label.name for hull, label in true.items()})
        project.label("propagate")
        meshes = project.meshes_by_id(project.assets())
        drawn = {
            asset: render(mesh, color_by="label", size=(320, 240), legend=False, vocabulary=project.vocabulary)
            for asset, mesh in meshes
        }
        write_png(path, make_contact_sheet([*drawn.values()], 6, [*drawn], label_colors(project.vocabulary)))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
