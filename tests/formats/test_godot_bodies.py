"""A body that moves is one rigid body in Godot, of several shapes: read by the rules of Godot's importer
(modules/gltf/extensions/physics/gltf_document_extension_physics.cpp of Godot 4)."""

from __future__ import annotations

import json
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from meshforge.formats import read, save
from meshforge.geometry import inertia
from meshforge.symbolic import Asset, NonConvexPiece, Surface
from tests.conversion_samples import SAMPLES
from tests.gltf_validation import errors

WALL = '<geom name="wall" type="box" size=".05 .5 .4" pos=".45 0 .45"/>'
CRATE = f"""<mujoco model="crate"><worldbody><body name="crate" pos="0 0 1"><freejoint/>
<geom name="floor" type="box" size=".5 .5 .05"/>
{WALL}
</body></worldbody></mujoco>"""
_WORDS = ("col", "convcol", "colonly", "convcolonly", "rigid", "navmesh", "vehicle", "wheel", "noimp")


@dataclass
class GodotBody:
    """A PhysicsBody3D, with how many shapes it has and meshes that it shows."""

    kind: str
    motion: dict[str, Any] = field(default_factory=dict)
    shapes: list[str] = field(default_factory=list)
    meshes: int = 0


def imported(path: Path) -> dict[str, GodotBody]:
    """The bodies that Godot makes; a shape joins the body right above it only, else it stands still for itself."""
    tree = json.loads(path.read_text())
    nodes, found = tree["nodes"], dict[str, GodotBody]()
    shapes = tree["extensions"]["OMI_physics_shape"]["shapes"]
    kinds = {"dynamic": "RigidBody3D", "static": "StaticBody3D", "kinematic": "AnimatableBody3D"}
    parents = {child: k for k, node in enumerate(nodes) for child in node.get("children", ())}
    for k, node in enumerate(nodes):
        own = node.get("extensions", {}).get("OMI_physics_body", {})
        assert not any(node["name"].lower().endswith((f"-{word}", f"_{word}")) for word in _WORDS)
        if "motion" in own:
            assert "mesh" not in node  # which Godot would not show
            found[node["name"]] = GodotBody(kinds[own["motion"]["type"]], own["motion"])
        above = found.get(nodes[parents[k]]["name"]) if k in parents else None
        if "collider" in own:
            assert above is not None and "mesh" not in node
            shape = shapes[own["collider"]["shape"]]
            above.shapes.append(shape["type"])
            assert len(tree["meshes"]) > shape[shape["type"]]["mesh"]
        elif "mesh" in node:
            assert above is not None
            above.meshes += 1
    return found


def for_godot(asset: Asset, folder: Path) -> tuple[dict[str, GodotBody], tuple[str, ...], Path]:
    saved = save(asset, folder / "out" / "a.gltf", names="godot")
    assert not errors([saved.path])[0]
    return imported(saved.path), saved.notes, saved.path


def test_a_crate_that_moves_is_one_body_of_two_shapes(tmp_path: Path) -> None:
    (tmp_path / "crate.xml").write_text(CRATE)
    asset = read(tmp_path / "crate.xml")
    bodies, notes, path = for_godot(asset, tmp_path)
    assert [(name, body.kind, body.shapes) for name, body in bodies.items()] == [
        ("crate", "RigidBody3D", ["convex", "convex"])
    ]
    assert bodies["crate"].motion["mass"] == pytest.approx(180)
    assert any("Godot computes the moments of inertia of crate" in note for note in notes)
    assert not any("mass" in note and "left out" in note for note in notes)
    after = read(path)
    assert {geom.name for geom in after.geoms} == {"crate/floor", "crate/wall"}
    for one, other in zip(asset.geoms, after.geoms, strict=True):
        assert one.shape.volume == pytest.approx(other.shape.volume, rel=1e-5)


def test_what_fixed_joints_hold_is_part_of_the_body_above(tmp_path: Path) -> None:
    bodies, notes, path = for_godot(SAMPLES["doors"](), tmp_path)
    before = SAMPLES["doors"]().mechanism
    kinds = {name: body.kind for name, body in bodies.items()}
    assert kinds.pop("frame") == "StaticBody3D" and set(kinds.values()) == {"RigidBody3D"}
    assert kinds.keys() == {"door", "drawer", "wheel"}
    assert len(bodies["door"].shapes) == 2 and bodies["door"].meshes == 1
    weights = {inertial.body: inertial for inertial in before.inertials}
    assert bodies["door"].motion["mass"] == pytest.approx(weights["door"].mass + weights["handle"].mass)
    assert any("fixed joints hold handle to door" in note for note in notes)
    assert any("HingeJoint3D" in note and "hinge" in note for note in notes)
    found = read(path).body_poses["door"].apply(np.array([bodies["door"].motion["centerOfMass"]]))[0]
    centre = weights["door"].mass * weights["door"].centre + weights["handle"].mass * weights["handle"].centre
    centre /= weights["door"].mass + weights["handle"].mass
    np.testing.assert_allclose(found, centre, atol=1e-6)  # an asset of memory is not turned


def test_moments_about_the_axes_of_the_body_are_kept(tmp_path: Path) -> None:
    (tmp_path / "a.xml").write_text(CRATE.replace(WALL, ""))
    asset = read(tmp_path / "a.xml")
    bodies, notes, _ = for_godot(asset, tmp_path)
    _, tensor = inertia([asset.geoms[0].shape], 100.0)
    x, y, z = np.diag(tensor)
    assert bodies["crate"].motion["inertiaDiagonal"] == pytest.approx([x, z, y])
    assert not any("moments" in note for note in notes)


def test_what_stands_still_is_known_by_its_names_as_before(tmp_path: Path) -> None:
    saved = save(SAMPLES["crowd"](), tmp_path / "a.gltf", names="godot")
    assert "OMI" not in saved.path.read_text() and "-convcolonly" in saved.path.read_text()


def test_a_surface_that_is_no_hull_does_not_move_and_is_named(tmp_path: Path) -> None:
    (tmp_path / "a.xml").write_text(CRATE)
    asset = read(tmp_path / "a.xml")
    flat = Surface(np.array([[0, 0, 2.0], [1, 0, 2], [0, 1, 2]]), np.array([[0, 1, 2]]))
    bodies, notes, _ = for_godot(
        replace(asset, non_convex=(NonConvexPiece("crate/rag", "crate", "flat", flat),)), tmp_path
    )
    assert bodies["crate"].shapes == ["convex", "convex"]
    assert "1 opaque piece (crate/rag) is left out: in Godot a mesh that is no hull cannot move" in notes
