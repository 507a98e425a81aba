"""Writing an edited SDF: its files with other collisions, all else byte for byte as it was, and masses kept where
Gazebo would compute others."""

from __future__ import annotations

import posixpath
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from meshforge.common import AssetError, join_names
from meshforge.formats import collision_pieces, mesh_output
from meshforge.formats.base import Mass, Output
from meshforge.formats.references import add_copy, note_absolute
from meshforge.formats.sdf import document, elements, shapes
from meshforge.formats.slots import (
    ElementMaker,
    ElementPlan,
    Slot,
    assign_names,
    name_attribute_of,
    refuse_unknown_link,
)
from meshforge.formats.xml import Element, Splice, XmlText, apply_splices, indent_of, newline_of
from meshforge.geometry import Capsule, Ellipsoid, Pose
from meshforge.symbolic import Asset, Geom

_REMEDY = "Rename one of them, or put both under one folder."


def write_sdf(asset: Asset, origin: document.SdfDocument, name: str, mass: Mass) -> Output:
    """The files of an asset that was read from an SDF; without an edit, their own bytes.

    Raises AssetError: an edit of a world or of a model that is included several times, a hull on a link that is not
    there, a mesh file that changed since the asset was read, or a mass of which a part is not known.
    """
    for geom in asset.geoms:
        refuse_unknown_link(geom, origin.links, str(asset.path))
    edit = _FileEdits(asset, origin, Path(name).stem)
    names = assign_names([slot for plan in edit.plans for slot in plan.slots])
    texts = [edit.build_text(number, mass) for number in range(len(origin.sources))]
    copies, notes = list_copies(origin.sources, texts, name)
    made = edit.mesh_files
    for source, text in zip(origin.sources[1:], texts[1:], strict=True):
        if source.place is not None:
            made[source.place] = text
    return Output(texts[0], made, copies, (*edit.notes, *notes), names)


class _FileEdits:
    def __init__(self, asset: Asset, origin: document.SdfDocument, stem: str) -> None:
        self.asset, self.document, self.stem = asset, origin, stem
        self.kept = collision_pieces.SourceMeshes(origin.digests, str(asset.path), shapes.select_submesh)
        self.taken: set[str] = set()
        self.plans: list[ElementPlan] = []
        self.makers: list[SdfElementMaker] = []
        for number in range(len(origin.sources)):
            self._plan_source(number)

    @property
    def mesh_files(self) -> dict[str, bytes]:
        """The mesh files of all files' hulls, from the main one."""
        found: dict[str, bytes] = {}
        for maker, source in zip(self.makers, self.document.sources, strict=True):
            folder = posixpath.dirname(source.place or "")
            found |= {posixpath.normpath(posixpath.join(folder, key)): v for key, v in maker.files.made.items()}
        return found

    @property
    def notes(self) -> list[str]:
        return [note for maker in self.makers for note in maker.notes]

    def build_text(self, number: int, mass: Mass) -> bytes:
        """The text of a file. Raises AssetError where it cannot be edited."""
        plan, source = self.plans[number], self.document.sources[number]
        edits = plan.splices
        if not edits:
            return source.raw
        self._refuse_fixed(source)
        if mass == "keep":
            edits += keep_masses(self.asset, self.document, plan)
        data = apply_splices(plan.maker.data, edits)
        return source.raw if data == plan.maker.data else source.text.encode(data)

    def _plan_source(self, number: int) -> None:
        source = self.document.sources[number]
        data = source.text.data
        root, version = document.parse_root(data, str(source.path))
        at = {element.start: element for element in root.walk()}
        own = [k for k, place in enumerate(self.document.at) if place.source == number]
        links = {body: at[place.start] for body, place in self.document.links.items() if place.source == number}
        files = mesh_output.HullFiles(self.stem, source.resolver, self.taken)
        files.avoid(document.references(root))
        folder = _first_mesh_folder(root, files)
        maker = SdfElementMaker(data, newline_of(data), files, folder, self.kept, version=version)
        asset = replace(self.asset, geoms=tuple(geom for geom in self.asset.geoms if geom.body in links))
        authored, at_own = [self.document.authored[k] for k in own], [at[self.document.at[k].start] for k in own]
        self.plans.append(ElementPlan(asset, authored, at_own, links, maker))
        self.makers.append(maker)

    def _refuse_fixed(self, source: document.SdfSource) -> None:
        origin, where = self.document, str(self.asset.path)
        if origin.worlds:
            worlds = join_names(origin.worlds, 2)
            remedy = "Put its <model> into a file of its own (<sdf><model>), and edit that."
            raise AssetError(f"this is a world ({worlds}), which is only read", where=where, remedy=remedy)
        if source.count > 1 or source.place is None:
            why = f"is included {source.count} times" if source.count > 1 else "is included by an absolute path"
            problem = f"{source.reference!r} {why}: it is not edited here"
            raise AssetError(problem, where=where, remedy=f"Edit {source.path} itself.")


