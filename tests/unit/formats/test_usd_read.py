"""USD stages read: what collides, of which shape, where, and of which body."""

import pickle
from pathlib import Path

import numpy as np
import pytest

from meshforge.checks.physics.simulation import simulate
from meshforge.formats import read
from meshforge.geometry import Box, Capsule
from meshforge.symbolic import Asset, SymbolicMesh
from tests.usd_stages import COLLIDES, CONVEX, CUP, mesh, physics_shapes, stage, table, written

SCALED = "xformOp:scale = ({}, {}, {})\nuniform token[] xformOpOrder = ['xformOp:scale']"
L_SHAPE = """
    point3f[] points = [(0,0,0),(2,0,0),(2,1,0),(1,1,0),(1,2,0),(0,2,0),(0,0,1),(2,0,1),(2,1,1),(1,1,1),(1,2,1),(0,2,1)]
    int[] faceVertexCounts = [4,4,4,4,4,4,4,4,4,4]
    int[] faceVertexIndices = [0,3,2,1, 0,5,4,3, 6,7,8,9, 6,9,10,11, 0,1,7,6, 1,2,8,7, 2,3,9,8, 3,4,10,9, 4,5,11,10,
        5,0,6,11]
"""


def of(folder: Path, prims: str, **how: object) -> Asset:
    return read(written(folder, stage(f'def Xform "World"\n{{\n{prims}\n}}\n', **how)))  # type: ignore[arg-type]


def primitive(kind: str, attributes: str = "") -> str:
    return f'def {kind} "it" ( prepend apiSchemas = ["PhysicsCollisionAPI"] )\n{{\n{attributes}\n}}\n'


def test_hulls_are_named_by_their_path_below_their_body(tmp_path: Path) -> None:
    asset = read(written(tmp_path, CUP))
    names = ["Cup/collisions/side", "Cup/collisions/handle", "Cup/collisions/bottom", "Cup/both"]
    assert [geom.name for geom in asset.geoms] == names
    assert {geom.body for geom in asset.geoms} == {"Cup"} == {body.name for body in asset.bodies}


def test_units_of_the_stage_become_metres(tmp_path: Path) -> None:
    side, handle, *_ = (geom.shape for geom in read(written(tmp_path, CUP)).geoms)
    assert isinstance(side, Box) and np.allclose(side.half, [0.01, 0.02, 0.03])
    assert np.allclose(side.pose.translation, [0, 0, 0.1])
    assert isinstance(handle, Capsule) and np.allclose([handle.radius, handle.half_length], [0.005, 0.015])
    assert np.allclose(np.abs(handle.pose.rotation[:, 2]), [1, 0, 0])


@pytest.mark.parametrize("kind", ["Sphere", "Capsule", "Cylinder", "Cone"])
def test_round_shapes_that_are_scaled_unevenly_are_what_the_library_tells_engines(tmp_path: Path, kind: str) -> None:
    scaled = primitive(kind, f"double radius = 2\ndouble3 {SCALED.format(1, -2, 3)}")
    path = written(tmp_path, stage(f'def Xform "World"\n{{\n{scaled}\n}}'))
    asset = read(path)
    told = physics_shapes(path)["/World/it"]
    assert np.isclose(asset.geoms[0].shape.aabb.size[0], 2 * told.radius, rtol=1e-6)
    height = {"Sphere": told.radius, "Capsule": told.radius + getattr(told, "halfHeight", 0)}
    assert np.isclose(asset.geoms[0].shape.aabb.size[2], 2 * height.get(kind, getattr(told, "halfHeight", 0)))
    assert any("scaled unevenly" in note for note in asset.notes)


def test_planes_are_opaque_and_endless(tmp_path: Path) -> None:
    asset = of(tmp_path, primitive("Plane", 'uniform token axis = "Y"'))
    (plane,) = asset.non_convex
    assert plane.plane is not None and np.allclose(plane.plane.rotation[:, 2], [0, 1, 0])


