"""Writing an edited URDF: the authored text with other collision elements, all else byte for byte as it was; and the
XML text of elements: collisions new or edited, joints, masses and visuals."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import assert_never

import numpy as np

from meshforge.formats import base, collision_pieces, mesh_output, xml
from meshforge.formats.kinematic_tree import LinkJoint, drop_rounding, name_moments, place_inertial
from meshforge.formats.references import Resolver, add_copy, note_absolute, placement
from meshforge.formats.slots import ElementMaker, ElementPlan, Slot, assign_names
from meshforge.formats.urdf.document import UrdfDocument, collisions, geometry_of, parse_robot, references
from meshforge.geometry import Box, Capsule, Cylinder, Pose, Shape, Sphere
from meshforge.symbolic import Asset, Coupling, Geom, Inertial

UrdfShape = Box | Cylinder | Sphere
"""The shapes that every reader of URDF knows."""
CAPSULE_READERS = "URDF without --urdf-capsules (MuJoCo 4, Bullet and Drake read <capsule>, yourdfpy 0.0.60 refuses it)"
"""Why a capsule is written as a hull, and who reads what would be written else."""

UNLIMITED_TRAVEL = 1000.0  # [m] either way, for a prismatic joint without limits, which URDF does not know
_UNKNOWN_MAXIMUM = 1000.0  # [N, Nm, m/s, rad/s], for joints of which no largest effort or velocity is known


def native_tag(shape: UrdfShape | Capsule) -> bytes:
    """The element of a native shape, without its pose."""
    match shape:
        case Box():
            return b'<box size="%s"/>' % _text_of(*2 * shape.half)
        case Cylinder():
            return b'<cylinder radius="%s" length="%s"/>' % (_text_of(shape.radius), _text_of(2 * shape.half_length))
        case Capsule():  # of which the length is that of the cylinder in it
            return b'<capsule radius="%s" length="%s"/>' % (_text_of(shape.radius), _text_of(2 * shape.half_length))
        case Sphere():
            return b'<sphere radius="%s"/>' % _text_of(shape.radius)
        case _:
            assert_never(shape)


def mesh_tag(reference: str) -> bytes:
    """The element of a mesh file in metres."""
    return b'<mesh filename="%s"/>' % xml.escape(reference)


def origin_tag(pose: Pose) -> bytes:
    """The element of a pose, its numbers in full precision."""
    return b'<origin xyz="%s" rpy="%s"/>' % (_text_of(*pose.translation), _text_of(*pose.to_rpy()))


def build_collision(pose: Pose, tag: bytes, lead: bytes, line_end: bytes) -> bytes:
    """A `<collision>` without a name, whose lines but the first are indented by `lead`."""
    return (line_end + lead).join(
        [b"<collision>", *(b"  " + line for line in _place_lines(pose, tag)), b"</collision>"]
    )


def _place_lines(pose: Pose, tag: bytes) -> list[bytes]:
    return [origin_tag(pose), b"<geometry>", b"  " + tag, b"</geometry>"]


def replace_geometry(data: bytes, collision: xml.Element, pose: Pose, tag: bytes) -> tuple[xml.Splice, ...]:
    """The edits that give a copy of a collision element another pose and geometry, all else of it being inherited."""
    kind = geometry_of(collision)
    assert kind is not None  # only elements with pieces are copied
    return _replace_origin(data, collision, pose), xml.Splice(kind.start, kind.end, tag)


def replace_mesh(data: bytes, collision: xml.Element, pose: Pose, reference: str) -> tuple[xml.Splice, ...]:
    """The edits that give a copy a mesh file in metres: where the element has a mesh, its other attributes stay."""
    kind = geometry_of(collision)
    if kind is None or kind.tag != "mesh":
        return replace_geometry(data, collision, pose, mesh_tag(reference))
    scale = [xml.set_attribute(data, kind, "scale", None)] if "scale" in kind.attributes else []
    return (_replace_origin(data, collision, pose), xml.set_attribute(data, kind, "filename", reference), *scale)


def _replace_origin(data: bytes, collision: xml.Element, pose: Pose) -> xml.Splice:
    return xml.replace_or_insert(data, collision, "origin", "geometry", origin_tag(pose))


def joint_lines(made: LinkJoint, coupling: Coupling | None) -> list[bytes]:
    """The lines of a `<joint>`, which may follow another one."""
    joint = made.joint
    kind = joint.kind if joint else "fixed"
    type_ = "continuous" if joint and kind == "revolute" and joint.limits is None else kind
    lines = [
        b'  <joint name="%s" type="%s">' % (xml.escape(made.name), type_.encode()),
        b"    " + origin_tag(made.pose),
        b'    <parent link="%s"/>' % xml.escape(made.parent),
        b'    <child link="%s"/>' % xml.escape(made.child),
    ]
    if kind in ("revolute", "prismatic", "planar"):
        lines.append(b'    <axis xyz="%s"/>' % _text_of(*drop_rounding(made.axis)))
    if joint and kind in ("revolute", "prismatic"):
        lower, upper = joint.limits or (-UNLIMITED_TRAVEL, UNLIMITED_TRAVEL)
        range_ = b"" if type_ == "continuous" else b'lower="%s" upper="%s" ' % (_text_of(lower), _text_of(upper))
        most = _text_of(joint.effort or _UNKNOWN_MAXIMUM), _text_of(joint.velocity or _UNKNOWN_MAXIMUM)
        if range_ or joint.effort or joint.velocity:
            lines.append(b'    <limit %seffort="%s" velocity="%s"/>' % (range_, *most))
    if joint and (joint.damping or joint.friction):
        losses = _text_of(joint.damping), _text_of(joint.friction)
        lines.append(b'    <dynamics damping="%s" friction="%s"/>' % losses)
    if coupling:
        numbers = tuple(_text_of(number) for number in reversed(coupling.coefficients))
        lines.append(b'    <mimic joint="%s" multiplier="%s" offset="%s"/>' % (xml.escape(coupling.joint), *numbers))
    return [*lines, b"  </joint>"]


def inertial_lines(inertial: Inertial, root_t_link: Pose) -> list[bytes]:
    """The lines of an `<inertial>`, its axes those of the link."""
    centre, tensor = place_inertial(inertial, root_t_link)
    moments = b" ".join(b'%s="%s"' % (name.encode(), _text_of(value)) for name, value in name_moments(tensor))
    return [
        b"    <inertial>",
        b"      " + origin_tag(Pose.of_translation(centre)),
        b'      <mass value="%s"/>' % _text_of(inertial.mass),
        b"      <inertia %s/>" % moments,
        b"    </inertial>",
    ]


def visual_lines(visual: mesh_output.LinkVisual, reference: str | None = None) -> list[bytes]:
    """The lines of a `<visual>`; reference: the mesh file of a shape that URDF lacks."""
    if isinstance(visual.what, Box | Cylinder | Sphere):
        pose, tag = visual.what.pose, native_tag(visual.what)
    else:
        file = visual.what if isinstance(visual.what, str) else reference
        assert file is not None  # made for every shape that is not native
        pose, tag = visual.pose, mesh_tag(file)
        if not np.array_equal(visual.scale, np.ones(3)):
            tag = tag[:-2] + b' scale="%s"/>' % _text_of(*visual.scale)
    inside = _place_lines(pose, tag)
    if visual.rgba:  # a material named by its numbers: equal names must be equal colours
        color = _text_of(*visual.rgba)
        inside.append(b'<material name="rgba %s"><color rgba="%s"/></material>' % (color, color))
    return [b"    <visual>", *(b"      " + line for line in inside), b"    </visual>"]


def _text_of(*values: float) -> bytes:
    return xml.format_numbers(values).encode()


def write_urdf(asset: Asset, document: UrdfDocument, name: str, *, capsules: bool = False) -> base.Output:
    """The files of an asset that was read from a URDF; without an edit, its own bytes.

    capsules: whether they are written as such, which they are in any case where the file has one.

    Raises AssetError: a hull on a link that is not there, or a mesh file that changed since the asset was read.
    """
    text = xml.XmlText.of(document.source)
    robot = parse_robot(text.data, str(asset.path))
    files = mesh_output.HullFiles(Path(name).stem, document.resolver)
    files.avoid(references(robot))
    meshes = collision_pieces.SourceMeshes(document.digests, str(asset.path))
    folder = files.folder_of(_find_first_mesh(robot))
    kinds = (geometry_of(collision) for _, collision in collisions(robot))
    capsules = capsules or any(kind is not None and kind.tag == "capsule" for kind in kinds)
    maker = UrdfElementMaker(text.data, xml.newline_of(text.data), files, folder, meshes, capsules=capsules)
    links = {link.attributes["name"]: link for link in robot.each("link")}
    plan = ElementPlan(asset, document.authored, [element for _, element in collisions(robot)], links, maker)
    names = assign_names(plan.slots, unique=True)
    data = xml.apply_splices(text.data, plan.splices)
    main = document.source if data == text.data else text.encode(data)
    copies, far = _list_copies(parse_robot(data, str(asset.path)), document.resolver)
    return base.Output(main, dict(files.made), copies, (*maker.notes, *far), names)


def _find_first_mesh(robot: xml.Element) -> str | None:
    """The reference of the first collision mesh, in whose folder hulls of no mesh's kin go."""
    kinds = (geometry_of(collision) for _, collision in collisions(robot))
    meshes = (kind.attributes.get("filename") for kind in kinds if kind is not None and kind.tag == "mesh")
    return next(meshes, None)


