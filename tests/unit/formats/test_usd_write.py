"""Edited USD stages: what the edit says is in the file, and all else of its layers is as it was."""

import io
import zipfile
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from pxr import Sdf

from meshforge.common import AssetError
from meshforge.formats import SaveResult, read, save
from meshforge.geometry import Box, Cylinder, Ellipsoid, Pose, Shape, inertia
from meshforge.symbolic import Asset, Geom
from tests.usd_stages import COLLIDES, CUP, mesh, physics_shapes, specs, stage, table, written

SIDE, HANDLE, BOTTOM, BOTH = "Cup/collisions/side", "Cup/collisions/handle", "Cup/collisions/bottom", "Cup/both"
CAN = Cylinder(Pose.from_rpy([0.01, 0.02, 0.1], [0.3, 0.2, 0.1]), 0.02, 0.03)
KINDS = (".usda", ".usdc", ".usd", ".usdz")


def edited(
    asset: Asset, out: Path, without: Sequence[str] = (), made: Sequence[Shape] = (), like: str = SIDE
) -> SaveResult:
    """The asset written without some hulls, and with made ones that stem from another."""
    geoms = [geom for geom in asset.geoms if geom.name not in without]
    body = next((geom.body for geom in asset.geoms if geom.name == like), "")
    geoms += [Geom(f"{like}~{k + 1}", body, shape, parent=like) for k, shape in enumerate(made)]
    return save(asset.with_geoms(geoms), out, collision="replace")


@pytest.mark.parametrize("suffix", KINDS)
def test_unedited_the_same_bytes_with_all_files(tmp_path: Path, suffix: str) -> None:
    cup = save(read(written(tmp_path, CUP)), tmp_path / f"cup{suffix}").path
    assert save(read(cup), tmp_path / "out" / f"cup{suffix}").path.read_bytes() == cup.read_bytes()
    out = save(read(table(tmp_path)), tmp_path / "out" / "table.usda")
    assert {path.relative_to(tmp_path / "out").as_posix() for path in out.files} == {"parts/leg.usda", "table.usda"}


@pytest.mark.parametrize("suffix", KINDS)
def test_an_edit_reads_back_in_every_kind_of_file_the_same_each_time(tmp_path: Path, suffix: str) -> None:
    cup = save(read(written(tmp_path, CUP)), tmp_path / f"cup{suffix}").path
    outs = [edited(read(cup), tmp_path / str(k) / f"cup{suffix}", [HANDLE], [CAN]) for k in range(2)]
    assert outs[0].path.read_bytes() == outs[1].path.read_bytes()
    after = {geom.name: geom.shape for geom in read(outs[0].path).geoms}
    assert list(after) == [SIDE, BOTTOM, f"{SIDE}_1", BOTH]
    made = after[outs[0].names[f"{SIDE}~1"]]
    assert isinstance(made, Cylinder) and np.allclose([made.radius, made.half_length], [0.02, 0.03])
    assert np.allclose(made.pose.rotation, CAN.pose.rotation) and np.allclose(made.pose.translation, [0.01, 0.02, 0.1])


def test_an_edited_text_is_as_the_library_writes_it_and_its_lost_comments_are_told(tmp_path: Path) -> None:
    path = tmp_path / "a.usda"
    for end in ("\n", "\r\n"):
        path.write_bytes(CUP.replace("\n", end).encode())
        out = edited(read(path), tmp_path / "out" / "a.usda", [HANDLE], [CAN])
        text = out.path.read_text()
        layer = Sdf.Layer.CreateAnonymous(".usda")
        assert layer.ImportFromString(text) and layer.ExportToString() == text
        assert "# in centimetres" not in text
        assert "comments in its text are lost, if there are any: USD's library writes an edited layer anew" in out.notes


def test_layer_by_layer_only_the_edit_differs(tmp_path: Path) -> None:
    path = written(tmp_path, CUP)
    saved = edited(read(path), tmp_path / "out" / "a.usda", [HANDLE, BOTH], [CAN])
    assert "1 prim stays, to be seen, and no longer collide" in saved.notes
    before, after = specs(path), specs(saved.path)
    gone = {name for name in before if name not in after}
    handle, both = "/World/Cup/collisions/handle", "/World/Cup/both"
    assert all(name.startswith(handle) or name == f"{both}.physics:approximation" for name in gone)
    assert {name for name in before.keys() & after.keys() if before[name] != after[name]} == {
        "/World/Cup",  # has a mass now
        both,  # is no collider any more
        "/World/Group.collection:colliders:includes",
    }
    made = {name for name in after if name not in before}
    assert all(name.startswith(("/World/Cup.physics:", "/World/Cup/collisions/side_1")) for name in made)