@pytest.mark.parametrize(
    ("approximation", "hulls", "opaque"),
    [
        *(("convexHull", 1, 0), ("boundingCube", 1, 0), ("boundingSphere", 1, 0)),
        *(("none", 0, 1), ("convexDecomposition", 0, 1), ("meshSimplification", 0, 1), ("sdf", 0, 1)),
    ],
)
def test_an_approximation_is_one_shape_or_the_mesh(tmp_path: Path, approximation: str, hulls: int, opaque: int) -> None:
    said = f'uniform token physics:approximation = "{approximation}"'
    asset = of(tmp_path, mesh("angle", api=COLLIDES, more=said, points=L_SHAPE))
    assert (len(asset.geoms), len(asset.non_convex)) == (hulls, opaque)
    kinds = {"convexHull": "polytope", "boundingCube": "box", "boundingSphere": "sphere"}
    assert [geom.shape.kind for geom in asset.geoms] == [kinds[approximation] for _ in range(hulls)]
    assert all(piece.surface is not None for piece in asset.non_convex)


def test_a_mirrored_or_left_handed_mesh_is_a_hull_with_its_faces_outside(tmp_path: Path) -> None:
    left = mesh(
        "left", api=COLLIDES, more=f'uniform token orientation = "leftHanded"\ndouble3 {SCALED.format(-1, 2, 3)}'
    )
    (geom,) = of(tmp_path, left).geoms
    assert np.isclose(geom.shape.volume, 8 * 6) and np.allclose(geom.shape.aabb.max, [1, 2, 3])


def test_prims_of_references_and_of_instances_are_where_their_stage_has_them(tmp_path: Path) -> None:
    for shared in (False, True):
        for arc in ("references", "payload"):
            asset = read(table(tmp_path / f"{shared}{arc}", instanceable=shared, arc=arc))
            assert [geom.name for geom in asset.geoms][2:] == ["leg1/collisions/upper", "leg1/collisions/foot"]
            assert np.allclose(asset.geoms[2].shape.aabb.min, [4, -1, -2])
            assert [file.name for file in asset.files] == ["leg.usda"]


def test_what_is_switched_off_and_triggers_do_not_collide(tmp_path: Path) -> None:
    off = primitive("Cube", "bool physics:collisionEnabled = false").replace('"it"', '"off"')
    zone = (
        primitive("Cube")
        .replace('"it"', '"zone"')
        .replace("PhysicsCollisionAPI", 'PhysicsCollisionAPI", "PhysxTriggerAPI')
    )
    asset = of(tmp_path, off + zone + primitive("Cube"))
    assert [geom.name for geom in asset.geoms] == ["it"]
    assert any("switched off" in note for note in asset.notes) and any("trigger" in note for note in asset.notes)


def test_a_stage_without_physics_collides_with_all_that_is_seen(tmp_path: Path) -> None:
    hidden = mesh("hidden", more='uniform token purpose = "proxy"') + mesh(
        "gone", more='token visibility = "invisible"'
    )
    asset = of(tmp_path, mesh("seen") + hidden)
    assert [geom.name for geom in asset.geoms] == ["seen"] and not len(asset.visuals)
    assert "no prim is marked as collision" in asset.notes[0]


def test_what_point_instancers_show_is_not_read_and_that_is_said(tmp_path: Path) -> None:
    many = f"""def PointInstancer "many"
    {{
        rel prototypes = </World/many/one>
        int[] protoIndices = [0, 0, 0]
        point3f[] positions = [(0,0,0), (5,0,0), (0,5,0)]
        {mesh("one", api=COLLIDES, more=CONVEX)}
    }}"""
    asset = of(tmp_path, many + "\n" + mesh("two", api=COLLIDES, more=CONVEX))
    assert [geom.name for geom in asset.geoms] == ["two"] and not asset.non_convex
    assert "what is shown many times by 1 point instancer (many) is not read, and left as it is" in asset.notes


def test_visuals_are_what_renders_with_its_colour(tmp_path: Path) -> None:
    asset = read(written(tmp_path, CUP))
    assert [surface.rgba for surface in asset.visuals] == [(1.0, 0.0, 0.0, 1.0), None]
    assert len(pickle.loads(pickle.dumps(asset)).visuals) == 2


