"""Geoms of an MJCF as hulls and opaque pieces: shapes, places, names, bodies; held against MuJoCo where it tells."""

import pickle
from pathlib import Path

import numpy as np
import pytest

from meshforge.formats.mjcf.document import body_names, geom_names
from meshforge.geometry import Pose
from meshforge.symbolic import Surface
from tests.mjcf_engines import TETRAHEDRON, assert_as_in_mujoco, asset, model, put, read

MESH = f'<asset><mesh name="m" vertex="{TETRAHEDRON}"/></asset>'
OBJ = "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"


PLACED = {
    "primitives of every kind": (
        '<geom name="a" type="box" size="1 2 3"/><geom name="b" size="1"/><geom name="c" type="capsule" size="1 2"/>'
        '<geom name="d" type="cylinder" size="1 2"/><geom name="e" type="ellipsoid" size="1 2 3"/>',
        "",
    ),
    "fromto": (
        '<geom type="capsule" fromto="0 0 0 1 1 1" size=".1"/><geom type="box" fromto="1 0 0 1 0 2" size=".3"/>',
        "",
    ),
    "degrees": ('<geom type="box" size="1 2 3" pos="1 2 3" euler="10 20 30"/>', ""),
    "radians in another sequence": (
        '<geom type="box" size="1 2 3" euler=".1 .2 .3"/>',
        '<compiler angle="radian" eulerseq="zyx"/>',
    ),
    "axes": (
        '<geom type="box" size="1 2 3" xyaxes="1 1 0 0 0 1"/><geom type="box" size="1 2 3" axisangle="0 1 1 40"/>'
        '<geom type="cylinder" size="1 2" zaxis="1 2 3"/><geom type="box" size="1 2 3" quat="1 2 3 4"/>',
        "",
    ),
    "bodies in bodies": (
        '<body pos="1 0 0" euler="0 0 90"><body pos="0 1 0" quat="1 1 0 0"><geom type="box" size="1 2 3"/></body>'
        '<geom size="1"/></body><geom size="2"/>',
        "",
    ),
    "joints at their reference": (
        '<body pos="1 0 0"><joint axis="0 1 0" pos="0 0 1" ref="30"/><joint type="slide" ref="2"/>'
        '<geom type="box" size="1 2 3"/></body><body pos="3 0 0" euler="0 50 0"><freejoint/><geom size="1"/></body>',
        "",
    ),
    "frames": (
        '<frame pos="1 0 0" euler="0 0 90"><frame pos="1 0 0"><geom size="1"/><body name="b"><geom size="2"/></body>'
        '</frame></frame><geom size="3"/>',
        "",
    ),
    "a frame that scales": ('<frame scale="2"><geom size="1"/><geom type="mesh" mesh="m"/></frame>', MESH),
    "replicated": (
        '<replicate count="3" offset="1 0 0" euler="0 0 10"><geom size="1"/><body name="b" pos="1 0 0">'
        '<geom name="g" size="2"/></body></replicate><geom size="3"/>',
        "",
    ),
    "default classes": (
        '<body childclass="c"><geom/><geom class="main" size="4" name="x"/></body><geom class="d"/>',
        '<default><geom type="sphere" size="1"/><default class="c"><geom type="box" size="1 2 3" pos="1 0 0"/>'
        '<default class="d"><geom pos="2 0 0"/></default></default></default>',
    ),
    "mesh": ('<geom type="mesh" mesh="m" pos="1 2 3" euler="10 20 30"/><geom type="mesh" mesh="m"/>', MESH),
    "fitted primitives": ('<geom type="box" mesh="m" pos="1 0 0"/><geom type="capsule" mesh="m" fitscale=".5"/>', MESH),
    "fitted to boxes": ('<geom type="box" mesh="m" euler="0 0 20"/>', '<compiler fitaabb="true"/>' + MESH),
    "scaled by the default": ('<geom type="mesh" mesh="m"/>', '<default><mesh scale="2 2 .5"/></default>' + MESH),
    "built in": (
        '<geom type="mesh" mesh="w"/><geom type="mesh" mesh="t" pos="3 0 0"/>',
        '<asset><mesh name="w" builtin="wedge" params="10 10 90 45 0.5"/>'
        '<mesh name="t" builtin="supertorus" params="12 .3 1 1"/></asset>',
    ),
}