def test_a_made_hull_inherits_contact_settings_and_groups_but_no_geometry(tmp_path: Path) -> None:
    before = read(written(tmp_path, CUP))
    out = edited(before, tmp_path / "out" / "a.usda", [SIDE], [CAN])
    made = next(geom for geom in read(out.path).geoms if geom.name.endswith("side_1"))
    assert made.contact == before.geoms[0].contact
    said = specs(out.path)
    assert "/World/Cup/collisions/side_1.mine" not in said and "/World/Cup/collisions/side_1.size" not in said
    assert "side_1" in said["/World/Group.collection:colliders:includes"]["targetPaths"]


@pytest.mark.parametrize("shared", [False, True])
@pytest.mark.parametrize("arc", ["references", "payload"])
def test_prims_of_other_layers_are_switched_off_in_the_root_layer(tmp_path: Path, shared: bool, arc: str) -> None:
    path = table(tmp_path, instanceable=shared, arc=arc)
    asset = read(path)
    upper = "leg1/collisions/upper"
    shape = next(geom.shape for geom in asset.geoms if geom.name == upper)
    out = edited(asset, tmp_path / "out" / "table.usda", [upper], [shape], like=upper)
    after = {geom.name: geom.shape for geom in read(out.path).geoms}
    assert sorted(after) == sorted([*(g.name for g in asset.geoms if g.name != upper), f"{upper}_1"])
    assert np.allclose(after[f"{upper}_1"].aabb.min, shape.aabb.min, atol=1e-6)
    assert (tmp_path / "out" / "parts" / "leg.usda").read_bytes() == (tmp_path / "parts" / "leg.usda").read_bytes()
    text = out.path.read_text()
    assert text.count("active = false") == 1 and text.count("instanceable = false") == shared
    assert any("active = false" in note for note in out.notes)


def test_shapes_in_a_mirrored_uneven_space_are_where_they_were_meant(tmp_path: Path) -> None:
    foot = "leg1/collisions/foot"
    straight = Box(Pose.of_translation([5, 0, 1]), np.array([0.1, 0.2, 0.3]))
    leaning = Box(Pose.from_rpy([5, 0, 3], [0.3, 0.2, 0.1]), np.array([0.1, 0.2, 0.3]))
    out = edited(read(table(tmp_path)), tmp_path / "out" / "table.usda", [foot], [straight, leaning], like=foot)
    after = {geom.name: geom.shape for geom in read(out.path).geoms}
    assert isinstance(after[f"{foot}_1"], Box) and after[f"{foot}_2"].kind == "polytope"
    for name, shape in ((f"{foot}_1", straight), (f"{foot}_2", leaning)):
        assert np.allclose(after[name].aabb.min, shape.aabb.min, atol=1e-6)
        assert np.isclose(after[name].volume, shape.volume, rtol=1e-5)
    told = physics_shapes(out.path)["/World/leg1/collisions/foot_1"]
    assert np.allclose(np.abs(told.halfExtents), straight.half)


def test_pieces_that_stay_of_a_parted_mesh_keep_their_place_and_the_mesh_is_seen_on(tmp_path: Path) -> None:
    two = """
    point3f[] points = [(0,0,0),(1,0,0),(0,1,0),(0,0,1),(5,0,0),(6,0,0),(5,1,0),(5,0,1)]
    int[] faceVertexCounts = [3,3,3,3,3,3,3,3]
    int[] faceVertexIndices = [0,2,1, 0,1,3, 1,2,3, 0,3,2, 4,6,5, 4,5,7, 5,6,7, 4,7,6]
    """
    path = written(tmp_path, stage(f'def Xform "World"\n{{\n{mesh("two", api=COLLIDES, points=two)}\n}}'))
    out = edited(read(path), tmp_path / "out" / "a.usda", ["two#0"])
    after = read(out.path)
    assert [geom.name for geom in after.geoms] == ["two_1"] == list(out.names.values())
    assert np.allclose(after.geoms[0].shape.aabb.min, [5, 0, 0]) and len(after.visuals) == 1


def test_in_a_stage_without_physics_meshes_come_and_go(tmp_path: Path) -> None:
    path = written(tmp_path, stage(f'def Xform "World"\n{{\n{mesh("a")}\n{mesh("b", more="")}\n}}'))
    out = edited(read(path), tmp_path / "out" / "a.usda", ["a"], [CAN], like="b")
    after = read(out.path)
    assert sorted(geom.name for geom in after.geoms) == ["b", "b_1"]
    text = out.path.read_text()
    assert (
        text.count('"PhysicsCollisionAPI"') == 2 and text.count("physics:approximation") == 1
    )  # a native one has none


