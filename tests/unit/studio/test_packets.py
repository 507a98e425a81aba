"""Assets in the midst of edits, against what running programs gives. Pictures that the page colours by itself."""

import json
import shutil
from dataclasses import replace
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from meshforge.batch import IN_PROCESS
from meshforge.common import DemonstrationError, MeshForgeError, ProjectError
from meshforge.language import Program
from meshforge.project import Project
from meshforge.rendering import render_thumbnail
from meshforge.store import parse_action_text
from meshforge.studio.actions import view_action
from meshforge.studio.queries import assets, packets, programs
from meshforge.studio.queries.assets import compute_upright
from meshforge.studio.wire.program import ActionCall
from meshforge.studio.wire.requests import PreviewRequest, SelectRequest
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Step
from tests.program_parts import parse_action
from tests.studio_project import demo_project
from tests.unit.studio.packets import read_packet

SHOWN, OTHER = "table_03.obj", "table_02.obj"


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory) -> Project:
    made = demo_project(tmp_path_factory.mktemp("tables"))
    made.synthesize()
    return made


@pytest.fixture
def own(project: Project, tmp_path: Path) -> Project:
    """The same project to be changed."""
    return Project.open(shutil.copytree(project.folder.parent, tmp_path / "copy") / project.folder.name)


@pytest.fixture
def program(project: Project) -> Program:
    learned = project.program()
    assert learned
    return learned


def read(text: str) -> ActionCall:
    """What the page sends of an action."""
    return view_action(*parse_action_text(text, "x"))


def ran(project: Project, program: Program, asset: str, rules: int | None = None) -> SymbolicMesh:
    part = Program(program.labels, program.orient, program.rules[:rules])
    return part.run(project.mesh(asset), project.templates(program.templates)).mesh


def check_same(packet: bytes, source: SymbolicMesh, wanted: SymbolicMesh) -> dict[str, Any]:
    """The header, where names and shapes are those of a mesh."""
    header, shapes = read_packet(packet)
    assert [hull["name"] for hull in header["hulls"]] == [hull.name for hull in wanted.hulls]
    fresh = [hull for hull in wanted.hulls if hull.name not in source.index]
    assert [row["name"] for row in header["rows"]] == [hull.name for hull in fresh]
    for hull, (vertices, _) in zip(fresh, shapes, strict=True):
        assert np.allclose(vertices.min(0), hull.aabb.min, atol=2e-4)
        assert np.allclose(vertices.max(0), hull.aabb.max, atol=2e-4)
    assert np.allclose(header["volume"][1], sum(h.volume for h in wanted.hulls))
    return header


@pytest.mark.parametrize("steps", range(6))
def test_the_first_steps_do_what_as_many_learned_rules_do(project: Project, program: Program, steps: int) -> None:
    mesh = project.mesh(SHOWN)
    wanted = ran(project, program, SHOWN, steps)
    header = check_same(packets.preview_steps(project, SHOWN, mesh, steps), mesh, wanted)
    assert header["made"] == [hull.name for hull in wanted.hulls if hull.name not in mesh.index]
    assert len(header["trace"]) == steps
    assert header["note"] is None
    assert header["findings"] == []


def test_a_preview_shows_what_the_step_then_does(own: Project) -> None:
    mesh = own.mesh(SHOWN)
    legs = ("convex_06~1", "convex_10~1")
    request = PreviewRequest(asset=SHOWN, steps=3, select=legs, action=read("Each(Replace(cylinder)) as misc"))
    header, shapes = read_packet(packets.preview_action(own, SHOWN, mesh, request))
    assert header["removed"] == list(legs)
    assert header["made"] == ["convex_06~2", "convex_10~2"]
    step = Step(4, legs, parse_action("Each(Replace(cylinder))"), "misc")
    own.demonstrate(SHOWN, [*own.steps(SHOWN)[:3], step])
    after, then = read_packet(packets.preview_steps(own, SHOWN, mesh, 4))
    assert after["hulls"] == header["hulls"]
    assert [row["name"] for row in header["rows"]] == [row["name"] for row in after["rows"]]
    assert all(np.array_equal(a, b) for (a, _), (b, _) in zip(shapes, then, strict=True))
    assert {hull["label"] for hull in header["hulls"] if hull["name"] in header["made"]} == {"misc"}


def test_a_preview_of_what_cannot_be_done_has_one_clear_message(project: Project) -> None:
    mesh = project.mesh(SHOWN)

    def refused(select: str, action: str) -> MeshForgeError:
        with pytest.raises(MeshForgeError) as caught:
            request = PreviewRequest(asset=SHOWN, steps=1, select=(select,), action=read(action))
            packets.preview_action(project, SHOWN, mesh, request)
        return caught.value

    assert isinstance(refused("convex_30", "Delete"), DemonstrationError)
    assert "is gone" in str(refused("convex_30", "Delete"))
    assert "there is no hull 'convex_0'\n  Did you mean 'convex_" in str(refused("convex_0", "Delete"))
    assert 'the template "none.obj" is not there' in str(refused("convex_00", 'Replace("none.obj")'))


def test_a_step_left_open_does_what_the_program_does(own: Project, program: Program) -> None:
    own.demonstrate(OTHER, [Step(step.rule, None, step.action, step.label) for step in own.steps(SHOWN)[:3]])
    mesh = own.mesh(OTHER)
    check_same(packets.preview_steps(own, OTHER, mesh, 3), mesh, ran(own, program, OTHER, 3))


