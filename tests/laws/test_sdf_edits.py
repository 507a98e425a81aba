"""Any edit of any small SDF: hulls read back as the edit says, and all bytes outside of collisions are as they were."""

import re
import tempfile
from pathlib import Path

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from meshforge.symbolic import Asset, Geom
from tests.sdf_sample import put_text, read, write
from tests.strategies import shapes
from tests.urdf_sample import THREE, put

SHAPES = (
    "<box><size>1 2 3</size></box>",
    "<box/>",
    "<sphere>\n<radius>0.5</radius>\n</sphere>",
    "<cylinder><radius> .5 </radius><length>1</length></cylinder>",
    "<cone/>",
    "<polyline><point>0 0</point><point>1 0</point>\n<point>0 1</point></polyline>",
    "<plane/>",
    "<mesh><uri>three.obj</uri></mesh>",
    "<mesh>\n  <uri>file://three.obj</uri>\n  <!-- small --><scale>.1 .1 -.1</scale>\n</mesh>",
)
VERSIONS = ("1.5", "1.7", "1.8", "1.11")
BASES = ("", "a", "f", "j", "__model__", "n::a", "n::__model__", "n::f")
BETWEEN = ("", "\n", "\n    ", "<!-- a <collision> of old -->")


@st.composite
def poses(draw: st.DrawFn, bases: tuple[str, ...]) -> str:
    if draw(st.booleans()):
        return ""
    base = draw(st.sampled_from(bases))
    attribute = f' relative_to="{base}"' if base else ""
    numbers = draw(st.lists(st.integers(-3, 3), min_size=6, max_size=6))
    return f"<pose{attribute}>{' '.join(map(str, numbers))}</pose>"


@st.composite
def links(draw: st.DrawFn, name: str, bases: tuple[str, ...]) -> str:
    """A link with up to three collisions; its own pose counts from frames that do not count from it."""
    parts = [draw(poses(("",)))]
    for k in range(draw(st.integers(0, 3))):
        more = draw(st.sampled_from(("", "<surface/>", "\n  <max_contacts>3</max_contacts>")))
        pose, shape = draw(poses(bases)), draw(st.sampled_from(SHAPES))
        parts.append(f'<collision name="c{k}">{pose}<geometry>{shape}</geometry>{more}</collision>')
        parts.append(draw(st.sampled_from(BETWEEN)))
    inside = "".join(parts)
    return f'<link name="{name}">{inside}</link>' if inside or draw(st.booleans()) else f'<link name="{name}"/>'


@st.composite
def models(draw: st.DrawFn, name: str, bases: tuple[str, ...], nested: bool) -> str:
    own = tuple(base for base in bases if nested or "::" not in base)
    inner = draw(models("n", bases, nested=False)) if nested else ""
    frame = f'<frame name="f" attached_to="a">{draw(poses(("", "a")))}</frame>'
    joint = '<joint name="j" type="fixed"><pose>1 2 3 0 0 1</pose><parent>a</parent><child>b</child></joint>'
    a, b = draw(links("a", own)), draw(links("b", own))
    return f'<model name="{name}">\n{draw(poses(("",)))}{inner}\n{a}\n{frame}{b}\n{joint}\n</model>'


@st.composite
def edits(draw: st.DrawFn, asset: Asset) -> Asset:
    """The asset without some hulls, and with some made ones."""
    names = [geom.name for geom in asset.geoms]
    gone = draw(st.lists(st.sampled_from(names), unique=True, max_size=4)) if names else []
    kept = [geom for geom in asset.geoms if geom.name not in gone]
    parents = draw(st.lists(st.sampled_from([*names, None]), max_size=3))
    bodies = {geom.name: geom.body for geom in asset.geoms}
    new = [
        Geom(
            f"{bodies[parent]}/new{k}" if parent else f"b/new{k}",
            bodies[parent] if parent else "b",
            draw(shapes),
            parent,
        )
        for k, parent in enumerate(parents)
    ]
    return asset.with_geoms([*kept, *new])


def outside(text: str) -> str:
    """A text without its collisions and the blanks around them."""
    bare = re.sub(r"<!--.*?-->", lambda found: found[0].replace("<", "["), text, flags=re.S)
    bare = re.sub(r"<collision.*?</collision>", "", bare, flags=re.S)
    bare = re.sub(r'<link name="(\w)"\s*/>', r'<link name="\1"></link>', bare)
    return re.sub(r"\s+", "", bare)


@given(st.data())
def test_an_edit_changes_what_it_says_and_nothing_else(data: st.DataObject) -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        version = data.draw(st.sampled_from(VERSIONS))
        bases = BASES if version >= "1.7" or version == "1.11" else ("",)
        text = f'<sdf version="{version}">\n{data.draw(models("m", bases, nested=True))}\n</sdf>\n'
        path = put_text(folder / "in", text)
        (folder / "in" / "three.obj").write_text(THREE)
        asset = read(path)
        assert write(asset).main.decode() == text
        edit = data.draw(edits(asset))
        output = write(edit)
        assert not output.names
        assert outside(output.main.decode()) == outside(text)
        again = read(put(output, folder / "out" / "model.sdf"))
        was, now = ({geom.name: geom for geom in one.geoms} for one in (edit, again))
        assert was.keys() == now.keys()
        assert [piece.name for piece in again.non_convex] == [piece.name for piece in edit.non_convex]
        for key, geom in was.items():
            native = geom.shape.kind == now[key].shape.kind
            box = (geom.shape if native else geom.shape.tessellate()).aabb
            slack = 1e-6 * (box.diagonal + float(np.abs(box.center).max()))
            np.testing.assert_allclose(now[key].shape.aabb.min, box.min, atol=slack, err_msg=key)
            np.testing.assert_allclose(now[key].shape.aabb.max, box.max, atol=slack, err_msg=key)