@pytest.mark.parametrize("what", PLACED)
def test_geoms_are_where_mujoco_has_them(what: str, tmp_path: Path) -> None:
    inside, before = PLACED[what]
    path = put(tmp_path, {"main.xml": model(inside, before)})
    found = read(path)
    assert found.geoms and not found.notes
    assert_as_in_mujoco(found, path)


@pytest.mark.parametrize(
    "changes",
    ['scale="1 -2 1"', 'scale="-1 -1 -1"', 'refpos="1 2 3"', 'refquat="1 1 0 0.5"',
     'refpos="1 2 3" refquat="0.5 0.5 0.1 0.3" scale="2 1 -1"'],
)  # fmt: skip
@pytest.mark.parametrize("kind", ["inline", "file", "scaled"])
def test_a_changed_mesh_is_where_mujoco_has_it_and_shows_there(kind: str, changes: str, tmp_path: Path) -> None:
    content = f'vertex="{TETRAHEDRON}"' if kind == "inline" else 'file="m.obj"'
    before = f'<asset><mesh name="m" {content} {changes}/></asset>'
    inside = '<geom type="mesh" mesh="m" pos="1 2 3" euler="10 20 30"/>'
    inside, size = (f'<frame scale="2">{inside}</frame>', 8.0) if kind == "scaled" else (inside, 1.0)
    path = put(tmp_path, {"main.xml": model(inside, before), "m.obj": OBJ})
    found = read(path)
    assert_as_in_mujoco(found, path)
    (shown,) = found.visuals
    (hull,) = found.geoms
    doubled = "scale" in changes and "2" in changes
    assert hull.shape.volume == pytest.approx(size * (2.0 if doubled else 1.0), rel=1e-6)
    np.testing.assert_allclose(_sorted(shown.vertices), _sorted(hull.shape.vertices), atol=1e-6)
    assert _volume(shown) > 0


def _sorted(points: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> list[list[float]]:
    return sorted(np.round(points, 5).tolist())


def _volume(surface: Surface) -> float:
    a, b, c = (surface.vertices[surface.faces[:, k]] for k in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)


def test_one_mesh_geom_is_one_hull_whatever_its_pieces(tmp_path: Path) -> None:
    two = OBJ + OBJ.replace("v 0", "v 9").replace("v 1", "v 10").replace(
        "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4", "f 5 7 6\nf 5 6 8\nf 6 7 8\nf 7 5 8"
    )
    files: dict[str, str | bytes] = {
        "main.xml": model('<geom type="mesh" mesh="m"/>', '<asset><mesh file="m.obj"/></asset>'),
        "m.obj": two,
    }
    (hull,) = read(put(tmp_path, files)).geoms
    assert np.ptp(hull.shape.vertices[:, 0]) == pytest.approx(10)


def test_a_hull_keeps_to_the_number_of_vertices_that_the_model_allows(tmp_path: Path) -> None:
    ball = '<asset><mesh name="b" builtin="sphere" params="3" maxhullvert="20"/></asset>'
    (hull,) = asset(tmp_path, '<geom type="mesh" mesh="b"/>', ball).geoms
    assert len(hull.shape.vertices) == 20


def test_legacy_msh_files_are_read_by_mujoco(tmp_path: Path) -> None:
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 3]], np.float32)
    faces = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]], np.int32)
    msh = np.array([4, 0, 0, 4], np.int32).tobytes() + points.tobytes() + faces.tobytes()
    files: dict[str, str | bytes] = {
        "main.xml": model('<geom type="mesh" mesh="m"/>', '<asset><mesh file="m.msh"/></asset>'),
        "m.msh": msh,
    }
    path = put(tmp_path, files)
    found = read(path)
    assert_as_in_mujoco(found, path)
    assert found.geoms[0].shape.volume == pytest.approx(1)
    assert found.files == (tmp_path / "m.msh",)
    np.testing.assert_allclose(found.visuals[0].vertices, points, atol=1e-6)


def test_geoms_without_contact_bits_are_visuals_and_those_of_a_pair_collide(tmp_path: Path) -> None:
    off = 'contype="0" conaffinity="0"'
    body = f'<body name="b"><freejoint/><geom name="p" size="1" {off}/><geom size="2" {off}/></body>'
    inside = f'<geom name="a" size="1" {off}/>{body}'
    text = model(inside).replace("</mujoco>", '<contact><pair geom1="a" geom2="p"/></contact></mujoco>')
    found = read(put(tmp_path, {"main.xml": text}))
    assert [geom.name for geom in found.geoms] == ["world/a", "b/p"]
    assert [surface.body for surface in found.visuals] == ["b"]


