"""Masses that an edit must not change: bodies whose colliders change say what they weighed before."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol

import numpy as np

from meshforge.asset import Inertial
from meshforge.formats.mesh_parts import MeshPart
from meshforge.formats.numbers import tidy
from meshforge.formats.usd.reading.contact import physics_material
from meshforge.formats.usd.reading.masses import centre_of, moments_of, told
from meshforge.formats.usd.reading.read import Source
from meshforge.formats.usd.reading.stage import Scene, rotation_of
from meshforge.formats.usd.writing.edit import Edit
from meshforge.formats.usd.writing.specs import Space, apply_schemas, value
from meshforge.geometry import Floats, Polytope, Pose, Shape, inertia, is_closed


class Unit(Protocol):
    """What a stage measures in."""

    @property
    def metres(self) -> float: ...
    @property
    def kilograms(self) -> float: ...


_DENSITY = 1000.0  # [kg/m^3], where nothing says another one


def keep_masses(edit: Edit, sources: Sequence[Source]) -> list[str]:
    """Author the masses of the bodies that an edit changed, where their colliders told them; notes on those unknown."""
    from pxr import Sdf

    notes = []
    for path, name in edit.bodies.names.items():
        prim = edit.bodies.prims[path]
        if name not in edit.changed or _says_all(edit.scene, prim):
            continue
        found = weighed(edit.scene, prim, name, [source for source in sources if source.body == name])
        if found is None:
            notes.append(f"the mass of {name!r} is left to its colliders: of one of them the volume is not known")
        else:
            author(Sdf.CreatePrimInLayer(edit.layer, path), found, Space(*edit.scene.placement(prim)), edit.scene)
    return notes


def weighed(scene: Scene, prim: Any, body: str, sources: Sequence[Source]) -> Inertial | None:
    """What a body weighs by all that its stage tells, colliders included; None where a volume is not known."""
    pieces = [(source, _solids(source.parts)) for source in sources]
    solids = [(source, shapes) for source, shapes in pieces if shapes]
    if not solids or any(shapes is None for _, shapes in pieces):
        return None
    masses = [_mass(scene, prim, source, shapes) for source, shapes in solids]
    weights = [(*inertia(shapes, mass), mass) for (_, shapes), mass in zip(solids, masses, strict=True)]
    total = sum(mass for _, _, mass in weights)
    said = told(scene, prim, "physics:mass")
    mass = said * scene.kilograms if said is not None and said > 0 else total
    factor = mass / total
    middle: Floats = np.sum([centre * mass for centre, _, mass in weights], axis=0) / total
    centre, moments = centre_of(scene, prim), moments_of(scene, prim)
    if centre is None:
        centre = middle
    if moments is None:
        moments = factor * sum((_moved(own, mass, at - centre) for at, own, mass in weights), np.zeros((3, 3)))
    return Inertial(body, mass, centre, moments)


def author(spec: Any, inertial: Inertial, body: Space, unit: Unit) -> None:
    """Write a mass on the prim of a body, in its own space and in the units of the stage."""
    from pxr import Gf

    centre = tidy(body.to_local(inertial.centre[None])[0], 1.0)
    turn = rotation_of(body.linear).T
    moments, axes = _principal(tidy(turn @ inertial.inertia @ turn.T))
    moments = moments / (unit.kilograms * unit.metres**2)
    apply_schemas(spec, ["PhysicsMassAPI"])
    value(spec, "physics:mass", "Float", inertial.mass / unit.kilograms)
    value(spec, "physics:centerOfMass", "Point3f", Gf.Vec3f(*centre.tolist()))
    if moments.min() > 0:
        w, x, y, z = Pose(axes, np.zeros(3)).to_quaternion().tolist()
        value(spec, "physics:diagonalInertia", "Float3", Gf.Vec3f(*moments.tolist()))
        value(spec, "physics:principalAxes", "Quatf", Gf.Quatf(w, x, y, z))


def _principal(inertia: Floats) -> tuple[Floats, Floats]:
    """The principal moments (3,) and their axes, a rotation (3, 3); the given axes where these are principal."""
    if not (inertia - np.diag(np.diag(inertia))).any():
        return np.diag(inertia).copy(), np.eye(3)
    moments, axes = np.linalg.eigh(inertia)
    return moments, axes * np.sign(np.linalg.det(axes))


def _says_all(scene: Scene, prim: Any) -> bool:
    """Whether a body tells its mass, centre and inertia itself."""
    mass = told(scene, prim, "physics:mass") or 0.0
    return mass > 0 and centre_of(scene, prim) is not None and moments_of(scene, prim) is not None


def _solids(parts: Sequence[MeshPart]) -> list[Shape] | None:
    """The solids of a prim's pieces, of closed opaque ones too; None where one has no volume that is known."""
    found: list[Shape] = []
    for part in parts:
        if part.shape is not None:
            found.append(part.shape)
        elif part.surface is not None and len(part.surface.faces) and is_closed(part.surface.faces):
            found.append(Polytope(part.surface.vertices, part.surface.faces))
        else:
            return None
    return found if all(shape.volume > 0 for shape in found) else None


def _mass(scene: Scene, body: Any, source: Source, shapes: Sequence[Shape]) -> float:
    """The mass [kg] of a collider: its own, else by density, its own, its body's or its material's."""
    volume = sum(shape.volume for shape in shapes)
    own = told(scene, source.prim, "physics:mass") if source.prim != body else None
    if own is not None and own > 0:
        return own * scene.kilograms
    material = physics_material(source.prim)
    for prim in (source.prim, body, *([material] if material else [])):
        density = told(scene, prim, "physics:density")
        if density is not None and density > 0:
            return volume * density * scene.kilograms / scene.metres**3
    return volume * _DENSITY


def _moved(own: Floats, mass: float, by: Floats) -> Floats:
    """An inertia (3, 3) about a point that is so far (3,) from the centre."""
    moved: Floats = own + mass * (by @ by * np.eye(3) - np.outer(by, by))
    return moved
