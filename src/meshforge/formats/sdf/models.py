"""The models of an SDF with all that they include; their links and collisions, placed in the root frame."""

import posixpath
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from meshforge.common import AssetError, join_names
from meshforge.formats import link_reader, mesh_reader, references
from meshforge.formats.meshfile.surface import RawSurface
from meshforge.formats.sdf.document import ModelResolver, SdfSource, Version, parse_root
from meshforge.formats.sdf.frames import MODEL, WORLD, FrameTable, SdfFrame, is_true, pose_of, text_of
from meshforge.formats.xml import Element, XmlText
from meshforge.geometry import Pose
from meshforge.symbolic import FileNote

_DEEPEST = 50  # models one in another; no author nests so far
_MOST_MODELS = 5000  # models of one asset, so that includes of includes end


@dataclass(frozen=True, slots=True)
class _File:
    number: int
    root: Element
    version: Version


@dataclass(frozen=True, slots=True, eq=False)
class ModelScope:
    """A model as it stands somewhere, or the world.

    path: of its frame, with which those of all that is named in it begin; prefix: of the names of its bodies; source:
    its file, of the absolute path `where`; depth: the number of models around it, and itself.
    """

    path: str
    prefix: str
    element: Element
    source: _File
    where: str
    depth: int = 0


@dataclass(frozen=True, eq=False, slots=True)
class SdfLink(link_reader.Link):
    """A `<link>` of a model."""

    scope: ModelScope


@dataclass(slots=True, eq=False)
class ModelTree:
    """All files as one tree. root: what holds the models; worlds: names of worlds in it, which are read only; scopes:
    the models, each before those within, in the order of the files; links: by the names of their bodies."""

    root: Element
    version: Version
    sources: list[SdfSource] = field(default_factory=list)
    worlds: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    scopes: list[ModelScope] = field(default_factory=list)
    frames: FrameTable = field(default_factory=FrameTable)
    links: dict[str, SdfLink] = field(default_factory=dict)

    def pose_in_link(self, link: link_reader.Link, element: Element) -> Pose:
        """Return root_T_element of something in a link, whose pose counts from that or from a frame of its model."""
        at, scope = pose_of(element, link.where), self.links[link.body].scope
        if not at.base:
            return link.pose @ at.pose
        return self.frames.pose_of(scope.path, at.base, f"{link.where}:{at.line}") @ at.pose


