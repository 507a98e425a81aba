"""Masses of an edited MJCF: bodies keep what MuJoCo compiled before, or have those of the edited hulls."""

from pathlib import Path

import numpy as np
import pytest

from meshforge.common import AssetError
from meshforge.formats.base import Mass, Output
from meshforge.geometry import Box, Cylinder, Pose, convex_hull
from meshforge.symbolic import Asset
from tests.mjcf_engines import model, put, read
from tests.mjcf_models import Pair, compiled, hull, replaced, write

BOX = Box(Pose(Pose.from_rpy([0, 0, 0], [0.4, -0.3, 1.2]).rotation, [0.3, -0.2, 0.7]), np.array([0.1, 0.2, 0.3]))
TWO = (
    '<body name="b" pos="1 2 3" euler="10 20 30">\n  {}<geom name="g" type="box" size=".1 .2 .3" pos=".1 0 0"'
    ' euler="30 20 10"/>\n  <geom name="h" size=".1" pos="0 1 .3"/>\n</body>'
    '<body name="other"><joint/>{}<geom name="o" type="capsule" size=".1 .2"/>'
    '<body name="static"><geom name="s" size=".2" pos=".3 .2 .1"/></body></body>'
)
FREE = "<freejoint/>"
GIVEN = '<inertial pos=".1 .2 .3" mass="4" diaginertia="2 2 1" quat="1 1 0 0"/>'


def edited(asset: Asset) -> Asset:
    return replaced(asset, ["b/g"], hull(asset, "b/g", BOX))


def check(folder: Path, text: str, change: str = "box", mass: Mass = "keep") -> tuple[Path, Output, Pair]:
    """Write the model with a box in place of `b/g`, or without it; MuJoCo finds all else as it was."""
    asset = read(put(folder / "in", {"main.xml": text}))
    made = [hull(asset, "b/g", BOX)] if change == "box" else []
    path, output = write(replaced(asset, ["b/g"], *made), folder / "out", mass)
    pair = Pair(compiled(asset.path), compiled(path))
    pair.assert_same(removed=["b/g"], made=made, masses=mass == "keep")
    return path, output, pair


SETTINGS = {
    "none": "",
    "a total mass": '<compiler settotalmass="3"/>',
    "least masses": '<compiler boundmass="60" boundinertia="9"/>',
    "balanced inertia": '<compiler balanceinertia="true"/>',
    "free bodies on their centres of mass": '<compiler alignfree="true"/>',
    "groups of geoms that weigh": '<compiler inertiagrouprange="0 1"/>',
    "masses of elements only where given": '<compiler inertiafromgeom="auto"/>',
    "much at once": '<compiler settotalmass="3" alignfree="true" boundmass=".1" balanceinertia="true"/>',
}


@pytest.mark.parametrize("change", ["box", "nothing"])
@pytest.mark.parametrize("joint", [FREE, "", '<freejoint align="true"/>'])
@pytest.mark.parametrize("setting", SETTINGS)
def test_a_body_keeps_its_mass_centre_and_inertia(setting: str, joint: str, change: str, tmp_path: Path) -> None:
    path, output, _ = check(tmp_path, model(TWO.format(joint, ""), SETTINGS[setting]), change)
    assert not output.notes
    assert path.read_bytes().count(b"<inertial") == 1


def test_fused_bodies_keep_the_mass_of_all(tmp_path: Path) -> None:
    asset = read(put(tmp_path / "in", {"main.xml": model(TWO.format(FREE, ""), '<compiler fusestatic="true"/>')}))
    made = hull(asset, "static/s", BOX)
    path, _ = write(replaced(asset, ["static/s"], made), tmp_path / "out")
    before, after = compiled(asset.path), compiled(path)
    assert before.nbody == 3
    for field in ("body_mass", "body_ipos", "body_inertia", "body_iquat"):  # summed up by way of a rotation
        np.testing.assert_allclose(getattr(after, field), getattr(before, field), rtol=1e-12, atol=1e-15, err_msg=field)


def test_an_inertial_of_the_author_stays_as_it_is(tmp_path: Path) -> None:
    path, _, _ = check(tmp_path, model(TWO.format(GIVEN + FREE, "")))
    assert path.read_bytes().count(b"<inertial") == 1
    assert GIVEN.encode() in path.read_bytes()


@pytest.mark.parametrize("weightless", ['density="0"', 'group="3"'])
def test_a_geom_that_does_not_weigh_leaves_the_body_alone(weightless: str, tmp_path: Path) -> None:
    text = TWO.format(FREE, "").replace('name="g"', f'name="g" {weightless}')
    path, _, _ = check(tmp_path, model(text, '<compiler inertiagrouprange="0 2"/>'))
    assert b"<inertial" not in path.read_bytes()


def test_where_geoms_never_weigh_nothing_is_written(tmp_path: Path) -> None:
    text = TWO.format(GIVEN + FREE, GIVEN).replace('<body name="static">', f'<body name="static">{GIVEN}')
    path, _, _ = check(tmp_path, model(text, '<compiler inertiafromgeom="false"/>'))
    assert path.read_bytes().count(b"<inertial") == 3


