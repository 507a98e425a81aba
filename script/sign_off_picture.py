"""Draws docs/pictures/signoff.png: the bundled tables after one demonstration, and once all that was asked is answered.

Who answers knows what the bundled program selects.
"""

from __future__ import annotations

import shutil
import tempfile
from dataclasses import replace
from pathlib import Path

from PIL.Image import Image

from meshforge.batch import IN_PROCESS, load_templates
from meshforge.language import Program, Template, select, to_canonical_frame
from meshforge.project import Project, ProjectReview, run_with_manual_edits
from meshforge.rendering import make_contact_sheet, render, write_png
from meshforge.samples import TABLES
from meshforge.signoff import ReviewQuestion, ReviewReply
from meshforge.signoff.question import RIGHT
from meshforge.synthesis import Step

SHOWN_FIRST = "table_08.obj"
"""The table on which the edit is demonstrated: it has no shelf."""
_COLUMNS, _SIZE = 7, (330, 270)
_MOST_QUESTIONS = 30


def draw_sign_off(path: Path) -> None:
    """Write the picture."""
    with tempfile.TemporaryDirectory() as scratch:
        family = _Family(Path(scratch))
        family.demonstrate(SHOWN_FIRST)
        found = family.review()
        names = [*found.assessment.need_review][:_COLUMNS]
        rows = [family.draw(name) for name in names]
        titles = [f"{Path(name).stem}: {found.assessment.assets[name].probability:.0%} sure" for name in names]
        for _ in range(_MOST_QUESTIONS):
            if not (question := found.assessment.question):
                break
            family.answer(question)
            found = family.review()
        rows += [family.draw(name) for name in names]
        signed = set(found.assessment.signed_off)
        titles += [f"{Path(name).stem}: {'signed off' if name in signed else 'set aside'}" for name in names]
        write_png(path, make_contact_sheet(rows, columns=_COLUMNS, titles=titles))


class _Family:
    """The bundled tables in a project, and the program that is meant."""

    def __init__(self, folder: Path) -> None:
        self.meant = Program.read(TABLES / "tables.mf")
        self.templates: dict[str, Template] = dict(load_templates(self.meant.templates, (TABLES, TABLES / "templates")))
        words, orient = self.meant.labels, self.meant.orient
        self.project = Project.create(folder / "p", sorted(TABLES.glob("*.obj")), vocabulary=words, orient=orient)
        shutil.copytree(TABLES / "templates", self.project.folder / "templates")
        self.project.label("file")

    def demonstrate(self, asset: str) -> None:
        trace = self.meant.run(self.project.mesh(asset), self.templates).trace
        rows = enumerate(zip(trace, self.meant.rules, strict=True), 1)
        steps = [Step(number, done.selected, rule.action, rule.label) for number, (done, rule) in rows]
        self.project.demonstrate(asset, steps)

    def review(self) -> ProjectReview:
        self.project.synthesize()
        list(self.project.apply(execution=IN_PROCESS))
        return self.project.review()

    def answer(self, question: ReviewQuestion) -> None:
        """ReviewReply as who knows what is meant; a result that is wrong is demonstrated instead."""
        asset, program = question.asset, self.project.program()
        assert program
        if question.kind == "demonstrate":
            self.demonstrate(asset)
        elif question.rule is not None and all(choice.select is not None for choice in question.choices):
            mesh = self.project.mesh_before_rule(asset, question.rule, program)
            places = select(self.meant.rules[question.rule - 1].extractor, mesh)
            wanted = {mesh.hulls[place].name for place in places}
            right = [choice.id for choice in question.choices if set(choice.select or ()) == wanted]
            self.project.reply(question, ReviewReply(question.id, right[0] if right else None))
        elif question.kind == "result":
            mesh = self.project.mesh(asset)
            done, wanted_trace = program.run(mesh, self.templates).trace, self.meant.run(mesh, self.templates).trace
            is_right = [set(one.selected) for one in done] == [set(one.selected) for one in wanted_trace]
            if is_right:
                self.project.reply(question, ReviewReply(question.id, RIGHT))
            else:
                self.demonstrate(asset)
        else:
            self.project.reply(question, ReviewReply(question.id, question.choices[0].id))

    def draw(self, asset: str) -> Image:
        """The table as it is edited now, upright."""
        program, mesh = self.project.program(), self.project.mesh(asset)
        edited = run_with_manual_edits(self.project, asset, mesh, program).mesh
        _, pose = to_canonical_frame(mesh, self.meant.orient)
        upright = replace(edited, hulls=tuple(hull.move(pose) for hull in edited.hulls))
        return render(upright, size=_SIZE, up="Z", legend=False, color_by="hull")
