"""Laws of the URDF writer, over random edits of random files."""

import re
import tempfile
from pathlib import Path

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from meshforge.formats.xml import Splice, apply_splices, parse_xml
from meshforge.geometry import Box, Capsule, Cylinder, Ellipsoid, Polytope, Pose, Shape, Sphere
from meshforge.symbolic import Asset, Geom
from tests.examples import examples
from tests.urdf_sample import put, read, robot, sample, write

GEOMETRY = st.sampled_from(
    ['<box size="1 2 3"/>', '<sphere radius="1"/>', '<plane normal="0 0 1"/>', '<mesh filename="meshes/three.obj"/>',
     "<mesh scale='-1 .1 2' filename='meshes/three.obj'/>"]
)  # fmt: skip
BETWEEN = st.sampled_from(["", "\n", "\n    ", "\n  <!-- <collision> -->\n  ", "<visual/>", "<contact/>\r\n"])
NAME = st.sampled_from(["", ' name="x"', " name='geom1'", ' name="x#0"', ' group="3"', ' name=""', '\n name = "é"'])
ORIGIN = st.sampled_from(
    ["", "<origin/>", '<origin xyz="1 2 3" rpy="0.1 0.2 1.5707963"/>\n', '<!-- o --><origin xyz="0 0 1"/>']
)
NUMBER = st.floats(0.01, 3)
ANGLE = st.floats(-4, 4)


@st.composite
def urdf_text(draw: st.DrawFn) -> str:
    links, joints = [], []
    for k in range(draw(st.integers(1, 3))):
        inside = draw(BETWEEN)
        for _ in range(draw(st.integers(0, 4))):
            body = draw(ORIGIN) + f"<geometry>{draw(GEOMETRY)}</geometry>{draw(st.sampled_from(['', '<material/>']))}"
            inside += f"<collision{draw(NAME)}>{body}</collision>" + draw(BETWEEN)
        links.append(f'<link name="l{k}">{inside}</link>')
        if k:
            origin = f'<origin xyz="0 {k} 0.5" rpy="{k} 0 0.3"/>'
            joints.append(
                f'<joint name="j{k}" type="fixed"><parent link="l{k - 1}"/><child link="l{k}"/>{origin}</joint>'
            )
    return robot(*draw(st.permutations(links + joints)))


@st.composite
def shape(draw: st.DrawFn) -> Shape:
    pose = Pose.from_rpy(draw(st.tuples(NUMBER, NUMBER, NUMBER)), draw(st.tuples(ANGLE, ANGLE, ANGLE)))
    sizes = np.array(draw(st.tuples(NUMBER, NUMBER, NUMBER)))
    a, b = float(sizes[0]), float(sizes[1])
    kinds = [Box(pose, sizes), Sphere(pose, a), Cylinder(pose, a, b), Capsule(pose, a, b), Ellipsoid(pose, sizes)]
    return draw(st.sampled_from([*kinds, kinds[0].tessellate()]))


@st.composite
def edited(draw: st.DrawFn, asset: Asset) -> Asset:
    geoms = [g for g in asset.geoms if draw(st.booleans())]
    for k, body in enumerate(draw(st.lists(st.sampled_from(asset.bodies), max_size=3))):
        own = [g.name for g in asset.geoms if g.body == body.name]
        parent = draw(st.sampled_from(own)) if own else None
        geoms.append(Geom(f"{parent or body.name + '/new'}~{k + 1}", body.name, draw(shape()), parent))
    return asset.with_geoms(geoms)


def _outside(data: bytes) -> bytes:
    """The text without collision elements and blanks."""
    links = list(parse_xml(data, "x").each("link"))
    cut = apply_splices(data, [Splice(c.start, c.end, b"") for link in links for c in link.each("collision")])
    return re.sub(rb"\s+", b"", cut)


@examples(80)
@given(st.data())
def test_an_edit_reads_back_as_it_was_meant_and_changes_only_collisions(data: st.DataObject) -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        asset = read(sample(folder, data.draw(urdf_text())))
        assert write(asset).main == (folder / "cart.urdf").read_bytes()
        edit = data.draw(edited(asset))
        output = write(edit)
        again = read(put(output, folder / "out" / "cart.urdf"))
        assert _outside(output.main) == _outside((folder / "cart.urdf").read_bytes())
    wanted = {output.names.get(g.name, g.name): g for g in edit.geoms}
    found = {g.name: g for g in again.geoms}
    assert wanted.keys() == found.keys() and len(found) == len(edit.geoms)
    for key, geom in wanted.items():
        _same(geom, found[key])
    assert len(again.non_convex) == len(edit.non_convex)


def _same(wanted: Geom, found: Geom) -> None:
    plain = isinstance(wanted.shape, Box | Sphere | Cylinder | Polytope)
    shape = wanted.shape if plain else wanted.shape.tessellate()
    assert found.body == wanted.body and found.shape.kind == shape.kind
    np.testing.assert_allclose(found.shape.aabb.min, shape.aabb.min, atol=1e-9)
    np.testing.assert_allclose(found.shape.aabb.max, shape.aabb.max, atol=1e-9)
    np.testing.assert_allclose(found.shape.volume, shape.volume, rtol=1e-9)
