"""Made hulls in an MJCF: they are what they are, whatever default classes, frames and the parent itself say."""

from pathlib import Path

import numpy as np
import pytest

from meshforge.common import AssetError
from meshforge.geometry import Box, Capsule, Cylinder, Ellipsoid, Pose, Shape, Sphere, convex_hull
from meshforge.symbolic import Geom
from tests.mjcf_engines import TETRAHEDRON, model, put, read
from tests.mjcf_models import Pair, compiled, hull, replaced, write

TURNED = Pose(Pose.from_rpy([0, 0, 0], [0.4, -0.3, 1.2]).rotation, [0.3, -0.2, 0.7])
WEDGE = convex_hull(TURNED.apply(np.array([[0, 0, 0], [1, 0, 0], [0, 2, 0], [1, 2, 0], [0, 0, 0.5], [0, 2, 0.7]])))
SHAPES: dict[str, Shape] = {
    "box": Box(TURNED, np.array([0.1, 0.2, 0.3])),
    "sphere": Sphere(TURNED, 0.25),
    "capsule": Capsule(TURNED, 0.1, 0.4),
    "cylinder": Cylinder(TURNED, 0.1, 0.4),
    "ellipsoid": Ellipsoid(TURNED, np.array([0.1, 0.2, 0.3])),
    "wedge": WEDGE,
}
ASSETS = (
    f'<asset><mesh name="m" vertex="{TETRAHEDRON}"/><mesh name="n" vertex="{TETRAHEDRON}" scale="2 2 2"/>'
    '<hfield name="h" nrow="2" ncol="2" size="1 1 1 1" elevation="0 1 1 0"/></asset>'
)
CLASSES = {
    "nothing": ("", 'size="1"'),
    "a type": ('type="box"', 'size="1 2 3"'),
    "a size of three numbers": ('size="1 2 3"', 'type="box"'),
    "a place": ('pos="1 2 3"', 'size="1"'),
    "a quaternion": ('quat="1 2 3 4"', 'type="box" size="1 2 3"'),
    "Euler's angles": ('euler="10 20 30"', 'type="box" size="1 2 3"'),
    "an axis and an angle": ('axisangle="1 2 3 40"', 'type="box" size="1 2 3"'),
    "two axes": ('xyaxes="0 1 0 -1 0 1"', 'type="box" size="1 2 3"'),
    "one axis": ('zaxis="1 2 3"', 'type="box" size="1 2 3"'),
    "a mesh": ('type="mesh" mesh="m" pos="1 0 0"', ""),
    "a mesh for a fitted box": ('type="box" mesh="m" fitscale="2"', ""),
    "a height field": ('hfield="h"', 'hfield="" size="1"'),
    "a shell": ('shellinertia="true"', 'size="1"'),
    "a mass": ('mass="3"', 'size="1"'),
    "two ends": ('type="capsule" fromto="0 0 0 1 0 0" size=".1"', ""),
}
OWN = {
    "two ends": 'type="cylinder" fromto="0 0 0 1 1 1" size=".3"',
    "a mesh": 'type="mesh" mesh="n" pos="1 2 3" euler="10 20 30"',
    "a fitted mesh": 'type="ellipsoid" mesh="n" fitscale="1.5"',
    "two axes": 'type="box" size="1 2 3" xyaxes="0 1 0 -1 0 1"',
}


@pytest.mark.parametrize("kind", SHAPES)
@pytest.mark.parametrize("said", CLASSES)
def test_a_class_that_sets_geometry_does_not_change_a_made_hull(said: str, kind: str, tmp_path: Path) -> None:
    by_class, own = CLASSES[said]
    defaults = f'<default><default class="c"><geom {by_class} condim="4" friction=".5 .1 .1"/></default></default>'
    text = model(
        f'<body name="b" pos="1 0 0" euler="0 0 30"><geom name="g" class="c" {own}/></body>', ASSETS + defaults
    )
    check(tmp_path, text, SHAPES[kind])


@pytest.mark.parametrize("kind", SHAPES)
@pytest.mark.parametrize("said", OWN)
def test_nothing_of_the_parents_own_geometry_stays(said: str, kind: str, tmp_path: Path) -> None:
    text = model(
        f'<body name="b"><geom name="g" {OWN[said]} priority="2" solref=".1 .2" rgba="1 0 0 1"/></body>', ASSETS
    )
    check(tmp_path, text, SHAPES[kind])


CONTACT = (
    'contype="3" conaffinity="5" condim="6" group="2" priority="1" friction="1 .1 .01" solmix=".5" solref=".03 .9"'
    ' solimp=".8 .9 .01 .4 3" margin=".01" gap=".002" rgba=".1 .2 .3 .4" user="7" material="k" fluidshape="ellipsoid"'
)


@pytest.mark.parametrize("kind", ["box", "wedge"])
def test_all_that_is_no_geometry_is_inherited(kind: str, tmp_path: Path) -> None:
    before = '<size nuser_geom="1"/><asset><material name="k"/></asset>'
    check(tmp_path, model(f'<body name="b"><geom name="g" size="1" {CONTACT}/></body>', before), SHAPES[kind])


@pytest.mark.parametrize("kind", ["box", "wedge"])
def test_a_class_with_two_ends_is_spelled_out(kind: str, tmp_path: Path) -> None:
    defaults = f'<asset><material name="k"/></asset><size nuser_geom="1"/><default><default class="o"><geom {CONTACT}/>'
    defaults += '<default class="c"><geom type="capsule" size=".1" fromto="0 0 0 1 0 0"/></default></default></default>'
    path = check(tmp_path, model('<body name="b" childclass="c"><geom name="g"/></body>', defaults), SHAPES[kind])
    assert b'class="main"' in path.read_bytes()