@pytest.mark.parametrize("bits", ['contype="0"', 'conaffinity="0"', 'contype="0" conaffinity="4"'])
def test_one_contact_bit_is_enough(bits: str, tmp_path: Path) -> None:
    assert len(asset(tmp_path, f'<geom size="1" {bits}/>').geoms) == 1


def test_what_is_invisible_is_no_visual(tmp_path: Path) -> None:
    off = 'contype="0" conaffinity="0"'
    assert not asset(tmp_path, f'<geom size="1" {off} rgba="1 1 1 0"/>').visuals
    assert not asset(tmp_path, '<geom type="mesh" mesh="m" group="3"/>', MESH).visuals


def test_planes_and_height_fields_are_opaque(tmp_path: Path) -> None:
    field = '<asset><hfield name="h" nrow="3" ncol="2" size="1 2 3 4" elevation="0 1 2 3 4 5"/></asset>'
    inside = '<geom name="floor" type="plane" size="0 0 1" zaxis="1 0 0"/><geom type="hfield" hfield="h" pos="0 0 1"/>'
    plane, hills = asset(tmp_path, inside, field).non_convex
    assert (plane.name, plane.reason, plane.surface) == ("world/floor", "a plane has no end", None)
    assert plane.plane is not None
    np.testing.assert_allclose(plane.plane.rotation[:, 2], [1, 0, 0], atol=1e-12)
    assert (hills.name, hills.reason) == ("world/geom1", "a height field is no convex hull")
    assert hills.surface is None


def test_signed_distance_fields_are_opaque_and_shown(tmp_path: Path) -> None:
    torus = (
        '<extension><plugin plugin="mujoco.sdf.torus"><instance name="t"><config key="radius1" value="0.35"/>'
        '<config key="radius2" value="0.15"/></instance></plugin></extension>'
        '<asset><mesh name="torus"><plugin instance="t"/></mesh></asset>'
    )
    geom = '<geom type="sdf" mesh="torus"><plugin instance="t"/></geom>'
    (ring,) = asset(tmp_path, f'<body name="b">{geom}</body>', torus).non_convex
    assert (ring.name, ring.reason) == ("b/geom0", "a signed distance field is no convex hull")
    assert ring.surface is not None
    np.testing.assert_allclose(np.ptp(ring.surface.vertices, axis=0), [1, 1, 0.3], atol=0.05)


def test_an_unnamed_geom_is_counted_in_its_body_visuals_too(tmp_path: Path) -> None:
    visual = '<geom size="1" contype="0" conaffinity="0"/>'
    inside = f'<body name="b"><geom size="1"/>{visual}<geom size="1"/></body><geom size="1"/>'
    assert [geom.name for geom in asset(tmp_path, inside).geoms] == ["world/geom0", "b/geom0", "b/geom2"]


def test_an_unnamed_body_is_counted_in_the_model(tmp_path: Path) -> None:
    found = asset(tmp_path, '<body><body name="x"><geom size="1"/></body></body><body><geom size="1"/></body>')
    assert [body.name for body in found.bodies] == ["world", "body1", "x", "body3"]
    assert [geom.name for geom in found.geoms] == ["x/geom0", "body3/geom0"]


def test_names_are_unique_whatever_authors_call_things() -> None:
    assert geom_names([("b", "a/b"), ("b/a", "b"), ("b", ""), ("b", "")]) == ["b/a/b", "b/a/b@2", "b/geom1", "b/geom2"]
    assert body_names(["world", "", "body1", ""]) == ["world", "body1", "body1@2", "body3"]


def test_bodies_stay_apart_where_the_compiler_would_fuse_them(tmp_path: Path) -> None:
    bodies = '<body name="b"><geom size="2"/><body name="c" fuse="auto"><geom size="3"/></body></body>'
    inside = f'<geom size="1" contype="0" conaffinity="0"/>{bodies}'
    found = asset(tmp_path, inside, '<compiler fusestatic="true" discardvisual="true"/>')
    assert [geom.name for geom in found.geoms] == ["b/geom0", "c/geom0"]
    assert len(found.visuals) == 1