class ModelReader:
    """Reads the models of the file at an absolute path, and of those it includes, into `tree`.

    Raises AssetError with `file:line`: text that is not understood, a model that is not there or includes itself, no
    link at all, two models or links of one name, a frame that is not there.
    """

    def __init__(self, path: Path, roots: tuple[Path, ...]) -> None:
        self.roots = roots
        self.files: dict[Path, _File] = {}
        self.sources: list[SdfSource] = []
        self.links: dict[str, tuple[ModelScope, str, Element]] = {}
        main = self._open_file(path, path.name, "")
        worlds = list(main.root.each("world"))
        around = ModelScope("", "", worlds[0] if worlds else main.root, main, str(path))
        self.tree = ModelTree(around.element, main.version, self.sources)
        self.tree.worlds = [world.attributes.get("name", "") for world in worlds]
        self._add_frames(around, around.element.children if worlds else ())
        models = [model for holder in (main.root, *worlds) for model in holder.each("model")]
        includes = [include for world in worlds for include in world.each("include")]
        alone = len(models) == 1 and not includes
        for element in sorted((*models, *includes), key=lambda e: e.start):
            if element.tag == "include":
                self._add_include(around, element, [path])
            else:
                self._add_model(around, element, main, None, [path], "" if alone else None)
        if not self.tree.scopes:
            raise AssetError("there is no <model> in it", where=str(path))
        if len(models) > 1 and not worlds:
            text = f"it holds {len(models)} models, of which new Gazebo takes the first alone"
            self.tree.notes.append(FileNote(text))
        self._place_links(path)

    def _open_file(self, path: Path, place: str | None, reference: str) -> _File:
        if path in self.files:
            number = self.files[path].number
            self.sources[number] = replace(self.sources[number], count=self.sources[number].count + 1)
            return self.files[path]
        raw = mesh_reader.read_content(path)
        root, version = parse_root(XmlText.of(raw).data, str(path))
        self.sources.append(SdfSource(path, place, reference, raw, ModelResolver(path.parent, self.roots)))
        self.files[path] = _File(len(self.sources) - 1, root, version)
        return self.files[path]

    def _add_model(
        self,
        around: ModelScope,
        element: Element,
        file: _File,
        include: Element | None,
        files: list[Path],
        prefix: str | None = None,
    ) -> None:
        name = text_of(include, "name") or element.attributes.get("name", "")
        prefix = f"{around.prefix}{name}::" if prefix is None else prefix
        scope = ModelScope(f"{around.path}{name}::", prefix, element, file, str(files[-1]), around.depth + 1)
        self.tree.scopes.append(scope)
        self._refuse_too_many(scope)
        self._add_model_frame(around, scope, name, include)
        for link in element.each("link"):
            self._add_link(scope, link)
        self._add_frames(scope, element.children)
        for child in element.children:
            if child.tag == "model":
                self._add_model(scope, child, file, None, files)
            elif child.tag == "include":
                self._add_include(scope, child, files)

    def _add_model_frame(self, around: ModelScope, scope: ModelScope, name: str, include: Element | None) -> None:
        is_placed = include is not None and include.first("pose") is not None
        owner, where = (include, around.where) if is_placed else (scope.element, scope.where)
        at = pose_of(owner, where)
        if scope.path in self.tree.frames.by_path:
            line = include.line if include else scope.element.line
            problem, remedy = f"model {name!r} is there twice", "Give one of them another <name>."
            raise AssetError(problem, where=f"{around.where}:{line}", remedy=remedy)
        attributes, link = scope.element.attributes, scope.element.first("link")
        first = attributes.get("canonical_link") or (link.attributes.get("name", "") if link else "")
        placement = text_of(include, "placement_frame") or attributes.get("placement_frame", "")
        self.tree.frames.by_path[scope.path] = SdfFrame(
            around.path, at.pose, at.base, f"{where}:{at.line}", f"{name}::{first}" * bool(first), "", placement
        )

    def _refuse_too_many(self, scope: ModelScope) -> None:
        if len(self.tree.scopes) > _MOST_MODELS or scope.depth > _DEEPEST + 1:
            many = f"{_MOST_MODELS:,} models" if scope.depth <= _DEEPEST + 1 else f"{_DEEPEST} models, one in another"
            place = f"{scope.where}:{scope.element.line}"
            raise AssetError(f"more than {many}", where=place, remedy="No model is made of so many.")

    def _add_include(self, around: ModelScope, include: Element, files: list[Path]) -> None:
        where = f"{files[-1]}:{include.line}"
        uri = text_of(include, "uri")
        if is_true(include.attributes.get("merge", "")):
            remedy = "Remove the attribute merge, or write the included model into the file: gz sdf -p FILE > NEW.sdf."
            raise AssetError('<include merge="true"> is not read', where=where, remedy=remedy)
        if not uri:
            raise AssetError("this <include> names no model: it has no <uri>", where=where)
        outer = self.sources[around.source.number]
        path = None if references.is_address(uri) else outer.resolver.find_model_file(uri)
        if path is None:
            problem = f"the included model {uri!r} is not there"
            raise AssetError(problem, where=where, remedy=outer.resolver.advise_on_model(uri))
        if path in files:
            raise AssetError(f"{uri!r} includes itself", where=where, remedy="Take this <include> away.")
        try:
            file = self._open_file(path, _output_place(outer, uri, path), uri)
        except AssetError as error:
            problem = f"the included model {uri!r} cannot be read: {error.sentence}"
            raise AssetError(problem, where=where) from error
        if (model := file.root.first("model")) is not None:
            self._add_model(around, model, file, include, [*files, path])
        else:
            self.tree.notes.append(f"the included file {uri!r} has no model: passed over")

    def _add_link(self, scope: ModelScope, link: Element) -> None:
        name, place = link.attributes.get("name"), f"{scope.where}:{link.line}"
        if not name:
            raise AssetError("a <link> has no name", where=place)
        body = f"{scope.prefix}{name}"
        if body in self.links:
            problem = f"link {body!r} is there twice, first on line {self.links[body][2].line}"
            raise AssetError(problem, where=place, remedy="Rename one of them.")
        self.links[body] = scope, name, link
        self._add_frame(scope, name, link, body=body)

    def _add_frames(self, scope: ModelScope, elements: Iterable[Element]) -> None:
        for child in elements:
            if name := child.attributes.get("name", ""):
                if child.tag == "joint":
                    end = text_of(child, "child")
                    self._add_frame(scope, name, child, "" if end == WORLD else end)
                elif child.tag == "frame":
                    self._add_frame(scope, name, child, child.attributes.get("attached_to", ""))

    def _add_frame(self, scope: ModelScope, name: str, element: Element, attached: str = "", body: str = "") -> None:
        at = pose_of(element, scope.where)
        frame = SdfFrame(scope.path, at.pose, at.base or attached, f"{scope.where}:{at.line}", attached or MODEL, body)
        self.tree.frames.by_path.setdefault(f"{scope.path}{name}", frame)

    def _place_links(self, path: Path) -> None:
        if not self.links:
            raise AssetError("there is no <link> in it", where=str(path))
        tree = self.tree
        for body, (scope, name, element) in self.links.items():
            pose = tree.frames.pose_of(scope.path, name, f"{scope.where}:{element.line}")
            resolver = self.sources[scope.source.number].resolver
            tree.links[body] = SdfLink(body, element, pose, scope.where, resolver, scope)


