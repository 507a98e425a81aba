"""Writing an edited SDF: its files with other collisions, all else byte for byte as it was."""

from __future__ import annotations

import posixpath
from dataclasses import replace
from pathlib import Path

from meshforge.asset import Asset
from meshforge.errors import AssetError, nearest
from meshforge.formats.base import Mass, Output
from meshforge.formats.collision_meshes import KeptMeshes
from meshforge.formats.element_names import settle
from meshforge.formats.element_plan import Plan
from meshforge.formats.hull_files import HullFiles
from meshforge.formats.sdf.document import SdfDocument
from meshforge.formats.sdf.files.elements import geometry_of, mesh_uri, references, root_of
from meshforge.formats.sdf.files.sources import Source
from meshforge.formats.sdf.writing.copies import copies_of
from meshforge.formats.sdf.writing.kept_masses import kept_masses
from meshforge.formats.sdf.writing.made import Maker
from meshforge.formats.xml import Element, newline, spliced
from meshforge.words import listed


def write_sdf(asset: Asset, document: SdfDocument, name: str, mass: Mass) -> Output:
    """The files of an asset that was read from an SDF; without an edit, their own bytes.

    Raises AssetError: an edit of a world or of a model that is included several times, a hull on a link that is not
    there, a mesh file that changed since the asset was read, or a mass of which a part is not known.
    """
    _refuse_strangers(asset, document)
    edit = _Edit(asset, document, Path(name).stem)
    names = settle([slot for plan in edit.plans for slot in plan.slots])
    texts = [edit.build_text(number, mass) for number in range(len(document.sources))]
    copies, notes = copies_of(document.sources, texts, name)
    made = edit.mesh_files
    for source, text in zip(document.sources[1:], texts[1:], strict=True):
        if source.place is not None:
            made[source.place] = text
    return Output(texts[0], made, copies, (*edit.notes, *notes), names)


def _refuse_strangers(asset: Asset, document: SdfDocument) -> None:
    """Raise AssetError for a hull on a link that no file has."""
    for geom in asset.geoms:
        if geom.body not in document.links:
            like = nearest(geom.body, document.links)
            raise AssetError(
                f"hull {geom.name!r} is on link {geom.body!r}, which is not there",
                where=str(asset.path),
                remedy=f"The nearest name of a link is {like!r}." if like else None,
            )


class _Edit:
    """The plans of all files."""

    def __init__(self, asset: Asset, document: SdfDocument, stem: str) -> None:
        self.asset, self.document, self.stem = asset, document, stem
        self.kept = KeptMeshes(document.digests, str(asset.path))
        self.taken: set[str] = set()
        self.plans: list[Plan] = []
        self.makers: list[Maker] = []
        for number in range(len(document.sources)):
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
            edits += kept_masses(self.asset, self.document, plan)
        data = spliced(plan.maker.data, edits)
        return source.raw if data == plan.maker.data else source.text.encode(data)

    def _plan_source(self, number: int) -> None:
        source = self.document.sources[number]
        data = source.text.data
        root, version = root_of(data, str(source.path))
        at = {element.start: element for element in root.walk()}
        own = [k for k, place in enumerate(self.document.at) if place.source == number]
        links = {body: at[place.start] for body, place in self.document.links.items() if place.source == number}
        files = HullFiles(self.stem, source.resolver, self.taken)
        files.avoid(references(root))
        maker = Maker(data, newline(data), version, files, _folder(root, files), self.kept)
        asset = replace(self.asset, geoms=tuple(geom for geom in self.asset.geoms if geom.body in links))
        elements = [at[self.document.at[k].start] for k in own]
        self.plans.append(Plan(asset, [self.document.authored[k] for k in own], elements, links, maker))
        self.makers.append(maker)

    def _refuse_fixed(self, source: Source) -> None:
        document, where = self.document, str(self.asset.path)
        if document.worlds:
            worlds = listed(document.worlds, 2)
            remedy = "Put its <model> into a file of its own (<sdf><model>), and edit that."
            raise AssetError(f"this is a world ({worlds}), which is only read", where=where, remedy=remedy)
        if source.count > 1 or source.place is None:
            why = f"is included {source.count} times" if source.count > 1 else "is included by an absolute path"
            problem = f"{source.reference!r} {why}: it is not edited here"
            raise AssetError(problem, where=where, remedy=f"Edit {source.path} itself.")


def _folder(root: Element, files: HullFiles) -> str:
    """The folder of the first collision mesh, as its reference has it, where hulls of no mesh's kin go."""
    kinds = (geometry_of(element) for element in root.walk() if element.tag == "collision")
    return files.folder_of(next((mesh_uri(kind) for kind in kinds if kind is not None and kind.tag == "mesh"), None))
