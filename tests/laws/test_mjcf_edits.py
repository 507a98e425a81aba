"""Any edit of any small MJCF: MuJoCo finds the edited geoms as the edit says, and all else as it was, bit for bit."""

import tempfile
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.symbolic import Asset, Geom
from tests.mjcf_engines import TETRAHEDRON, model, put, read
from tests.mjcf_models import Pair, compiled, hull, replaced, write
from tests.strategies import shapes

KINDS = ("box", "sphere", "capsule", "cylinder", "ellipsoid", "mesh")
TURNS = ("", 'quat="1 2 -3 4"', 'euler="10 -20 30"', 'axisangle="1 2 3 40"', 'xyaxes="0 1 0 -1 0 1"', 'zaxis="1 -2 3"')
SETTINGS = ("", 'angle="radian"', 'eulerseq="zyx"', 'inertiafromgeom="true"', 'settotalmass="5"', 'alignfree="true"')
MASSES = ("", 'density="20"', 'mass=".5"', 'mass="0"')
CONTACTS = ("", 'condim="4" friction=".5 .1 .1"', 'group="3" priority="1"', 'class="plain"', 'class="turned"')
CLASSES = (
    '<default><geom solref=".05 .9"/><default class="plain"><geom type="box" size=".3 .2 .1" margin=".01"/></default>'
    '<default class="turned"><geom euler="10 20 30" pos=".1 .2 .3" conaffinity="2"/></default></default>'
)


@st.composite
def geoms(draw: st.DrawFn) -> str:
    """A geom of any kind, perhaps in a frame; what its class says of it is overruled or not."""
    kind = draw(st.sampled_from(KINDS))
    shape = 'type="mesh" mesh="m"' if kind == "mesh" else f'type="{kind}" size=".1 .2 .3"'
    said = [shape, *(draw(st.sampled_from(choices)) for choices in (TURNS, MASSES, CONTACTS))]
    place = 'pos=".1 -.2 .3"' if draw(st.booleans()) else ""
    text = f"<geom {' '.join(said)} {place}/>"
    frame = draw(st.sampled_from(("", *TURNS[1:])))
    return f'<frame pos=".4 .5 -.6" {frame}>{text}</frame>' if frame and draw(st.booleans()) else text


@st.composite
def bodies(draw: st.DrawFn, depth: int = 0) -> str:
    """A body with up to four geoms, joints and bodies of its own."""
    joint = draw(st.sampled_from(("", "<joint/>", "<freejoint/>" if not depth else '<joint type="slide"/>')))
    childclass = draw(st.sampled_from(("", 'childclass="plain"', 'childclass="turned"')))
    inside = "".join(draw(st.lists(geoms(), min_size=1, max_size=4)))
    inertial = '<inertial pos="0 .1 0" mass="2" diaginertia=".2 .3 .4"/>' if draw(st.booleans()) else ""
    weight = '<geom size=".2" mass="1" contype="0" conaffinity="0"/>'  # every body that moves has a mass, hulls or not
    nested = draw(bodies(depth + 1)) if depth < 2 and draw(st.booleans()) else ""
    said = f'pos="1 0 .5" {draw(st.sampled_from(TURNS))} {childclass}'
    return f"<body {said}>{joint}{inertial}{weight}{inside}{nested}</body>"


@st.composite
def models(draw: st.DrawFn) -> str:
    setting = draw(st.sampled_from(SETTINGS))
    before = f'<compiler {setting}/><asset><mesh name="m" vertex="{TETRAHEDRON}" scale=".1 .1 .1"/></asset>{CLASSES}'
    return model("".join(draw(st.lists(bodies(), min_size=1, max_size=3))), before)


@st.composite
def edits(draw: st.DrawFn, asset: Asset) -> tuple[list[str], list[Geom]]:
    """Hulls to remove, some of them for made ones; and some that are only added."""
    names = [geom.name for geom in asset.geoms]
    gone = draw(st.lists(st.sampled_from(names), unique=True, max_size=4))
    parents = [name for name in gone if draw(st.booleans())]
    parents += [name for name in draw(st.lists(st.sampled_from(names), unique=True, max_size=2)) if name not in parents]
    return gone, [hull(asset, parent, draw(shapes)) for parent in sorted(parents, key=names.index)]


@pytest.mark.slow
@given(st.data())
def test_an_edit_changes_what_it_says_and_nothing_else(data: st.DataObject) -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        asset = read(put(folder / "in", {"main.xml": data.draw(models())}))
        gone, made = data.draw(edits(asset))
        mass = data.draw(st.sampled_from(("keep", "recompute")))
        path, output = write(replaced(asset, gone, *made), folder / "out", "keep" if mass == "keep" else "recompute")
        assert not output.names
        pair = Pair(compiled(asset.path), compiled(path))
        again = {geom.name: geom.shape for geom in read(path).geoms}
        assert set(again) == {geom.name for geom in asset.geoms} - set(gone) | {geom.name for geom in made}
        if mass == "keep":
            pair.assert_same(removed=gone, made=made)
        for geom in made:
            near = 2e-6 * (1 + float(np.abs(geom.shape.aabb.max).max() + np.abs(geom.shape.aabb.min).max()))
            np.testing.assert_allclose(again[geom.name].aabb.min, geom.shape.aabb.min, atol=near)
            np.testing.assert_allclose(again[geom.name].aabb.max, geom.shape.aabb.max, atol=near)
