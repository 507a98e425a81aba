"""Assets and their triangles, as the page gets them."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from meshforge.batch import IN_PROCESS
from meshforge.geometry import Cylinder, Pose, Shape, Sphere, convex_hull
from meshforge.language import to_canonical_frame
from meshforge.project import Project
from meshforge.rendering import render
from meshforge.store import History
from meshforge.studio.edits.assets import SetUp
from meshforge.studio.edits.base import make_edit
from meshforge.studio.queries.assets import build_asset_view, compute_upright, draw_thumbnail, find_unclear_up
from meshforge.studio.queries.packets import hull_views, pack_asset, pack_visual
from meshforge.symbolic import Asset, Body, Document, Geom, NonConvexPiece, Surface, SymbolicMesh
from meshforge.synthesis import Step
from tests.program_parts import parse_action
from tests.studio_project import demo_project
from tests.unit.batch.families import tree
from tests.unit.project.tables import FIRST, applied, demonstrated
from tests.unit.studio.packets import read_packet

TABLE = "table_03.obj"


def of_shapes(
    *shapes: Shape, opaque: tuple[NonConvexPiece, ...] = (), visuals: tuple[Surface, ...] = ()
) -> SymbolicMesh:
    geoms = tuple(Geom(f"part{k}", "base", shape) for k, shape in enumerate(shapes))
    bodies = (Body("base", Pose.identity()),)
    return SymbolicMesh.of(
        Asset(Path("part.urdf"), "urdf", bodies, geoms, Document(), non_convex=opaque, visuals=visuals)
    )


def triangle(color: tuple[float, float, float, float] | None = None) -> Surface:
    return Surface(np.eye(3) + 0.1, np.array([[0, 1, 2]]), "base", color)


def test_a_packet_holds_every_hull_in_its_order(project: Project) -> None:
    mesh = project.mesh(TABLE)
    header, shapes = read_packet(pack_asset(mesh))
    assert [row["name"] for row in header["rows"]] == [hull.name for hull in mesh.hulls]
    for hull, (vertices, faces) in zip(mesh.hulls, shapes, strict=True):
        assert np.allclose(vertices, hull.vertices, atol=1e-6)
        assert np.array_equal(faces, hull.faces)


def test_round_primitives_come_as_round_as_they_look() -> None:
    mesh = of_shapes(Sphere(Pose.identity(), 0.5), Cylinder(Pose.identity(), 0.5, 1.0))
    _, ((sphere, _), (cylinder, _)) = read_packet(pack_asset(mesh))
    assert len(sphere) > 5 * len(mesh.hulls[0].vertices)
    assert np.allclose(np.linalg.norm(sphere, axis=1), 0.5, atol=1e-6)
    assert np.allclose(cylinder.max(axis=0), (0.5, 0.5, 1.0), atol=1e-6)


def test_opaque_pieces_with_a_surface_follow_the_hulls() -> None:
    opaque = (NonConvexPiece("floor", "base", "endless"), NonConvexPiece("shell", "base", "it is open", triangle()))
    header, shapes = read_packet(pack_asset(of_shapes(Sphere(Pose.identity(), 1.0), opaque=opaque)))
    assert [row["name"] for row in header["rows"]] == ["part0", "shell"]
    assert np.allclose(shapes[1][0], np.eye(3) + 0.1)


def test_visuals_are_packed_and_none_is_an_empty_packet() -> None:
    _, shapes = read_packet(pack_visual(of_shapes(visuals=(triangle(), triangle()))))
    assert len(shapes) == 2
    assert read_packet(pack_visual(of_shapes())) == ({"rows": []}, [])


def test_a_hull_is_told_with_its_kind_and_measure() -> None:
    box = convex_hull(np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 2)], float))
    ball, part = hull_views(of_shapes(Sphere(Pose.identity(), 1.0), box))
    assert (ball.primitive, part.primitive) == ("sphere", None)
    assert part.volume == pytest.approx(2.0)
    assert (part.vertices, part.faces) == (8, 12)


def test_contacts_are_those_that_a_program_sees(project: Project) -> None:
    mesh = project.mesh(TABLE)
    seen, _ = to_canonical_frame(mesh, project.orientation)
    view = build_asset_view(project, TABLE, mesh)
    assert set(view.contacts) == {(seen.hulls[i].name, seen.hulls[j].name) for i, j in seen.contacts}
    assert all(seen.contact_distance < miss.gap <= 3 * seen.contact_distance for miss in view.near_misses)


def test_steps_tell_what_they_make_and_remove(project: Project) -> None:
    steps = build_asset_view(project, TABLE, project.mesh(TABLE)).steps
    assert [step.error for step in steps] == [None] * 5
    assert (steps[0].made, steps[0].removed) == ((), steps[0].select)
    assert steps[2].action.text == "Each(Merge)"
    assert len(steps[2].made) == 4


def test_a_step_that_cannot_be_done_says_why_and_the_next_ones_go_on(tmp_path: Path) -> None:
    project = demo_project(tmp_path, demonstrated=False)
    mesh = project.mesh(TABLE)
    names = [hull.name for hull in mesh.hulls]
    delete = parse_action("Delete")
    project.demonstrate(TABLE, [Step(1, {names[0]}, delete), Step(2, {names[0]}, delete), Step(3, {names[1]}, delete)])
    steps = build_asset_view(project, TABLE, mesh).steps
    assert steps[1].error
    assert "is gone: an earlier rule removed" in steps[1].error
    assert [step.removed for step in steps] == [(names[0],), (), (names[1],)]


def test_an_asset_that_the_orientation_cannot_turn_says_so_at_every_step(project: Project) -> None:
    mesh = project.mesh(TABLE)
    bare = mesh.with_labels(dict.fromkeys(mesh.index))
    view = build_asset_view(project, TABLE, bare)
    assert view.unturned is not None
    assert "the landmark Is(leg) selects nothing. Label the hulls that it should select" in view.unturned
    assert "\n" not in view.unturned
    assert view.upright is None
    assert {step.error for step in view.steps} == {view.unturned}
    assert [hull.name for hull in bare.hulls] == [hull.name for hull in view.hulls]


def test_upright_brings_the_legs_below_the_panel(project: Project) -> None:
    mesh = project.mesh(TABLE)
    shown = build_asset_view(project, TABLE, mesh).upright
    assert shown
    turn = np.array(shown).reshape(4, 4)[:3, :3]
    height = {k: np.mean([turn @ h.shape.centroid for h in mesh.hulls if h.label == k], 0) for k in ("leg", "panel")}
    assert height["leg"][2] < height["panel"][2]


def test_a_file_whose_y_points_up_is_shown_with_z_up(project: Project, tmp_path: Path) -> None:
    plain = demo_project(tmp_path, orient="")
    mesh = plain.mesh(TABLE)
    assert mesh.asset
    assert compute_upright(plain, mesh)[0].rotation.tolist() == np.eye(3).tolist()
    assert build_asset_view(plain, TABLE, mesh).upright is None
    standing = replace(mesh, asset=replace(mesh.asset, up="y"))
    assert compute_upright(plain, standing)[0].apply(np.array([[0.0, 1.0, 0.0]])).tolist() == [[0.0, 0.0, 1.0]]
    turned = compute_upright(project, standing)[0].rotation
    assert np.array_equal(turned, compute_upright(project, mesh)[0].rotation)
    assert np.array_equal(turned, compute_upright(plain, standing, project.orientation)[0].rotation)


def test_what_a_project_says_is_up_is_for_pictures_alone(tmp_path: Path) -> None:
    standing, lying = applied(tmp_path / "standing"), demonstrated(tmp_path / "lying")
    before = {name: data for name, data in tree(lying.folder).items() if name != "meshforge.toml"}
    lying.set_up("Y")
    lying.synthesize()
    list(lying.apply(execution=IN_PROCESS))
    assert lying.program() == standing.program()
    assert tree(lying.layout.edited) == tree(standing.layout.edited)
    assert {name: tree(lying.folder)[name] for name in before} == before

    for asset in lying.assets():
        lie_down(lying.path(asset))
    picture, other = (
        draw_thumbnail(one.mesh(FIRST), compute_upright(one, one.mesh(FIRST))[0]) for one in (standing, lying)
    )
    assert picture == other
    assert np.mean(np.asarray(render(lying.mesh(FIRST))) != np.asarray(render(standing.mesh(FIRST)))) < 0.01
    assert build_asset_view(lying, FIRST, lying.mesh(FIRST)).y_up
    lying.set_up("Z")
    assert compute_upright(lying, lying.mesh(FIRST))[0].rotation.tolist() == np.eye(3).tolist()


def lie_down(path: Path) -> None:
    """Turn an OBJ file so that Y points up."""
    turned = re.sub(r"^v (\S+) (\S+) (\S+)", lambda v: f"v {v[1]} {v[3]} {-float(v[2])}", path.read_text(), flags=re.M)
    path.write_text(turned)


def test_what_is_up_is_asked_once_and_not_where_it_is_known(tmp_path: Path) -> None:
    project = demo_project(tmp_path, orient="")
    ids = project.assets()
    assert find_unclear_up(project, ids) is None, "all stand on z = 0"
    lie_down(project.path(ids[0]))
    assert find_unclear_up(project, ids) == ids[0]
    history = History.open(project.folder)
    make_edit(history, project, SetUp(up="Z"))
    assert find_unclear_up(project, ids) is None, "it was answered"
    history.undo()
    assert find_unclear_up(project, ids) == ids[0]
    project.set_orientation("+Z: Is(leg) -> Is(panel)")
    assert find_unclear_up(project, ids) is None, "landmarks say it"