def test_preview_surfaces_tell_the_colour(tmp_path: Path) -> None:
    look = """def Material "Red" {
        token outputs:surface.connect = </World/Red/Shader.outputs:surface>
        def Shader "Shader" {
            uniform token info:id = "UsdPreviewSurface"
            color3f inputs:diffuseColor = (1, 0, 0)
            token outputs:surface
        }
    }""".replace("{", "{\n").replace("}", "\n}")
    bound = mesh("seen", api='"MaterialBindingAPI"', more="rel material:binding = </World/Red>")
    asset = of(tmp_path, primitive("Cube", 'uniform token purpose = "guide"') + bound + look)
    assert [surface.rgba for surface in asset.visuals] == [(1.0, 0.0, 0.0, 1.0)]


def test_semantic_labels_and_materials_are_mentioned(tmp_path: Path) -> None:
    labels = 'token[] semantics:labels:class = ["handle"]'
    asset = of(tmp_path, mesh("part_7", api=f'{COLLIDES}, "SemanticsLabelsAPI:class"', more=labels))
    assert ("label", "handle") in asset.geoms[0].mentions


def test_the_selected_variant_is_read(tmp_path: Path) -> None:
    chosen = f"""def Xform "V" (
        variants = {{ string size = "big" }}
        prepend variantSets = "size"
    )
    {{
        variantSet "size" = {{
            "big" {{ {mesh("big", api=COLLIDES, more=CONVEX)} }}
            "small" {{ {mesh("small", api=COLLIDES, more=CONVEX)} }}
        }}
    }}"""
    asset = of(tmp_path, chosen)
    assert [geom.name for geom in asset.geoms] == ["V/big"] and any("variants" in note for note in asset.notes)


def test_masses_are_those_of_the_schema_in_kilograms(tmp_path: Path) -> None:
    body = f"""def Xform "Body" ( prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"] )
    {{
        float physics:mass = 3
        float3 physics:diagonalInertia = (10000, 20000, 25000)
        point3f physics:centerOfMass = (50, 0, 0)
        {primitive("Cube")}
    }}"""
    (inertial,) = of(tmp_path, body, metres=0.01).mechanism.inertials
    assert inertial.mass == 3 and np.allclose(inertial.centre, [0.5, 0, 0])
    assert np.allclose(np.diag(inertial.inertia), [1, 2, 2.5])


def test_joints_have_limits_from_where_their_bodies_are(tmp_path: Path) -> None:
    bodies = "".join(
        f'def Xform "{name}" ( prepend apiSchemas = ["PhysicsRigidBodyAPI"] )\n{{\n{turn}\n{primitive("Cube")}}}\n'
        for name, turn in (
            ("frame", ""),
            ("door", 'double xformOp:rotateZ = 30\nuniform token[] xformOpOrder = ["xformOp:rotateZ"]'),
        )
    )
    hinge = """def PhysicsRevoluteJoint "hinge"
    {
        rel physics:body0 = </World/frame>
        rel physics:body1 = </World/door>
        uniform token physics:axis = "Z"
        float physics:lowerLimit = 0
        float physics:upperLimit = 90
    }"""
    (joint,) = of(tmp_path, bodies + hinge).mechanism.joints
    assert (joint.kind, joint.parent, joint.child) == ("revolute", "frame", "door")
    assert joint.limits is not None and np.allclose(np.degrees(joint.limits), [-30, 60], atol=1e-4)


def test_filtered_pairs_of_bodies_are_told_and_excluded_from_the_check(tmp_path: Path) -> None:
    filtered = """prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsFilteredPairsAPI"]"""
    pairs = "rel physics:filteredPairs = [</World/two>, </World/two/it>]"
    bodies = (
        f'def Xform "one" ( {filtered} )\n{{\n{pairs}\n{primitive("Cube")}}}\n'
        f'def Xform "two" ( prepend apiSchemas = ["PhysicsRigidBodyAPI"] )\n{{\n{primitive("Cube")}}}\n'
    )
    asset = of(tmp_path, bodies)
    assert asset.mechanism.apart == (("one", "two"),)
    assert [overlap.excluded for overlap in simulate(SymbolicMesh.of(asset)).overlaps] == [True]


def test_what_the_library_complains_of_is_a_note_not_printed(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    asset = of(tmp_path, 'def "gone" ( references = @./nope.usda@ )\n{\n}\n' + primitive("Cube"))
    assert any("nope.usda" in note for note in asset.notes) and asset.missing == ("nope.usda",)
    assert not any(str(tmp_path) in note for note in asset.notes)
    assert capfd.readouterr() == ("", "")