def read_submesh(mesh: Element) -> tuple[str, ...]:
    """Return the submesh that a `<mesh>` uses: its name, and `center` where it is moved; nothing for all."""
    submesh = mesh.first("submesh")
    name = text_of(submesh, "name")
    if not name or name == "__default__":
        return ()
    return (name, "center") if is_true(text_of(submesh, "center")) else (name,)


class SdfMeshes(link_reader.CollisionMeshes):
    """The mesh files of an SDF, of which elements use submeshes."""

    def select(self, surfaces: Sequence[RawSurface], part: tuple[str, ...]) -> Sequence[RawSurface]:
        """Return what a part of `read_submesh` stands for, in metres: Gazebo obeys the unit of a Collada file.

        Raises AssetError: there is no such submesh.
        """
        found = [s for s in surfaces if not part or s.name == part[0]]
        if not found:
            names = [s.name for s in surfaces if s.name]
            remedy = f"Its submeshes are {join_names(names, 5)}." if names else "None of its submeshes has a name."
            raise AssetError(f"the mesh has no submesh {part[0]!r}", remedy=remedy)
        scaled = [replace(s, vertices=s.vertices * s.unit, unit=1.0) if s.unit != 1.0 else s for s in found]
        if "center" not in part[1:]:
            return scaled
        used = np.concatenate([s.vertices[np.unique(s.faces)] for s in scaled])
        middle = (used.min(axis=0) + used.max(axis=0)) / 2
        return [replace(s, vertices=s.vertices - middle) for s in scaled]


def _output_place(outer: SdfSource, uri: str, path: Path) -> str | None:
    """Where an output has an included file, relative to the main file's folder; None for one at an absolute path."""
    if outer.place is None:
        return None
    folder = uri.rstrip("/")
    for reference in (f"{folder}/{path.name}", folder):
        place = outer.resolver.place(reference)
        if place is not None and outer.resolver.find(reference) == path:
            return posixpath.normpath(posixpath.join(posixpath.dirname(outer.place), place))
    return None
