"""Writing an edited SDF, all but collisions byte for byte as it was; the XML of new collisions, joints, visuals."""

import posixpath
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from meshforge.common import AssetError, join_names
from meshforge.formats import element_edits, kinematic_tree, link_reader, mesh_output, xml
from meshforge.formats.base import Mass, Output
from meshforge.formats.references import collect_copies, reference_of
from meshforge.formats.sdf import document, frames, models
from meshforge.geometry import Capsule, Ellipsoid, Floats, Pose, Shape
from meshforge.symbolic import Asset, Coupling, Geom, Inertial

_REMEDY = "Rename one of them, or put both under one folder."
_ENDLESS = (-1e16, 1e16)
"""Limits that stand for none, which PyBullet asks for."""


def leaf(tag: str, text: str) -> bytes:
    """Return an element that holds a text."""
    return b"<%s>%s</%s>" % (tag.encode(), xml.escape(text), tag.encode())


def number_leaf(tag: str, number: float) -> bytes:
    """Return an element that holds a number."""
    return leaf(tag, xml.format_numbers([number]))


def pose_leaf(pose: Pose) -> bytes:
    """Return the element of a pose, its numbers in full precision."""
    return leaf("pose", xml.format_numbers([*pose.translation, *pose.to_rpy()]))


def joint_lines(
    made: kinematic_tree.LinkJoint, parent: str, child: str, coupling: Coupling | None = None
) -> list[bytes]:
    """Return the lines of a `<joint>`, whose frame is that of its child; coupling: to another joint, from 1.11 on."""
    joint = made.joint
    kind = joint.kind if joint else "fixed"
    inside = [leaf("parent", parent), leaf("child", child)]
    if joint and kind in ("revolute", "prismatic"):
        lower, upper = joint.limits or _ENDLESS
        most = (("effort", joint.effort), ("velocity", joint.velocity))
        losses = (("damping", joint.damping), ("friction", joint.friction))
        limit = [number_leaf("lower", lower), number_leaf("upper", upper)]
        limit += [number_leaf(tag, number) for tag, number in most if number]
        dynamics = [number_leaf(tag, number) for tag, number in losses if number]
        axis = [leaf("xyz", xml.format_numbers(kinematic_tree.drop_rounding(made.axis))), *xml.nest("limit", *limit)]
        mimic = []
        if coupling:
            offset, factor = coupling.coefficients
            numbers = (("multiplier", factor), ("offset", offset), ("reference", 0.0))
            inside_mimic = (number_leaf(tag, number) for tag, number in numbers)
            mimic = xml.nest("mimic", *inside_mimic, joint=coupling.joint, axis="axis")
        inside += xml.nest("axis", *axis, *(xml.nest("dynamics", *dynamics) if dynamics else []), *mimic)
    return xml.nest("joint", *inside, name=made.name, type=kind)


def inertial_lines(inertial: Inertial, root_t_link: Pose) -> list[bytes]:
    """Return the lines of an `<inertial>`, its axes those of the link."""
    centre, tensor = kinematic_tree.place_inertial(inertial, root_t_link)
    moments = xml.nest("inertia", *(number_leaf(name, value) for name, value in kinematic_tree.name_moments(tensor)))
    return xml.nest("inertial", pose_leaf(Pose.of_translation(centre)), number_leaf("mass", inertial.mass), *moments)


def write_sdf(asset: Asset, origin: document.SdfDocument, name: str, mass: Mass) -> Output:
    """Return the files of an asset that was read from an SDF; without an edit, their own bytes.

    Raises AssetError: an edit of a world or of a model that is included several times, a hull on a link that is not
    there, a mesh file that changed since the asset was read, or a mass that Gazebo computes and that is to stay.
    """
    for geom in asset.geoms:
        element_edits.refuse_unknown_link(geom, origin.links, str(asset.path))
    meshes, taken = models.SdfMeshes(origin.digests), set[str]()
    plans = []
    for number, source in enumerate(origin.sources):
        files = mesh_output.HullFiles(Path(name).stem, source.resolver, taken)
        plans.append(_plan_source(asset, origin, number, files, meshes))
    names = element_edits.assign_names([output for plan in plans for output in plan.outputs])
    each = list(zip(plans, origin.sources, strict=True))
    texts = [_build_text(asset, origin, plan, source, mass) for plan, source in each]
    copies, notes = collect_copies(_list_files(origin.sources, texts, name), _REMEDY)
    made: dict[str, bytes] = {}
    for plan, source in each:
        folder = posixpath.dirname(source.place or "")
        made |= {posixpath.normpath(posixpath.join(folder, key)): v for key, v in plan.maker.files.made.items()}
    made |= {source.place: text for source, text in zip(origin.sources[1:], texts[1:], strict=True) if source.place}
    return Output(texts[0], made, copies, (*(note for plan in plans for note in plan.maker.notes), *notes), names)


def _plan_source(
    asset: Asset, origin: document.SdfDocument, number: int, files: mesh_output.HullFiles, meshes: models.SdfMeshes
) -> element_edits.ElementEdits:
    source = origin.sources[number]
    data = source.text.data
    root, version = document.parse_root(data, str(source.path))
    at = {element.start: element for element in root.walk()}
    own = [k for k, place in enumerate(origin.at) if place[0] == number]
    links = {body: at[start] for body, (source_of, start) in origin.links.items() if source_of == number}
    files.avoid(document.references(root))
    maker = SdfElementMaker(f"SDF {version[0]}.{version[1]}", data, files, meshes=meshes, version=version)
    maker.folder = maker.find_folder(element for element in root.walk() if element.tag == "collision")
    here = replace(asset, geoms=tuple(geom for geom in asset.geoms if geom.body in links))
    authored, found = [origin.authored[k] for k in own], [at[origin.at[k][1]] for k in own]
    return element_edits.ElementEdits(here, authored, found, links, maker)