def test_two_ends_for_all_geoms_cannot_be_undone(tmp_path: Path) -> None:
    defaults = '<default><geom type="capsule" size=".1" fromto="0 0 0 1 0 0"/></default>'
    with pytest.raises(AssetError, match="'b/g~1' cannot be written: the default class of all geoms sets 'fromto'"):
        check(tmp_path, model('<body name="b"><geom name="g"/></body>', defaults), SHAPES["box"])


FRAMES = {
    "one": '<frame pos="1 2 3" euler="10 20 30">{}</frame>',
    "with a class": '<frame pos="1 0 0" childclass="c"><frame zaxis="1 1 1">{}</frame></frame>',
}


@pytest.mark.parametrize("kind", ["capsule", "wedge"])
@pytest.mark.parametrize("frames", FRAMES)
def test_a_hull_in_place_of_one_in_frames_is_where_it_is(frames: str, kind: str, tmp_path: Path) -> None:
    before = (
        '<compiler angle="degree" eulerseq="ZYX"/><default><default class="c"><geom condim="1"/></default></default>'
    )
    geom = FRAMES[frames].format('<geom name="g" type="box" size="1 2 3"/>')
    path = check(tmp_path, model(f'<body name="b" pos="1 0 0">{geom}</body>', before), SHAPES[kind])
    assert path.read_bytes().count(b"</frame>") == geom.count("</frame>")


def test_defaults_of_all_meshes_do_not_change_a_made_one(tmp_path: Path) -> None:
    before = '<default><mesh scale=".001 .001 .001" maxhullvert="4" inertia="shell"/></default>'
    path = check(tmp_path, model('<body name="b"><geom name="g" size="1"/></body>', before), WEDGE)
    assert compiled(path).mesh_vertnum.tolist() == [len(WEDGE.vertices)]


@pytest.mark.parametrize("scale", [1e-1, 1e-3, 1e-5, 1e-6])
def test_small_and_flat_hulls_are_written(scale: float, tmp_path: Path) -> None:
    """MuJoCo refuses to tell the inertia of a solid below 1e-15 cubic metres."""
    for flat in (1.0, 1e-4):
        shape = convex_hull(WEDGE.vertices * scale * [1, 1, flat])
        assert shape.volume < 2e-15 or scale > 1e-5
        check(tmp_path / f"{flat}", model('<body name="b"><geom name="g" size="1"/></body>'), shape)


def test_a_hull_far_from_its_body_keeps_its_digits(tmp_path: Path) -> None:
    shape = WEDGE.transform(np.eye(3) * 1e-3, np.array([50.0, -30.0, 20.0]))
    path = check(tmp_path, model('<body name="b"><geom name="g" size="1"/></body>'), shape)
    (found,) = read(path).geoms
    assert np.abs(found.shape.aabb.size - shape.aabb.size).max() < 1e-9


def test_a_hull_of_another_body_than_its_parents_stands_at_the_end_of_its_own(tmp_path: Path) -> None:
    before = '<default><default class="c"><geom condim="4" contype="2"/></default></default>'
    text = model(
        '<body name="a" childclass="c"><geom name="g" type="box" size="1 2 3" margin=".1"/></body>\n'
        '<body name="b">\n  <geom name="h" size="1"/>\n  <site name="s"/>\n</body><body name="c"/>',
        before,
    )
    asset = read(put(tmp_path / "in", {"main.xml": text}))
    for body in ("b", "c"):
        made = Geom(f"{body}/g~1", body, SHAPES["box"], "a/g")
        path, _ = write(replaced(asset, [], made), tmp_path / body)
        Pair(compiled(asset.path), compiled(path)).assert_same(made=[made])
    assert b'<site name="s"/>\n  <geom name="g~1" class="main"' in (tmp_path / "b" / "main.xml").read_bytes()


def test_a_hull_without_parent_has_what_its_body_gives_and_collides(tmp_path: Path) -> None:
    before = '<default><default class="v"><geom contype="0" conaffinity="0" group="2"/></default></default>'
    asset = read(put(tmp_path / "in", {"main.xml": model('<body name="b" childclass="v"/>', before)}))
    made = Geom("b/new~1", "b", WEDGE)
    path, _ = write(replaced(asset, [], made), tmp_path / "out", "recompute")
    (found,) = read(path).geoms
    assert found.name == "b/new~1"
    assert compiled(path).geom_group.tolist() == [2]


def test_a_body_that_is_not_there_is_told_with_the_nearest(tmp_path: Path) -> None:
    asset = read(put(tmp_path, {"main.xml": model('<body name="body"><geom size="1"/></body>')}))
    with pytest.raises(AssetError, match=r"(?s)'x~1' is on body 'bodi', which is not there.*nearest.*'body'"):
        write(replaced(asset, [], Geom("x~1", "bodi", WEDGE, None)), tmp_path / "out")


def check(folder: Path, text: str, shape: Shape) -> Path:
    """Write the model with another shape in place of its only hull `g`; MuJoCo finds that, and all else as before."""
    asset = read(put(folder / "in", {"main.xml": text}))
    parent = next(geom for geom in asset.geoms if geom.name.endswith("/g"))
    made = hull(asset, parent.name, shape)
    path, output = write(replaced(asset, [parent.name], made), folder / "out")
    assert not output.names and not output.notes
    Pair(compiled(asset.path), compiled(path)).assert_same(removed=[parent.name], made=[made])
    return path
