"""Writing a URDF: an edit changes its collision elements and nothing else, and reads back as what was meant."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from meshforge.common import AssetError
from meshforge.formats.urdf.edit import CAPSULE_READERS
from meshforge.geometry import Aabb, Box, Capsule, Cylinder, Ellipsoid, Polytope, Pose, Shape, Sphere, is_same_shape
from meshforge.symbolic import Asset, Geom
from tests.urdf_sample import HULLS, SAMPLE, THREE, corner_obj, link, made, put, read, robot, sample, without, write

TURNED = Pose.from_rpy([0.3, -0.2, 0.7], [0.4, -1.1, 2.0])
HALF = [0.1, 0.2, 0.3]


def rewritten(asset: Asset, tmp_path: Path) -> Asset:
    return read(put(write(asset), tmp_path / "out" / "cart.urdf"))


def test_an_unedited_file_is_written_byte_for_byte_with_its_meshes(tmp_path: Path) -> None:
    output = write(read(sample(tmp_path)), "other.urdf")
    assert output.main == SAMPLE.encode()
    assert output.made == {} and output.notes == ()
    assert output.copies == {"meshes/three.obj": tmp_path / "meshes" / "three.obj"}


def test_a_removed_primitive_takes_its_lines_along_and_names_what_would_be_renamed(tmp_path: Path) -> None:
    asset = read(sample(tmp_path))
    output = write(without(asset, "base/geom0"))
    element = SAMPLE[SAMPLE.index("    <collision>\n") : SAMPLE.index("    <collision name = ")]
    expected = SAMPLE.replace(element, "")
    expected = expected.replace(
        "<collision>\n      <geometry><sphere", '<collision name="geom2">\n      <geometry><sphere'
    )
    assert output.main.decode() == expected
    assert [g.name for g in rewritten(without(asset, "base/geom0"), tmp_path).geoms] == HULLS[1:]


def test_no_name_is_written_where_none_is_needed(tmp_path: Path) -> None:
    output = write(without(read(sample(tmp_path)), "base/geom2"))
    assert output.main.decode() == SAMPLE.replace(
        '    <collision>\n      <geometry><sphere radius="0.05"/></geometry>\n    </collision>\n', ""
    )


def test_pieces_that_stay_get_an_element_and_a_file_each(tmp_path: Path) -> None:
    asset = read(sample(tmp_path))
    edited = without(asset, "base/posts#1")
    output = write(edited)
    assert list(output.made) == ["meshes/cart--base_posts_0.obj", "meshes/cart--base_posts_2.obj"]
    first = """<collision name = "posts#0" drake:acceptable="yes">
      <!-- three posts -->
      <origin xyz="0.1 0 0.2" rpy="0 0.25 0"/>
      <geometry>
        <mesh filename='meshes/cart--base_posts_0.obj' scale="0.1 0.1 -0.2"/>
      </geometry>
      <material name="grey"/>
    </collision>
    """
    second = first.replace("\n      <!-- three posts -->", "").replace("posts#0", "posts#2").replace("_0.obj", "_2.obj")
    start, end = SAMPLE.index("<collision name = "), SAMPLE.index("<collision>\n      <geometry><sphere")
    sphere = SAMPLE[end:].replace("<collision>", '<collision name="geom2">', 1)
    assert output.main.decode() == SAMPLE[:start] + first + second + sphere
    again = rewritten(edited, tmp_path)
    for old, new in zip(edited.geoms, again.geoms, strict=True):
        assert old.name == new.name and is_same_shape(old.shape, new.shape)


def test_the_triangles_of_a_kept_piece_are_those_of_the_author(tmp_path: Path) -> None:
    output = write(without(read(sample(tmp_path)), "base/posts#0", "base/posts#2"))
    lines = output.made["meshes/cart--base_posts_1.obj"].decode().splitlines()
    authored = [line for line in THREE.splitlines() if line.startswith("v ")][8:16]
    assert sorted(line for line in lines if line.startswith("v ")) == sorted(authored)
    assert sum(line.startswith("f ") for line in lines) == 12
    assert 'name = "posts#1"' in output.main.decode()


@pytest.mark.parametrize(
    "shape", [Box(TURNED, np.array(HALF)), Sphere(TURNED, 0.3), Cylinder(TURNED, 0.2, 0.4)], ids=lambda s: s.kind
)
@pytest.mark.parametrize("parent", ["base/posts#2", "wheel/tyre", "base/geom0"])
def test_a_native_shape_is_written_as_such_and_inherits_from_one(shape: Shape, parent: str, tmp_path: Path) -> None:
    asset = read(sample(tmp_path))
    kept = without(asset, parent)
    edited = kept.with_geoms([*kept.geoms, made(asset, parent, shape)])
    output = write(edited)
    again = rewritten(edited, tmp_path)
    new = next(g for g in again.geoms if g.name == f"{parent}~1")
    assert new.body == parent.split("/")[0]
    assert new.shape.kind == shape.kind and f"<{shape.kind} " in output.main.decode()
    np.testing.assert_allclose(new.shape.vertices, shape.vertices, atol=1e-12)
    assert len(output.made) == (2 if "posts" in parent else 0)
    assert output.main.count(b'drake:acceptable="yes"') == (3 if "posts" in parent else 1)


@pytest.mark.parametrize(
    "shape",
    [Capsule(TURNED, 0.1, 0.2), Ellipsoid(TURNED, np.array(HALF)), Box(TURNED, np.array(HALF)).tessellate()],
    ids=lambda s: s.kind,
)
def test_other_shapes_become_hulls_in_own_files_noted_unless_they_are_hulls(shape: Shape, tmp_path: Path) -> None:
    asset = read(sample(tmp_path))
    edited = asset.with_geoms([*asset.geoms, made(asset, "base/posts#2", shape), made(asset, "wheel/tyre", shape, 7)])
    output = write(edited)
    assert list(output.made) == ["meshes/cart--base_posts_2_1.obj", "meshes/cart--wheel_tyre_7.obj"]
    count = len(shape.vertices)
    why = CAPSULE_READERS if isinstance(shape, Capsule) else f"URDF has no {shape.kind}"
    expected = () if isinstance(shape, Polytope) else (
        f"{why}: 'base/posts#2~1' is written as a hull of {count} vertices",
        f"{why}: 'wheel/tyre~7' is written as a hull of {count} vertices",
    )  # fmt: skip
    assert output.notes == expected
    for geom in rewritten(edited, tmp_path).geoms:
        if "~" in geom.name:
            np.testing.assert_allclose(geom.shape.aabb.min, shape.tessellate().aabb.min, atol=1e-12)
            assert geom.shape.volume == pytest.approx(shape.tessellate().volume)


def test_a_made_hull_of_a_mesh_is_in_metres_and_keeps_what_the_mesh_element_says(tmp_path: Path) -> None:
    mesh = '<mesh scale="2 2 2" filename="meshes/three.obj"><drake:declare_convex/></mesh>'
    asset = read(sample(tmp_path, robot(link(mesh))))
    hull = Box.of_bounds(Aabb((0, 0, 0), (1, 1, 1))).tessellate()
    text = write(asset.with_geoms([made(asset, "a/geom0#1", hull)])).main.decode()
    assert (
        '<collision name="geom0#1~1"><origin xyz="0 0 0" rpy="0 0 0"/><geometry>'
        '<mesh filename="meshes/cart--a_geom0_1_1.obj"><drake:declare_convex/></mesh></geometry></collision>\n</link>'
    ) in text


@pytest.mark.parametrize(
    ("written", "expected"),
    [
        ('  <link name="a"/>', '  <link name="a">\n    NEW\n  </link>'),
        ('  <link name="a"></link>', '  <link name="a">\n    NEW\n  </link>'),
        ('  <link name="a">\n  </link>', '  <link name="a">\n    NEW\n  </link>'),
        ('  <link name="a"><!-- x --></link>', '  <link name="a"><!-- x -->\n    NEW\n  </link>'),
        ('  <link name="a">\n      <visual/>\n  </link>', '  <link name="a">\n      <visual/>\n      NEW\n  </link>'),
        ('<link name="a"><visual/></link>', '<link name="a"><visual/>NEW</link>'),
    ],
)
def test_a_hull_on_a_link_without_collisions_is_added_at_its_end(written: str, expected: str, tmp_path: Path) -> None:
    asset = read(sample(tmp_path, robot(written)))
    new = Geom("a/box~1", "a", Box(Pose.identity(), np.array([1, 1, 1])), None)
    text = write(asset.with_geoms([new])).main.decode()
    start, end = text.index("<collision"), text.index("</collision>") + len("</collision>")
    assert text[:start] + "NEW" + text[end:] == robot(expected)
    assert [g.name for g in rewritten(asset.with_geoms([new]), tmp_path).geoms] == ["a/box~1"]


def test_a_hull_on_an_unknown_link_is_refused_with_the_nearest_one(tmp_path: Path) -> None:
    asset = read(sample(tmp_path))
    with pytest.raises(AssetError, match=r"(?s)hull 'w/x~1' is on link 'whel', which is not there.*'wheel'"):
        write(asset.with_geoms([Geom("w/x~1", "whel", Sphere(TURNED, 1), None)]))


def test_opaque_pieces_stay_and_go_only_when_they_are_replaced(tmp_path: Path) -> None:
    path = sample(tmp_path, robot(link('<mesh filename="meshes/mixed.obj"/>', '<mesh filename="meshes/corner.obj"/>')))
    (tmp_path / "meshes" / "corner.obj").write_text(corner_obj())
    moved = "\n".join(f"v {x} {y} {z}" for x, y, z in [(9, 0, 0), (10, 0, 0), (9, 1, 0), (9, 0, 1)])
    faces = "\nf 13 15 14\nf 13 14 16\nf 13 16 15\nf 14 15 16\n"
    (tmp_path / "meshes" / "mixed.obj").write_text(corner_obj() + moved + faces)
    asset = read(path)
    assert [o.name for o in asset.non_convex] == ["a/geom0#0", "a/geom1"]
    assert [g.name for g in asset.geoms] == ["a/geom0#1"]

    emptied = rewritten(asset.with_geoms([]), tmp_path)
    assert [o.name for o in emptied.non_convex] == ["a/geom0#0", "a/geom1"] and not emptied.geoms

    box = Geom("a/geom1~1", "a", Box(TURNED, np.array(HALF)), "a/geom1")
    prepared = dataclasses.replace(asset.with_geoms([*asset.geoms, box]), non_convex=asset.non_convex[:1])
    again = rewritten(prepared, tmp_path / "b")
    assert [o.name for o in again.non_convex] == ["a/geom0#0"]
    assert [g.name for g in again.geoms] == ["a/geom0#1", "a/geom1~1"]
    assert "meshes/corner.obj" not in write(prepared).copies


def test_a_flat_piece_that_stays_behind_alone_is_noted(tmp_path: Path) -> None:
    path = sample(tmp_path, robot(link('<mesh filename="meshes/three.obj"/>')))
    flat = "v 5 0 2\nv 6 0 2\nv 5 1 2\nf 25 26 27\n"
    (tmp_path / "meshes" / "three.obj").write_text(THREE + flat)
    asset = read(path)
    assert write(asset).notes == ()
    edited = without(asset, "a/geom0#0")
    expected = "flat piece 'a/geom0#3' stays, now in a file of its own, which MuJoCo refuses"
    assert write(edited).notes == (expected,)
    again = rewritten(edited, tmp_path)
    assert [o.name for o in again.non_convex] == ["a/geom0#3"]


def test_names_and_file_names_with_odd_letters_are_escaped(tmp_path: Path) -> None:
    mesh = "<geometry><mesh filename='meshes/three.obj'/></geometry>"
    odd = f"<collision name='&lt;a &amp; \"b\"&gt; é&#10;'>{mesh}</collision>"
    asset = read(sample(tmp_path, robot(f"<link name='l&apos;é'>{odd}</link>")))
    edited = without(asset, asset.geoms[0].name)
    output = write(edited, "my cart.urdf")
    assert list(output.made) == ["meshes/my_cart--l_a_b_1.obj", "meshes/my_cart--l_a_b_2.obj"]
    assert [g.name for g in rewritten(edited, tmp_path).geoms] == [g.name for g in edited.geoms]


@pytest.mark.parametrize("encoding", ["utf-8", "latin-1", "utf-16"])
def test_an_edit_keeps_encoding_and_line_ends(encoding: str, tmp_path: Path) -> None:
    head = f'<?xml version="1.0" encoding="{encoding}"?>\r\n<!-- 90° -->\r\n'
    body = robot(link('<sphere radius="1"/>', '<box size="1 1 1"/>')).replace("\n", "\r\n")
    path = tmp_path / "cart.urdf"
    path.write_bytes((head + body).encode(encoding))
    asset = read(path)
    sphere = made(asset, "a/geom0", Sphere(Pose.identity(), 2))
    text = write(asset.with_geoms([*asset.geoms, sphere])).main.decode(encoding)
    assert text.startswith(head)
    assert text.count("\r\n") == text.count("\n")
    assert '<sphere radius="2"/>' in text


def test_made_files_take_no_name_that_is_in_use(tmp_path: Path) -> None:
    asset = read(sample(tmp_path))
    (tmp_path / "meshes" / "CART--base_posts_0.STL").write_text("")
    (tmp_path / "cart--base_posts_2.obj").write_text("")
    made_files = list(write(without(asset, "base/posts#1")).made)
    assert made_files == ["meshes/cart--base_posts_0_2.obj", "meshes/cart--base_posts_2_2.obj"]


@pytest.mark.parametrize(
    ("reference", "place"),
    [
        ("package://meshes/three.obj", "meshes/cart--a_geom0_1.obj"),
        ("./meshes/three.obj", "meshes/cart--a_geom0_1.obj"),
        ("meshes\\three.obj", "meshes/cart--a_geom0_1.obj"),
        ("../{folder}/meshes/three.obj", "cart--a_geom0_1.obj"),
        ("{path}/meshes/three.obj", "cart--a_geom0_1.obj"),
    ],
)
def test_made_files_lie_beside_the_mesh_they_replace_never_outside(reference: str, place: str, tmp_path: Path) -> None:
    mesh = f'<mesh filename="{reference.format(folder=tmp_path.name, path=tmp_path)}"/>'
    asset = read(sample(tmp_path, robot(link(mesh))))
    output = write(without(asset, "a/geom0#0", "a/geom0#2"))
    assert list(output.made) == [place]
    put(output, tmp_path / "out" / "cart.urdf")
    assert [g.name for g in read(tmp_path / "out" / "cart.urdf").geoms] == ["a/geom0#1"]


def test_a_mesh_that_changed_since_it_was_read_is_noticed(tmp_path: Path) -> None:
    asset = read(sample(tmp_path))
    (tmp_path / "meshes" / "three.obj").write_text(THREE + "\n")
    with pytest.raises(AssetError, match=r"has changed since the asset was read"):
        write(without(asset, "base/posts#1"))
    assert write(without(asset, "base/geom0")).made == {}


def test_a_mesh_that_nothing_refers_to_any_more_is_not_copied(tmp_path: Path) -> None:
    asset = read(sample(tmp_path, robot(link('<mesh filename="meshes/three.obj"/>'))))
    assert write(asset.with_geoms([])).copies == {}
    assert write(without(asset, "a/geom0#0")).copies == {}