@pytest.mark.parametrize("change", ["box", "nothing"])
@pytest.mark.parametrize("own", ["", GIVEN])
def test_where_geoms_always_weigh_the_setting_goes_bodies_keep_masses(own: str, change: str, tmp_path: Path) -> None:
    """An `<inertial>` that was ignored so far must not count now."""
    before = '<compiler angle="degree"/>\n<compiler inertiafromgeom="true"/>'
    text = TWO.format(FREE + own, f'<frame pos="1 0 0">{GIVEN}</frame>')
    path, output, _ = check(tmp_path, model(text, before), change)
    assert b'inertiafromgeom="auto"' in path.read_bytes()
    assert GIVEN.encode() not in path.read_bytes()
    assert path.read_bytes().count(b"<inertial") == 2
    assert output.notes == ("inertiafromgeom is 'auto' now, so that <inertial> keeps the masses of b, other",)


def test_where_geoms_always_weigh_but_none_of_mass_is_edited_the_setting_stays(tmp_path: Path) -> None:
    text = model(TWO.format(FREE, "").replace('name="g"', 'name="g" mass="0"'), '<compiler inertiafromgeom="true"/>')
    path, output, _ = check(tmp_path, text)
    assert b'inertiafromgeom="true"' in path.read_bytes()
    assert not output.notes


def test_the_only_geom_of_a_moving_body_can_be_removed(tmp_path: Path) -> None:
    """Without its mass, MuJoCo would refuse the body."""
    text = model('<body name="b"><freejoint/><geom name="g" size="1" pos="1 2 3"/></body>')
    path, _, _ = check(tmp_path, text, "nothing")
    assert read(path).geoms == ()


def test_removing_the_only_mass_of_a_moving_body_is_refused_where_masses_follow_the_hulls(tmp_path: Path) -> None:
    text = model('<body name="b"><freejoint/><geom name="g" size="1"/></body>')
    with pytest.raises(AssetError, match=r"(?s)of the edited file: MuJoCo refuses .*moving bodies.*Keep the masses"):
        check(tmp_path, text, "nothing", "recompute")


def test_geoms_of_the_world_have_no_mass(tmp_path: Path) -> None:
    asset = read(put(tmp_path / "in", {"main.xml": model('<geom name="g" size="1"/><geom name="h" size="1"/>')}))
    made = hull(asset, "world/g", BOX)
    path, _ = write(replaced(asset, ["world/g"], made), tmp_path / "out")
    Pair(compiled(asset.path), compiled(path)).assert_same(removed=["world/g"], made=[made])
    assert b"<inertial" not in path.read_bytes()


@pytest.mark.parametrize(
    "layout", ["<body name='b'>{}</body>", "<body name='b'>\n\t{}\n</body>", "<body name='b'>\r\n  {}\r\n</body>"]
)
def test_the_inertial_stands_first_in_lines_like_its_neighbours(layout: str, tmp_path: Path) -> None:
    path, _, _ = check(tmp_path, model(layout.format('<geom name="g" size="1"/>')))
    text = path.read_bytes().decode()
    assert layout.split("{}")[0].split(">", 1)[1] + "<inertial " in text


# recomputed masses


@pytest.mark.parametrize("said", ["", 'density="50"', 'mass="3"', 'mass="0"'])
def test_a_made_hull_has_the_density_of_its_parent(said: str, tmp_path: Path) -> None:
    text = model(f'<body name="b"><geom name="g" type="box" size="1 2 3" {said}/></body>')
    _, _, pair = check(tmp_path, text, "box", "recompute")
    ratio = BOX.volume / 48.0
    assert pair.after.body_mass[1] == pytest.approx(pair.before.body_mass[1] * ratio, rel=1e-12)


def test_a_mass_of_a_class_becomes_the_same_density(tmp_path: Path) -> None:
    before = '<default><geom mass="2"/></default>'
    for name, shape in (("cylinder", Cylinder(BOX.pose, 0.1, 0.3)), ("hull", convex_hull(BOX.vertices))):
        asset = read(
            put(tmp_path / "in", {"main.xml": model('<body name="b"><geom name="g" size="1"/></body>', before)})
        )
        path, _ = write(replaced(asset, ["b/g"], hull(asset, "b/g", shape)), tmp_path / name, "recompute")
        wanted = 2 * shape.volume / asset.geoms[0].shape.volume
        assert compiled(path).body_mass[1] == pytest.approx(wanted, rel=1e-6)


def test_a_shell_stays_a_shell_as_a_mesh(tmp_path: Path) -> None:
    text = model('<body name="b"><geom name="g" type="box" size=".1 .2 .3" density="10" shellinertia="true"/></body>')
    asset = read(put(tmp_path / "in", {"main.xml": text}))
    box = asset.geoms[0].shape
    path, _ = write(
        replaced(asset, ["b/g"], hull(asset, "b/g", convex_hull(box.vertices))), tmp_path / "out", "recompute"
    )
    before, after = compiled(asset.path), compiled(path)
    np.testing.assert_allclose(after.body_mass, before.body_mass, rtol=1e-6)
    np.testing.assert_allclose(after.body_inertia, before.body_inertia, rtol=1e-5)