def _first_mesh_folder(root: Element, files: mesh_output.HullFiles) -> str:
    kinds = (document.geometry_of(element) for element in root.walk() if element.tag == "collision")
    return files.folder_of(
        next((document.mesh_uri(kind) for kind in kinds if kind is not None and kind.tag == "mesh"), None)
    )


@dataclass(frozen=True, eq=False, slots=True)
class SdfElementMaker(ElementMaker):
    """Makes elements for one file."""

    version: document.Version = field(kw_only=True)

    @property
    def title(self) -> str:
        return f"SDF {'.'.join(map(str, self.version))}"

    def find_mesh(self, collision: Element) -> str | None:
        mesh = document.geometry_of(collision)
        return document.mesh_uri(mesh) if mesh is not None and mesh.tag == "mesh" else None

    def make_slot(self, geom: Geom, root_t_link: Pose, template: Element | None, lead: bytes) -> Slot:
        shape = geom.shape.move(root_t_link.inverse())
        is_known = self.version >= document.ROUND_SHAPES or not isinstance(shape, Capsule | Ellipsoid)
        if isinstance(shape, elements.SdfShape) and is_known:
            pose, kind = shape.pose, elements.native_lines(shape)
        else:
            pose, kind = Pose.identity(), elements.mesh_lines(self.make_mesh(geom, shape, template))
        if template is None:
            slot = Slot(geom.body, (geom.name,), text=elements.build_collision(pose, kind, lead, self.line_end))
        else:
            old = document.geometry_of(template)
            assert old is not None  # only elements with pieces are copied
            if b"\n" not in self.data[old.start : old.end]:  # all in one line
                kind = [b"".join(line.strip() for line in kind)]
            edits = elements.replace_geometry(self.data, template, pose, kind)
            slot = Slot(geom.body, (geom.name,), None, template, edits, copy=True)
        slot.name = name_attribute_of(slot)  # SDF asks for one
        return slot

    def extract_piece(self, element: Element, name: str, k: int) -> tuple[Splice, ...]:
        mesh = document.geometry_of(element)
        assert mesh is not None  # only meshes have several pieces
        _, made = self.make_piece(document.mesh_uri(mesh), shapes.read_submesh(mesh), name, k)
        return elements.replace_mesh_file(self.data, mesh, made)


def keep_masses(asset: Asset, origin: document.SdfDocument, plan: ElementPlan) -> list[Splice]:
    """The edits that make computed masses of the links that are edited explicit.

    Raises AssetError for a link of which a collision is no hull, so that its mass is not known.
    """
    edited = {slot.body for _, slots in plan.places for slot in slots if not slot.is_untouched}
    edited |= {one.link for one, (_, slots) in zip(plan.authored, plan.places, strict=True) if not slots}
    edited |= plan.ends.keys()
    known = {inertial.body: inertial for inertial in asset.mechanism.inertials}
    edits = []
    for body in sorted(edited & set(origin.computed)):
        element = plan.links[body].first("inertial")
        assert element is not None  # it says that the mass is computed
        if body not in known:
            raise AssetError(
                f"Gazebo computes the mass of link {body!r} of collisions that are not all hulls: it is not known here",
                where=str(asset.path),
                remedy="Leave it to the new collisions (--mass recompute), or say it in the file.",
            )
        lead = indent_of(plan.maker.data, element.start) or b""
        lines = elements.inertial_lines(known[body], asset.body_poses[body])
        edits.append(Splice(element.start, element.end, (newline_of(plan.maker.data) + lead).join(lines)))
    return edits


def list_copies(
    sources: Sequence[document.SdfSource], texts: Sequence[bytes], name: str
) -> tuple[dict[str, Path], list[str]]:
    """The files, and notes on those that stay where they are; texts: of the sources as they are written; name: of the
    main one, whose `model.config` goes along where that names a file of that name.

    Raises AssetError where two of them would become one.
    """
    copies: dict[str, Path] = {}
    notes = []
    for number, (source, text) in enumerate(zip(sources, texts, strict=True)):
        if source.place is None:
            notes.append(note_absolute(source.reference))
            continue
        folder = posixpath.dirname(source.place)
        config = source.path.parent / document.CONFIG
        if config.is_file() and (number or source.path.name == name) and not folder.startswith(".."):
            add_copy(copies, posixpath.join(folder, document.CONFIG), config, _REMEDY)
        for reference, path in _find_references(source, text):
            place = source.resolver.place(reference)
            if place is None:
                notes.append(note_absolute(reference))
            else:
                add_copy(copies, posixpath.normpath(posixpath.join(folder, place)), path, _REMEDY)
    return copies, notes


def _find_references(source: document.SdfSource, text: bytes) -> list[tuple[str, Path]]:
    root, _ = document.parse_root(XmlText.of(text).data, str(source.path))
    found = [(reference, source.resolver.find(reference)) for reference in document.references(root)]
    return [(reference, path) for reference, path in found if path is not None] + list(document.find_scripts(source))
