"""Writing an edited URDF, all but collisions byte for byte as it was; and a new one of an asset of another format:
links, joints, native shapes and mesh files."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from meshforge.common import join_names, pluralize
from meshforge.formats import base, collision_pieces, element_edits, kinematic_tree, link_reader, mesh_output, xml
from meshforge.formats.conversion import note_hulled
from meshforge.formats.link_output import LinkCreator
from meshforge.formats.references import collect_copies, placement, reference_of
from meshforge.formats.urdf import srdf
from meshforge.formats.urdf.document import VISUAL_SUFFIXES, UrdfDocument, collisions, parse_robot, references
from meshforge.geometry import Box, Capsule, Cylinder, Floats, Pose, Shape, Sphere
from meshforge.symbolic import Asset, Coupling, FeatureKind, Inertial, Rgba, Surface

UrdfShape = Box | Cylinder | Sphere
"""The shapes that every reader of URDF knows."""
CAPSULE_READERS = "URDF without --urdf-capsules (MuJoCo 4, Bullet and Drake read <capsule>, yourdfpy 0.0.60 refuses it)"
"""Why a capsule is written as a hull, and who reads what would be written else."""
_REMEDY = "Rename one of them, or put both under one package root."

UNLIMITED_TRAVEL = 1000.0  # [m] either way, for a prismatic joint without limits, which URDF does not know
_UNKNOWN_MAXIMUM = 1000.0  # [N, Nm, m/s, rad/s], for joints of which no largest effort or velocity is known


def origin_tag(pose: Pose) -> bytes:
    """Return the element of a pose, its numbers in full precision."""
    return xml.tag("origin", {"xyz": xml.format_numbers(pose.translation), "rpy": xml.format_numbers(pose.to_rpy())})


def joint_lines(made: kinematic_tree.LinkJoint, coupling: Coupling | None) -> list[bytes]:
    """Return the lines of a `<joint>`, which may follow another one."""
    joint = made.joint
    kind = joint.kind if joint else "fixed"
    type_ = "continuous" if joint and kind == "revolute" and joint.limits is None else kind
    inside = [origin_tag(made.pose), xml.tag("parent", {"link": made.parent}), xml.tag("child", {"link": made.child})]
    if kind in ("revolute", "prismatic"):
        inside.append(xml.tag("axis", {"xyz": xml.format_numbers(kinematic_tree.drop_rounding(made.axis))}))
    if joint and kind in ("revolute", "prismatic"):
        lower, upper = joint.limits or (-UNLIMITED_TRAVEL, UNLIMITED_TRAVEL)
        range_ = {} if type_ == "continuous" else {"lower": _text_of(lower), "upper": _text_of(upper)}
        most = {"effort": joint.effort or _UNKNOWN_MAXIMUM, "velocity": joint.velocity or _UNKNOWN_MAXIMUM}
        if range_ or joint.effort or joint.velocity:
            inside.append(xml.tag("limit", range_ | {name: _text_of(number) for name, number in most.items()}))
    if joint and (joint.damping or joint.friction):
        inside.append(xml.tag("dynamics", {"damping": _text_of(joint.damping), "friction": _text_of(joint.friction)}))
    if coupling:
        offset, factor = map(_text_of, coupling.coefficients)
        inside.append(xml.tag("mimic", {"joint": coupling.joint, "multiplier": factor, "offset": offset}))
    return xml.nest("joint", *inside, name=made.name, type=type_)


def inertial_lines(inertial: Inertial, root_t_link: Pose) -> list[bytes]:
    """Return the lines of an `<inertial>`, its axes those of the link."""
    centre, tensor = kinematic_tree.place_inertial(inertial, root_t_link)
    moments = {name: _text_of(value) for name, value in kinematic_tree.name_moments(tensor)}
    mass = xml.tag("mass", {"value": _text_of(inertial.mass)})
    return xml.nest("inertial", origin_tag(Pose.of_translation(centre)), mass, xml.tag("inertia", moments))


def _text_of(value: float) -> str:
    return xml.format_numbers([value])


def write_urdf(asset: Asset, document: UrdfDocument, name: str, *, capsules: bool = False) -> base.Output:
    """Return the files of an asset that was read from a URDF; without an edit, its own bytes.

    capsules: whether they are written as such, which they are in any case where the file has one.

    Raises AssetError: a hull on a link that is not there, or a mesh file that changed since the asset was read.
    """
    text = xml.XmlText.of(document.source)
    robot = parse_robot(text.data, str(asset.path))
    files = mesh_output.HullFiles(Path(name).stem, document.resolver)
    files.avoid(references(robot))
    meshes = link_reader.CollisionMeshes(document.digests)
    elements = [element for _, element in collisions(robot)]
    has_capsule = any(kind.tag == "capsule" for element in elements if (kind := link_reader.geometry_of(element)))
    maker = UrdfElementMaker("URDF", text.data, files, meshes=meshes, capsules=capsules or has_capsule)
    maker.folder = maker.find_folder(elements)
    links = {link.attributes["name"]: link for link in robot.each("link")}
    plan = element_edits.ElementEdits(asset, document.authored, elements, links, maker)
    names = element_edits.assign_names(plan.outputs, unique=True)
    data = xml.apply_splices(text.data, plan.splices)
    main = document.source if data == text.data else text.encode(data)
    texts = references(parse_robot(data, str(asset.path)))
    copies, far = collect_copies(((text, placement(text), document.resolver.find(text)) for text in texts), _REMEDY)
    made, pairs, beside = dict(files.made), asset.mechanism.added, srdf.srdf_beside(asset.path)
    if pairs:
        made[files.stem + srdf.SUFFIX] = srdf.write_pairs(pairs, robot.attributes.get("name", files.stem), beside)
    elif beside:
        copies[files.stem + srdf.SUFFIX] = beside
    return base.Output(main, made, copies, (*maker.notes, *far), names)


@dataclass(eq=False)
class UrdfElementMaker(element_edits.ElementMaker):
    """Makes elements for one document; capsules: whether they are written as such."""

    capsules: bool = False

    def explain_hull(self, shape: Shape) -> str:
        return CAPSULE_READERS if isinstance(shape, Capsule) else super().explain_hull(shape)

    def native_lines(self, shape: Shape) -> tuple[Pose, list[bytes]] | None:
        if isinstance(shape, UrdfShape) or (self.capsules and isinstance(shape, Capsule)):
            return shape.pose, [xml.tag(shape.kind, kinematic_tree.name_sizes(shape))]
        return None

    def mesh_lines(self, reference: str, scale: Floats | None = None) -> list[bytes]:
        scaled = {} if scale is None else {"scale": xml.format_numbers(scale)}
        return [xml.tag("mesh", {"filename": reference, **scaled})]

    def pose_tag(self, pose: Pose) -> bytes:
        return origin_tag(pose)

    def replace_geometry(
        self, collision: xml.Element, pose: Pose, kind: Sequence[bytes], reference: str | None
    ) -> tuple[xml.Splice, ...]:
        """Return where the element has a mesh and gets one, the other attributes of that stay."""
        old = link_reader.geometry_of(collision)
        assert old is not None  # only elements with pieces are copied
        origin = xml.replace_or_insert(self.data, collision, "origin", "geometry", origin_tag(pose))
        if reference is None or old.tag != "mesh":
            return origin, xml.Splice(old.start, old.end, *kind)
        scale = [xml.set_attribute(self.data, old, "scale", None)] if "scale" in old.attributes else []
        return (origin, xml.set_attribute(self.data, old, "filename", reference), *scale)

    def extract_piece(self, element: xml.Element, name: str, k: int) -> tuple[xml.Splice, ...]:
        mesh = link_reader.geometry_of(element)
        assert mesh is not None  # only meshes have several pieces
        piece, made = self.make_piece(reference_of(mesh), (), name, k)
        if piece.shape is None and collision_pieces.is_flat(piece.vertices):
            self.notes.append(f"flat piece {name!r} stays, now in a file of its own, which MuJoCo refuses")
        return (xml.set_attribute(self.data, mesh, "filename", made),)


def create_urdf(asset: Asset, name: str, *, capsules: bool = False) -> base.Output:
    """Return the files of an asset that came from another format; capsules: whether they are written as such.

    Bodies become links, each with its frame on the joint that leads to it, so that at zero all is where it was; hulls
    become native shapes or mesh files, non-convex pieces meshes as they are.
    """
    files = mesh_output.HullFiles(Path(name).stem)
    output = _Creator(asset, UrdfElementMaker("URDF", b"", files, capsules=capsules)).build_output()
    hulled = tuple(geom.name for geom in asset.geoms if isinstance(geom.shape, Capsule) and not capsules)
    loss = base.Loss(FeatureKind.CAPSULES, hulled, CAPSULE_READERS, "written as triangles")
    return replace(output, lost=(*output.lost, loss)) if hulled else output


class _Creator(LinkCreator):
    native = UrdfShape
    title = "URDF"
    kinds = ("fixed", "revolute", "prismatic", "floating")
    visual_suffixes = VISUAL_SUFFIXES
    lead = b"    "

    def build_output(self) -> base.Output:
        names = element_edits.assign_names([output for own in self.outputs.values() for output in own], unique=True)
        files = self.maker.files
        inside = [line for link in self.chain.frames for line in self._link_lines(link)]
        for joint in self.chain.joints:
            inside += joint_lines(joint, self.couplings.by_joint.get(joint.name))
        main = b"\n".join([b'<?xml version="1.0"?>', *xml.nest("robot", *inside, name=files.stem), b""])
        lost, made = self.collect_losses(), dict(files.made)
        pairs = [pair for pair in self.asset.mechanism.apart if self.links.keys() >= {*pair}]
        if pairs:
            made[files.stem + srdf.SUFFIX] = srdf.write_pairs(pairs, files.stem)
        return base.Output(main, made, self.visuals.copies, self._collect_notes(), names, lost)

    def refuse_surface(self, surface: Surface) -> str:
        is_flat = not len(surface.faces) or collision_pieces.is_flat(surface.vertices)
        return "engines refuse a mesh that is flat" if is_flat else ""

    def color_lines(self, rgba: Rgba) -> list[bytes]:
        """Return a material named by its numbers: equal names must be equal colours."""
        color = xml.format_numbers(rgba)
        return [b'<material name="rgba %s">%s</material>' % (color.encode(), xml.tag("color", {"rgba": color}))]

    def _link_lines(self, link: str) -> list[bytes]:
        inertial, frame = self.inertial_of(link)
        inside = inertial_lines(inertial, frame) if inertial else []
        inside += [line for visual in self.shown[link] for line in self.visual_lines(visual)]
        inside += [output.to_bytes(b"") for output in self.outputs[link]]
        return xml.nest("link", *inside, name=link) if inside else [xml.tag("link", {"name": link})]

    def _collect_notes(self) -> tuple[str, ...]:
        notes = [*self.chain.notes, *self.couplings.notes]
        written = {name for own in self.outputs.values() for output in own for name in output.names}
        notes += note_hulled([p for p in self.asset.non_convex if p.name in written], "MuJoCo and Bullet")
        sliding = [made for made in self.chain.joints if made.joint and made.joint.kind == "prismatic"]
        unlimited = join_names([made.name for made in sliding if made.joint and not made.joint.limits], 3)
        if unlimited:
            travel = f"{UNLIMITED_TRAVEL:g} m each way"
            notes.append(f"prismatic joints without limits ({unlimited}) are limited to {travel}")
        if self.chain.light:
            light, mass = join_names(self.chain.light, 3), kinematic_tree.LIGHT_INERTIAL.mass
            notes.append(f"links of {mass:g} kg stand between joints of one body ({light})")
        # of the name of the world, PyBullet knows that it has no mass
        if weightless := [link for link in self.weightless if link != "world"]:
            notes.append(
                f"{pluralize(len(weightless), 'link')} without a mass ({join_names(weightless, 3)}): PyBullet takes "
                "1 kg, MuJoCo computes it from the hulls"
            )
        return tuple(notes)