def _build_text(
    asset: Asset, origin: document.SdfDocument, plan: element_edits.ElementEdits, source: document.SdfSource, mass: Mass
) -> bytes:
    """The text of a file. Raises AssetError where it cannot be edited."""
    edits, where = plan.splices, str(asset.path)
    if not edits:
        return source.raw
    if origin.worlds:
        worlds = join_names(origin.worlds, 2)
        remedy = "Put its <model> into a file of its own (<sdf><model>), and edit that."
        raise AssetError(f"this is a world ({worlds}), which is only read", where=where, remedy=remedy)
    if source.count > 1 or source.place is None:
        why = f"is included {source.count} times" if source.count > 1 else "is included by an absolute path"
        problem = f"{source.reference!r} {why}: it is not edited here"
        raise AssetError(problem, where=where, remedy=f"Edit {source.path} itself.")
    if mass == "keep":
        _refuse_computed_masses(plan, where)
    data = xml.apply_splices(plan.maker.data, edits)
    return source.raw if data == plan.maker.data else source.text.encode(data)


@dataclass(eq=False)
class SdfElementMaker(element_edits.ElementMaker):
    """Makes elements for one file."""

    version: document.Version = field(kw_only=True)

    def native_lines(self, shape: Shape) -> tuple[Pose, list[bytes]] | None:
        is_known = self.version >= document.ROUND_SHAPES or not isinstance(shape, Capsule | Ellipsoid)
        if isinstance(shape, kinematic_tree.LinkShape) and is_known:
            sizes = kinematic_tree.name_sizes(shape).items()
            return shape.pose, xml.nest(shape.kind, *(leaf(tag, text) for tag, text in sizes))
        return None

    def mesh_lines(self, reference: str, scale: Floats | None = None) -> list[bytes]:
        scaled = [] if scale is None else [leaf("scale", xml.format_numbers(scale))]
        return xml.nest("mesh", leaf("uri", reference), *scaled)

    def pose_tag(self, pose: Pose) -> bytes:
        return pose_leaf(pose)

    def make_element(
        self, geom: Geom, root_t_link: Pose, template: xml.Element | None, lead: bytes
    ) -> element_edits.OutputElement:
        made = super().make_element(geom, root_t_link, template, lead)
        made.name = element_edits.name_attribute_of(made)  # SDF asks for one
        return made

    def replace_geometry(
        self, collision: xml.Element, pose: Pose, kind: Sequence[bytes], reference: str | None
    ) -> tuple[xml.Splice, ...]:
        old = link_reader.geometry_of(collision)
        assert old is not None  # only elements with pieces are copied
        if b"\n" not in self.data[old.start : old.end]:  # all in one line
            kind = [b"".join(line.strip() for line in kind)]
        made = xml.Splice(old.start, old.end, xml.line_gap(self.data, old.start).join(kind))
        return xml.replace_or_insert(self.data, collision, "pose", "geometry", pose_leaf(pose)), made

    def extract_piece(self, element: xml.Element, name: str, k: int) -> tuple[xml.Splice, ...]:
        """Scale and place stay; the file is used whole."""
        mesh = link_reader.geometry_of(element)
        assert mesh is not None  # only meshes have several pieces
        _, made = self.make_piece(reference_of(mesh), models.read_submesh(mesh), name, k)
        uri, submesh = mesh.first("uri") or mesh.first("filename"), mesh.first("submesh")
        assert uri is not None  # it has pieces
        new = xml.Splice(uri.start, uri.end, leaf(uri.tag, made))
        return (new, xml.remove_element(self.data, submesh)) if submesh else (new,)


def _refuse_computed_masses(plan: element_edits.ElementEdits, where: str) -> None:
    """Raise AssetError where an edit would change a mass that Gazebo computes of collisions."""
    edited = {one.body for one, (_, outputs) in zip(plan.authored, plan.places, strict=True) if not outputs}
    edited |= {output.body for _, outputs in plan.places for output in outputs if not output.is_untouched}
    for body in sorted(edited | plan.ends.keys()):
        inertial = plan.links[body].first("inertial")
        if inertial is not None and frames.is_computed(inertial):
            problem = f"Gazebo computes the mass of link {body!r} of its collisions, which change: it is not known here"
            remedy = "Leave it to the new collisions (--mass recompute), or say it in the file."
            raise AssetError(problem, where=where, remedy=remedy)


def _list_files(
    sources: Sequence[document.SdfSource], texts: Sequence[bytes], name: str
) -> Iterator[tuple[str, str | None, Path | None]]:
    """Yield references, each with its place and its file; texts: of the sources as they are written; name: of the main
    one, whose `model.config` goes along where that names a file of that name."""
    for number, (source, text) in enumerate(zip(sources, texts, strict=True)):
        if source.place is None:
            yield source.reference, None, source.path
            continue
        folder = posixpath.dirname(source.place)
        config = source.path.parent / document.CONFIG
        if config.is_file() and (number or source.path.name == name) and not folder.startswith(".."):
            yield "", posixpath.join(folder, document.CONFIG), config
        for reference, path in document.list_references(source, xml.XmlText.of(text).data):
            place = source.resolver.place(reference)
            yield reference, place and posixpath.normpath(posixpath.join(folder, place)), path
