"""Laws of editing USD: whatever the stage and the edit, the hulls are those asked for, and all else is as it was."""

import re
import tempfile
from pathlib import Path

import numpy as np
from hypothesis import assume, given
from hypothesis import strategies as st

from meshforge.common import AssetError
from meshforge.formats import SaveResult, read, save
from meshforge.geometry import Box, Capsule, Pose, Shape, Sphere, convex_hull
from meshforge.symbolic import Asset, Geom
from tests.examples import examples
from tests.soups import angle
from tests.usd_stages import COLLIDES, CONVEX, mesh, specs, stage, written

TURNED = Pose.from_rpy([1, 2, 3], [0.3, 0.2, 0.1])
SHAPES: tuple[Shape, ...] = (
    Box(TURNED, np.array([1.0, 2, 3])),
    Sphere(TURNED, 2.0),
    Capsule(TURNED, 1.0, 2.0),
    convex_hull(angle()[0]),
)
NUMBERS = st.sampled_from([-2.0, -1.0, 0.5, 1.0, 3.0])


@st.composite
def stages(draw: st.DrawFn) -> str:
    """A stage of two to five prims in a random tree of bodies and groups, each moved, turned and scaled."""
    count = draw(st.integers(2, 5))
    parents = [draw(st.integers(-1, k - 1)) for k in range(count)]
    bodies = [draw(st.booleans()) for _ in range(count)]

    def group(k: int) -> str:
        below = "".join(group(n) for n in range(count) if parents[n] == k)
        own = "".join(collider(draw, f"hull{k}_{n}") for n in range(draw(st.integers(0, 2))))
        rigid = '(\n prepend apiSchemas = ["PhysicsRigidBodyAPI"]\n)' if bodies[k] and parents[k] < 0 else ""
        return f'# group {k}\ndef Xform "group{k}" {rigid}\n{{\n{placed(draw)}\n{own}\n{below}\n}}\n'

    roots = "".join(group(k) for k in range(count) if parents[k] < 0)
    how = {"metres": draw(st.sampled_from([1.0, 0.01])), "up": draw(st.sampled_from(["Y", "Z"]))}
    return stage(f'def Xform "World"\n{{\n{roots}\n{collider(draw, "always")}\n}}\n', **how)  # type: ignore[arg-type]


def placed(draw: st.DrawFn) -> str:
    """Attributes that move a prim."""
    if draw(st.booleans()):
        return ""
    at, turn, scale = ([draw(NUMBERS) for _ in range(3)] for _ in range(3))
    even = [scale[0]] * 3 if draw(st.booleans()) else scale
    return (
        f"double3 xformOp:translate = {tuple(at)}\n"
        f"float3 xformOp:rotateXYZ = {tuple(30 * angle for angle in turn)}\n"
        f"float3 xformOp:scale = {tuple(even)}\n"
        'uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ", "xformOp:scale"]\n'
    )


def collider(draw: st.DrawFn, name: str) -> str:
    """A prim that collides, of a kind of its own, hidden or seen."""
    hidden = 'uniform token purpose = "guide"\n' if draw(st.booleans()) else ""
    more = f"{hidden}{placed(draw)}custom int mine = {draw(st.integers(0, 9))}  # a number\n"
    if draw(st.booleans()):
        return mesh(name, api=COLLIDES, more=f"{CONVEX}\n{more}")
    kind = draw(st.sampled_from(["Cube", "Sphere", "Capsule", "Cylinder"]))
    return f'def {kind} "{name}" ( prepend apiSchemas = ["PhysicsCollisionAPI"] )\n{{\n{more}}}\n'


def edited(draw: st.DataObject, asset: Asset) -> Asset:
    """Some hulls gone, some of them with others in their stead."""
    geoms: list[Geom] = []
    for geom in asset.geoms:
        how = draw.draw(st.sampled_from(["keep", "remove", "replace", "add"]))
        geoms += [geom] if how in ("keep", "add") else []
        if how in ("replace", "add"):
            geoms.append(Geom(f"{geom.name}~1", geom.body, draw.draw(st.sampled_from(SHAPES)), parent=geom.name))
    return asset.with_geoms(geoms)


@examples(50)
@given(text=stages(), data=st.data())
def test_an_edit_changes_what_it_says_and_nothing_else(text: str, data: st.DataObject) -> None:
    with tempfile.TemporaryDirectory() as folder:
        path = written(Path(folder), text)
        asset = read(path)
        wanted = edited(data, asset)
        assume(wanted.geoms)
        saved = save(wanted, Path(folder, "out", "a.usda"))
        has_hulls(saved, wanted)
        unchanged(path, saved.path, asset, wanted)


@examples(50)
@given(text=stages(), data=st.data())
def test_hulls_beside_an_unmarked_stage_read_back_and_the_stage_is_as_it_was(text: str, data: st.DataObject) -> None:
    bare = re.sub(r"\(\s*prepend apiSchemas = \[.*?\]\s*\)", "", text).replace('"guide"', '"proxy"')
    bare = bare.replace(CONVEX, "")
    with tempfile.TemporaryDirectory() as folder:
        path = written(Path(folder), bare)
        try:
            asset = read(path)
        except AssetError:
            assume(False)
        wanted = edited(data, asset)
        assume(wanted.geoms)
        saved = save(wanted, Path(folder, "out", "a.usda"), collision="beside")
        has_hulls(saved, wanted)
        assert saved.names == {}
        old, new = specs(path), specs(saved.path)
        assert {at: new.get(at) for at in old} == old
        again = save(read(saved.path), Path(folder, "again", "a.usda"), collision="beside")
        assert again.path.read_bytes() == saved.path.read_bytes()


def has_hulls(saved: SaveResult, wanted: Asset) -> None:
    """What was written reads back as the hulls that it was to hold, each in its place."""
    after = {geom.name: geom for geom in read(saved.path).geoms}
    assert len(after) == len(wanted.geoms)
    for geom in wanted.geoms:
        made = after[saved.names.get(geom.name, geom.name)]
        assert made.body == geom.body
        size = float(np.abs([geom.shape.aabb.min, geom.shape.aabb.max]).max())
        same = geom.shape if made.shape.kind == geom.shape.kind else geom.shape.tessellate()
        assert np.allclose(made.shape.aabb.min, same.aabb.min, atol=1e-5 * size)
        assert np.allclose(made.shape.aabb.max, same.aabb.max, atol=1e-5 * size)


def unchanged(before: Path, after: Path, asset: Asset, wanted: Asset) -> None:
    """Every spec of a prim that the edit does not touch says what it said."""
    old, new = specs(before), specs(after)
    kept = {geom.name for geom in wanted.geoms}
    gone = tuple(f"/{geom.name.rsplit('/', 1)[-1]}" for geom in asset.geoms if geom.name not in kept)
    for path, said in old.items():
        if not any(f"{name}." in path or path.endswith(name) for name in gone):
            assert path in new
            assert new[path] == said or "apiSchemas" in new[path]