@pytest.mark.parametrize("text", ["Is(leg)", "Geo(Is(panel), +Z)", "Diff(All, Attach(Is(leg), Is(panel)))"])
def test_an_extractor_selects_on_the_turned_asset(project: Project, program: Program, text: str) -> None:
    mesh = project.mesh(OTHER)
    found = programs.select_hulls(project, OTHER, mesh, SelectRequest(asset=OTHER, extractor=text))
    (rule,) = Program.parse(f"{text} => Delete").rules
    (line,) = Program(orient=program.orient, rules=(rule,)).run(mesh).trace
    assert found.select == line.selected
    assert found.sentence
    assert found.mark is None


def test_an_extractor_selects_what_a_rule_of_the_program_meets(project: Project, program: Program) -> None:
    request = SelectRequest(asset=OTHER, rule=4, extractor="Is(leg)")
    found = programs.select_hulls(project, OTHER, project.mesh(OTHER), request, program)
    met = ran(project, program, OTHER, 3)
    assert found.select == tuple(hull.name for hull in met.hulls if hull.label == "leg")
    assert "~" in "".join(found.select), "the rule before merged the legs"


@pytest.mark.parametrize(
    ("text", "line", "column", "message"),
    [
        ("Is(leg", 1, 7, "expected `)`"),
        ("\n  Uniom(All, All)", 2, 3, "Uniom"),
        ("\n Attach(Is(leg), Is(leggs))", 2, 21, "Did you mean 'leg'?"),
    ],
)
def test_what_is_wrong_with_an_extractor_is_marked(
    project: Project, text: str, line: int, column: int, message: str
) -> None:
    found = programs.select_hulls(project, OTHER, project.mesh(OTHER), SelectRequest(asset=OTHER, extractor=text))
    assert found.mark
    assert (found.mark.line, found.mark.column) == (line, column)
    assert message in found.mark.message
    assert found.select == ()


def test_guesses_on_a_demonstrated_asset_are_what_was_shown(project: Project, program: Program) -> None:
    guessed = programs.guess_selections(project, SHOWN, project.mesh(SHOWN), program)
    shown = project.steps(SHOWN)
    assert [set(guess.select) for guess in guessed] == [set(step.select or ()) for step in shown]
    assert [guess.action.text for guess in guessed] == [str(step.action) for step in shown]
    assert all(guess.error is None for guess in guessed)


def test_a_guess_meets_what_was_shown_before_it(project: Project, own: Project, program: Program) -> None:
    own.demonstrate(OTHER, [Step(1, {"convex_09"}, parse_action("Delete"))])
    met, bare = (programs.guess_selections(one, OTHER, one.mesh(OTHER), program)[2] for one in (own, project))
    assert "convex_09" not in met.select and "convex_09" in bare.select


def test_the_result_is_what_the_program_makes_of_it(project: Project, program: Program) -> None:
    mesh = project.mesh(OTHER)
    packet = packets.preview_result(project, OTHER, mesh, "program", program)
    header = check_same(packet, mesh, ran(project, program, OTHER))
    assert header["removed"]
    assert [line["rule"] for line in header["trace"]] == [1, 2, 3, 4, 5]
    nothing, _ = read_packet(packets.preview_result(project, OTHER, mesh, "program", None))
    assert (nothing["made"], nothing["removed"]) == ([], [])


def test_a_written_hull_of_another_shape_is_changed_and_one_that_was_rounded_is_not(project: Project) -> None:
    mesh = project.mesh(OTHER)
    rounded, larger, *rest = mesh.hulls
    grown, turned = np.eye(3) * 1.2, np.eye(3) * (1 + 1e-7)
    hulls = [
        replace(hull, shape=hull.shape.transform(by, np.zeros(3))) for hull, by in ((rounded, turned), (larger, grown))
    ]
    header, _ = read_packet(packets.pack_edited(mesh, mesh, mesh.with_hulls([*hulls, *rest])))
    assert (header["made"], header["removed"], header["changed"]) == ([], [], [larger.name])


def test_an_edit_by_hand_is_previewed_as_it_is_then_replayed(own: Project, program: Program) -> None:
    mesh = own.mesh(OTHER)
    panel = ran(own, program, OTHER).hulls[-1].name
    request = PreviewRequest(asset=OTHER, select=(panel,), action=read("Scale(all, 0.5)"), result=True)
    header, shapes = read_packet(packets.preview_action(own, OTHER, mesh, request))
    assert header["removed"] == [panel]
    assert len(header["made"]) == 1
    own.correct(OTHER, [panel], parse_action("Scale(all, 0.5)"))
    after, then = read_packet(packets.preview_result(own, OTHER, mesh, "program", program))
    assert after["hulls"] == header["hulls"]
    assert all(np.array_equal(a, b) for (a, _), (b, _) in zip(shapes, then, strict=True))
    with pytest.raises(ProjectError, match="after the program there is no hull 'nobody'"):
        wrong = PreviewRequest(asset=OTHER, select=("nobody",), action=read("Delete"), result=True)
        packets.preview_action(own, OTHER, mesh, wrong)


@pytest.mark.slow
def test_the_output_is_what_was_written(own: Project, program: Program) -> None:
    mesh = own.mesh(OTHER)
    with pytest.raises(ProjectError, match="it has no output yet"):
        packets.preview_result(own, OTHER, mesh, "output", None)
    list(own.apply([OTHER], execution=IN_PROCESS))
    header, _ = read_packet(packets.preview_result(own, OTHER, mesh, "output", None))
    now, _ = read_packet(packets.preview_result(own, OTHER, mesh, "program", program))
    assert {hull["name"] for hull in header["hulls"]} == {hull["name"] for hull in now["hulls"]}
    assert {row["name"] for row in header["rows"]} == {row["name"] for row in now["rows"]}
    assert header["trace"] == now["trace"]
    assert header["volume"] == pytest.approx(now["volume"], rel=1e-5)


TABLE = "table_02.obj"


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