@pytest.mark.parametrize("setting", ['alignfree="true"', 'settotalmass="3"'])
def test_recomputed_masses_may_move_the_frame_of_a_free_body(setting: str, tmp_path: Path) -> None:
    text = model(TWO.format(FREE, ""), f"<compiler {setting}/>")
    asset = read(put(tmp_path / "in", {"main.xml": text}))
    path, _ = write(edited(asset), tmp_path / "out", "recompute")
    again = read(path)
    shapes = {geom.name: geom.shape for geom in again.geoms}
    for geom in edited(asset).geoms:
        np.testing.assert_allclose(shapes[geom.name].aabb.min, geom.shape.aabb.min, atol=1e-12)
        np.testing.assert_allclose(shapes[geom.name].aabb.max, geom.shape.aabb.max, atol=1e-12)


DERIVED = {
    "springs by time and damping": '<body name="b"><joint name="j" springdamper="1 .5"/>{}</body>',
    "damping ratios": '<body name="b"><joint name="j"/>{}</body>|<position joint="j" kp="10" dampratio="1"/>',
    "muscles": '<body name="b"><joint name="j" range="-1 1" limited="true"/>{}</body>|<muscle joint="j"/>',
}


@pytest.mark.parametrize("kind", DERIVED)
def test_what_follows_from_masses_follows_from_those_of_the_edited_hulls(kind: str, tmp_path: Path) -> None:
    body, _, actuator = DERIVED[kind].partition("|")
    geoms = '<geom name="g" type="box" size=".1 .1 .1"/><geom name="h" size=".2" pos="1 0 0"/>'
    text = model(body.format(geoms)).replace("</mujoco>", f"<actuator>{actuator}</actuator></mujoco>")
    asset = read(put(tmp_path / "in", {"main.xml": text}))
    path, _ = write(replaced(asset, ["b/g"], hull(asset, "b/g", BOX)), tmp_path / "out", "recompute")
    one, other = compiled(asset.path), compiled(path)
    assert one.body_mass[1] != other.body_mass[1]
    assert one.nu == other.nu
    kept, _ = write(replaced(asset, ["b/g"], hull(asset, "b/g", BOX)), tmp_path / "kept")
    Pair(one, compiled(kept)).assert_same(removed=["b/g"], made=[hull(asset, "b/g", BOX)])


LOST = '<mesh name="lost" file="lost.obj"/>'
SEEN = '<geom type="mesh" mesh="lost" group="1" contype="0" conaffinity="0" {}/>'


def test_a_mass_of_which_a_part_is_not_known_is_not_written(tmp_path: Path) -> None:
    text = model(TWO.format(FREE + SEEN.format('density="300"'), ""), f"<asset>{LOST}</asset>")
    asset = read(put(tmp_path / "in", {"main.xml": text}))
    assert "lost.obj" in asset.notes[0]
    with pytest.raises(AssetError, match="the mass of body 'b' cannot be kept: a visual mesh that weighs could not be"):
        write(edited(asset), tmp_path / "out")
    path, _ = write(edited(asset), tmp_path / "out", "recompute")
    assert b"<inertial" not in path.read_bytes()
    made = hull(asset, "static/s", BOX)
    path, _ = write(replaced(asset, ["static/s"], made), tmp_path / "other")  # a body that is known weighs what it did
    assert path.read_bytes().count(b"<inertial") == 1


@pytest.mark.parametrize("weightless", ['mass="0"', 'density="0"', 'density="300" group="5"'])
def test_missing_visuals_that_weigh_nothing_are_no_matter(weightless: str, tmp_path: Path) -> None:
    seen = SEEN.format(weightless).replace('group="1" ', "") if "group" in weightless else SEEN.format(weightless)
    text = model(TWO.format(FREE + seen, ""), f'<compiler inertiagrouprange="0 4"/><asset>{LOST}</asset>')
    asset = read(put(tmp_path / "in", {"main.xml": text}))
    path, _ = write(edited(asset), tmp_path / "out")
    assert path.read_bytes().count(b"<inertial") == 1


def test_an_authored_mass_stays_where_another_one_is_refused(tmp_path: Path) -> None:
    wrong = '<inertial pos="0 0 0" mass="1" fullinertia="1 1 1 9 9 9"/>'
    text = model(TWO.format(FREE + GIVEN, wrong))
    asset = read(put(tmp_path / "in", {"main.xml": text}))
    assert "refuses" in asset.notes[0]
    path, _ = write(edited(asset), tmp_path / "out")
    assert GIVEN.encode() in path.read_bytes()
    assert path.read_bytes().count(b"<inertial") == 2
