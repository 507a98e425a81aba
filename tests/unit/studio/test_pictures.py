"""Pictures that the page colours by itself."""

from __future__ import annotations

import json
from io import BytesIO

import numpy as np
import pytest
from PIL import Image

from meshforge.project import Project
from meshforge.rendering import render_thumbnail
from meshforge.studio.queries import assets
from meshforge.studio.queries.assets import compute_upright
from tests.studio_project import demo_project

TABLE = "table_02.obj"


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory) -> Project:
    made = demo_project(tmp_path_factory.mktemp("tables"))
    made.synthesize()
    return made


def of_png(data: bytes) -> np.ndarray[tuple[int, ...], np.dtype[np.uint8]]:
    image = Image.open(BytesIO(data))
    assert image.mode == "RGBA"
    return np.asarray(image)


def test_a_thumbnail_keeps_its_numbers_as_a_png(project: Project) -> None:
    mesh = project.mesh(TABLE)
    pose, _ = compute_upright(project, mesh)
    assert np.array_equal(of_png(assets.draw_thumbnail(mesh, pose)), render_thumbnail(mesh, pose))


@pytest.mark.parametrize("rule", [1, 4])
def test_a_picture_for_a_question_shows_the_asset_as_the_rule_meets_it(project: Project, rule: int) -> None:
    mesh, program = project.mesh(TABLE), project.program()
    assert program
    packet = assets.draw_rule_picture(project, TABLE, mesh, rule, program)
    length = int.from_bytes(packet[:4], "little")
    seen = project.mesh_before_rule(TABLE, rule, program)
    names = json.loads(packet[4 : 4 + length])["names"]
    assert names == [hull.name for hull in seen.hulls]
    pixels = of_png(packet[4 + length :])
    assert pixels.shape == (540, 720, 4)
    assert pixels[..., 1].max() <= len(names)
    assert np.array_equal(pixels, render_thumbnail(seen, size=(720, 540)))


def test_a_picture_for_a_question_shows_the_hulls_that_tell_its_choices_apart(project: Project) -> None:
    mesh, program = project.mesh(TABLE), project.program()
    seen = project.mesh_before_rule(TABLE, 2, program) if program else mesh
    usual = render_thumbnail(seen)
    hidden = [name for name, place in seen.index.items() if (usual[..., 1] == 1 + place).sum() < 8]
    assert hidden
    for name in hidden[:3]:
        packet = assets.draw_rule_picture(project, TABLE, mesh, 2, program, [name])
        pixels = of_png(packet[4 + int.from_bytes(packet[:4], "little") :])
        assert (pixels[..., 1] == 1 + seen.index[name]).sum() > 60, name