def test_masses_are_those_of_the_file_or_follow_from_geoms(tmp_path: Path) -> None:
    inertial = '<inertial pos="1 0 0" mass="2" diaginertia="3 4 5"/>'
    other = '<body name="b" pos="1 0 0"><geom size="1" mass="7"/></body>'
    a, b = asset(tmp_path, f'<body name="a">{inertial}<geom size="1"/></body>{other}').mechanism.inertials
    assert (a.body, a.mass, a.centre.tolist(), sorted(np.diag(a.inertia).tolist())) == ("a", 2, [1, 0, 0], [3, 4, 5])
    assert (b.body, b.centre.tolist()) == ("b", [1, 0, 0]) and b.mass == pytest.approx(7)


def test_joints_and_masses_are_told_in_the_root_frame(tmp_path: Path) -> None:
    inside = (
        '<body name="door" pos="1 0 0" euler="0 0 90">'
        '<joint name="hinge" axis="0 1 0" range="-10 80" ref="30" pos="0 0 1" damping="2"/>'
        '<geom type="box" size="1 2 3" mass="6"/><body name="bolt"><geom size="1"/></body></body>'
        '<body name="ball"><freejoint/><geom size="1"/></body>'
    )
    mechanism = asset(tmp_path, inside).mechanism
    hinge, bolt, ball = mechanism.joints
    assert (hinge.name, hinge.kind, hinge.parent, hinge.child, hinge.damping) == (
        "hinge",
        "revolute",
        "world",
        "door",
        2,
    )
    np.testing.assert_allclose(hinge.anchor, [1, 0, 1])
    np.testing.assert_allclose(hinge.axis, [-1, 0, 0], atol=1e-12)
    assert hinge.limits == pytest.approx(tuple(np.radians([-40, 50])))
    assert (bolt.kind, bolt.parent, ball.kind) == ("fixed", "door", "floating")
    door = mechanism.inertials[0]
    assert door.body == "door"
    assert door.mass == pytest.approx(6)
    np.testing.assert_allclose(door.centre, [1, 0, 0], atol=1e-12)
    np.testing.assert_allclose(np.diag(door.inertia), [2 * (1 + 9), 2 * (4 + 9), 2 * (1 + 4)])


def test_an_asset_pickles_with_its_document_and_visuals(tmp_path: Path) -> None:
    found = asset(tmp_path, '<geom type="mesh" mesh="m"/><geom size="1" contype="0" conaffinity="0"/>', MESH)
    again = pickle.loads(pickle.dumps(found))
    assert [geom.name for geom in again.geoms] == [geom.name for geom in found.geoms]
    assert len(again.visuals) == len(found.visuals) == 2
    assert again.document.tree.main.raw == found.path.read_bytes()


def test_geoms_tell_how_they_collide_with_defaults_and_classes(tmp_path: Path) -> None:
    before = (
        '<default><geom friction=".5"/><default class="stiff"><geom solref=".01 1" condim="4"/></default></default>'
    )
    found = asset(tmp_path, '<geom size="1"/><geom size="2" class="stiff" contype="3"/>', before)
    plain, stiff = (dict(geom.contact) for geom in found.geoms)
    assert plain["friction"] == stiff["friction"] == "0.5 0.005 0.0001"
    assert {name for name in plain if plain[name] != stiff[name]} == {"contype", "condim", "solref"}
    assert stiff["solref"] == "0.01 1"


def test_excluded_bodies_and_pairs_of_geoms_are_told_by_name_and_bits_to_the_last(tmp_path: Path) -> None:
    inside = (
        '<geom name="floor" size="1" contype="1048577"/><body name="a"><freejoint/><geom size="1"/></body>'
        '<body><freejoint/><geom name="g" size="1" conaffinity="-2"/></body>'
    )
    contact = '<contact><exclude body1="a" body2="world"/><pair geom1="g" geom2="floor"/></contact>'
    found = asset(tmp_path, inside, contact)
    assert [set(pair) for pair in found.mechanism.apart] == [{"world", "a"}]
    floor, _, other = (geom.name for geom in found.geoms)
    assert [set(pair) for pair in found.mechanism.paired] == [{floor, other}]
    assert dict(found.geoms[0].contact)["contype"] == "1048577"
    assert dict(found.geoms[2].contact)["conaffinity"] == "-2"
    moved = found.mechanism.move(Pose.of_translation([1, 0, 0]))
    assert (moved.apart, moved.paired) == (found.mechanism.apart, found.mechanism.paired)