def _list_copies(robot: xml.Element, resolver: Resolver) -> tuple[dict[str, Path], list[str]]:
    """The input files that the output refers to, by where they go; and notes on those that stay where they are."""
    copies: dict[str, Path] = {}
    notes = []
    for reference in references(robot):
        place, path = placement(reference), resolver.find(reference)
        if path is None:  # made, or missing from the start
            continue
        if place is None:
            notes.append(note_absolute(reference))
        else:
            add_copy(copies, place, path, "Rename one of them, or put both under one package root.")
    return copies, notes


@dataclass(frozen=True, eq=False, slots=True)
class UrdfElementMaker(ElementMaker):
    """Makes elements for one document; capsules: whether they are written as such."""

    capsules: bool = False

    @property
    def title(self) -> str:
        return "URDF"

    def explain_hull(self, shape: Shape) -> str:
        return CAPSULE_READERS if isinstance(shape, Capsule) else f"{self.title} has no {shape.kind}"

    def find_mesh(self, collision: xml.Element) -> str | None:
        mesh = geometry_of(collision)
        return mesh.attributes.get("filename") if mesh is not None and mesh.tag == "mesh" else None

    def make_slot(self, geom: Geom, root_t_link: Pose, template: xml.Element | None, lead: bytes) -> Slot:
        shape = geom.shape.move(root_t_link.inverse())
        if isinstance(shape, UrdfShape) or (self.capsules and isinstance(shape, Capsule)):
            pose, tag = shape.pose, native_tag(shape)
            edits = replace_geometry(self.data, template, pose, tag) if template else ()
        else:
            pose, reference = Pose.identity(), self.make_mesh(geom, shape, template)
            tag = mesh_tag(reference)
            edits = replace_mesh(self.data, template, pose, reference) if template else ()
        if template:
            return Slot(geom.body, (geom.name,), None, template, edits, copy=True)
        return Slot(geom.body, (geom.name,), text=build_collision(pose, tag, lead, self.line_end))

    def extract_piece(self, element: xml.Element, name: str, k: int) -> tuple[xml.Splice, ...]:
        mesh = geometry_of(element)
        assert mesh is not None  # only meshes have several pieces
        piece, made = self.make_piece(mesh.attributes["filename"], (), name, k)
        if piece.shape is None and collision_pieces.is_flat(piece.vertices):
            self.notes.append(f"flat piece {name!r} stays, now in a file of its own, which MuJoCo refuses")
        return (xml.set_attribute(self.data, mesh, "filename", made),)
