"""Draws docs/pictures/spans.png: a bundled cup that one call of CoACD decomposed, as it is and rebuilt."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from pathlib import Path
from xml.etree import ElementTree

from PIL import ImageDraw
from PIL.Image import Image

from meshforge.batch import IN_PROCESS
from meshforge.common import join_and
from meshforge.formats import read
from meshforge.geometry import CoacdSettings
from meshforge.labels import HullSpan, read_reference_family
from meshforge.labels.labeler import ignore_stage
from meshforge.project import REBUILD_DEFAULTS, Project
from meshforge.rendering import color_hulls, make_contact_sheet, write_png
from meshforge.rendering.canvas import Canvas
from meshforge.rendering.picture import build_subject, draw_on_canvas, place_texts
from meshforge.rendering.placement import draw_texts
from meshforge.samples import family_of, write_family

CUP = "coarse_mug/model.urdf"
"""The cup that is decomposed anew: CoACD merges both ends of its handle with the wall, and the wall with the base."""
LABELLED = ("mug/model.urdf", "square_mug/model.urdf")
"""The cups whose hulls have labels."""
_SIZE = (560, 460)
_COARSE = CoacdSettings(threshold=0.2)


def draw_spans(path: Path) -> None:
    """Write the picture."""
    with tempfile.TemporaryDirectory() as scratch:
        project = create_project(Path(scratch))
        family = read_reference_family(project, IN_PROCESS, ignore_stage)
        assert family, "two cups are labelled"
        spans = family.find_spans(read(project.path(CUP)), project.mesh(CUP)).spans
        found = {span.hull: span for span in spans if span.chance >= REBUILD_DEFAULTS.min_confidence}
        pictures = [_draw(project, found)]
        titles = [f"as decomposed: {_count(project)}, of which {len(found)} span parts"]
        list(project.rebuild_spanning([CUP], execution=IN_PROCESS))
        pictures.append(_draw(project))
        titles.append(f"--rebuild-spanning: {_count(project)}")
        write_png(path, make_contact_sheet(pictures, columns=len(pictures), titles=titles))


def create_project(folder: Path) -> Project:
    """Two labelled cups, and one whose visual mesh is decomposed in one call of CoACD and has propagated labels."""
    family = family_of("cups")
    write_family(family, folder / "cups")
    urdf = ElementTree.parse(folder / "cups" / CUP)
    for link in urdf.iter("link"):
        for element in link.findall("collision"):
            link.remove(element)
    urdf.write(folder / "cups" / CUP)
    (folder / "cups" / CUP).with_name("model.labels.json").unlink()
    paths = [folder / "cups" / asset for asset in (CUP, *LABELLED)]
    project = Project.create(folder / "p", paths, vocabulary=family.vocabulary)
    for result in project.decompose([CUP], settings=_COARSE, execution=IN_PROCESS):
        assert result.made, result.problems
    project.label("file")
    project.label("propagate")
    return project


def _count(project: Project) -> str:
    return f"{len(project.mesh(CUP).hulls)} hulls"


def _draw(project: Project, spans: Mapping[str, HullSpan] | None = None) -> Image:
    """The cup in the colours of labels. spans: hulls that are grey instead, with what they hold written on them."""
    mesh = project.mesh(CUP).with_labels(dict.fromkeys(spans or {}, None))
    coloring = color_hulls(mesh, "label", project.vocabulary)
    canvas = Canvas(_SIZE, "light", None, None, coloring)
    items = draw_on_canvas(canvas, build_subject(mesh, coloring))
    texts = {
        mesh.index[hull]: f"#{hull.partition('#')[2]} {join_and(span.labels)}" for hull, span in (spans or {}).items()
    }
    draw_texts(ImageDraw.Draw(canvas.image), place_texts(items, texts, _SIZE), texts, coloring.colors, (0, 0))
    return canvas.image