def test_a_body_keeps_the_mass_that_its_colliders_had(tmp_path: Path) -> None:
    before = read(written(tmp_path, CUP))
    density = {geom.name: 2000.0 if geom.name == SIDE else 1000.0 for geom in before.geoms}
    mass = sum(geom.shape.volume * density[geom.name] for geom in before.geoms)
    (found,) = read(edited(before, tmp_path / "out" / "a.usda", [BOTTOM]).path).mechanism.inertials
    assert np.isclose(found.mass, mass, rtol=1e-6)
    weighed = [
        (inertia([g.shape], g.shape.volume * density[g.name]), g.shape.volume * density[g.name]) for g in before.geoms
    ]
    centre = sum((at * m for (at, _), m in weighed), np.zeros(3)) / mass
    assert np.allclose(found.centre, centre, atol=1e-6)
    about = sum(
        (
            own + m * ((at - centre) @ (at - centre) * np.eye(3) - np.outer(at - centre, at - centre))
            for (at, own), m in weighed
        ),
        np.zeros((3, 3)),
    )
    assert np.allclose(found.inertia, about, rtol=1e-4, atol=1e-9)


def test_the_mass_is_left_to_the_hulls_where_that_is_asked_for(tmp_path: Path) -> None:
    asset = read(written(tmp_path, CUP))
    saved = save(asset.with_geoms(asset.geoms[1:]), tmp_path / "out" / "a.usda", mass="recompute")
    assert "physics:mass" not in saved.path.read_text()


def test_an_ellipsoid_is_written_as_a_hull_and_told(tmp_path: Path) -> None:
    egg = Ellipsoid(Pose.of_translation([0, 0, 0.1]), np.array([0.01, 0.02, 0.03]))
    saved = edited(read(written(tmp_path, CUP)), tmp_path / "out" / "a.usda", [], [egg])
    assert "1 ellipsoid written as hull meshes: USD has no such shape here" in saved.notes


def test_a_collider_that_something_else_names_is_not_removed(tmp_path: Path) -> None:
    text = CUP.replace(
        'def Capsule "handle"',
        'def Cube "other" ( prepend apiSchemas = ["PhysicsFilteredPairsAPI"] )\n'
        '{\nrel physics:filteredPairs = </World/Cup/collisions/handle>\n}\ndef Capsule "handle"',
    )
    with pytest.raises(AssetError, match="filteredPairs refers to it"):
        edited(read(written(tmp_path, text)), tmp_path / "out" / "a.usda", [HANDLE])


def test_a_file_that_changed_since_is_noticed(tmp_path: Path) -> None:
    asset = read(table(tmp_path))
    leg = tmp_path / "parts" / "leg.usda"
    leg.write_text(leg.read_text().replace("0.5", "0.6"))
    with pytest.raises(AssetError, match=r"leg\.usda has changed"):
        edited(asset, tmp_path / "out" / "table.usda", ["leg0/collisions/foot"])


def test_a_package_keeps_its_other_files_and_their_alignment(tmp_path: Path) -> None:
    folder = tmp_path / "in"
    text = CUP.replace("double size = 2", "double size = 2\nasset picture = @./skin.png@", 1)
    written(folder, text)
    (folder / "skin.png").write_bytes(b"\x89PNG not really")
    package = save(read(folder / "a.usda"), tmp_path / "a.usdz").path
    with zipfile.ZipFile(package) as archive:
        assert archive.namelist() == ["a.usdc", "skin.png"]
    out = edited(read(package), tmp_path / "out" / "a.usdz", [HANDLE], [CAN]).path
    data = out.read_bytes()
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        assert archive.read("skin.png") == b"\x89PNG not really"
        for entry in archive.infolist():
            name, extra = (
                int.from_bytes(data[entry.header_offset + k : entry.header_offset + k + 2], "little") for k in (26, 28)
            )
            assert (entry.header_offset + 30 + name + extra) % 64 == 0 and entry.compress_type == 0
    flat = save(read(package), tmp_path / "flat" / "a.usda")
    assert (tmp_path / "flat" / "skin.png").is_file() and len(read(flat.path).geoms) == 4


def test_files_of_absolute_references_stay_where_they_are(tmp_path: Path) -> None:
    leg = table(tmp_path / "elsewhere").parent / "parts" / "leg.usda"
    path = table(tmp_path / "here")
    path.write_text(path.read_text().replace("@./parts/leg.usda@", f"@{leg}@"))
    out = save(read(path), tmp_path / "out" / "table.usda")
    assert out.files == (tmp_path / "out" / "table.usda",) and "absolute path" in out.notes[0]
