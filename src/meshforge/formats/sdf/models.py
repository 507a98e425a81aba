"""The models of an SDF with all that they include, as one tree of scopes; their links and collisions, placed in the
root frame."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path

from meshforge.common import AssetError
from meshforge.formats import mesh_reader, references
from meshforge.formats.sdf.document import RELATIVE_TO, ModelResolver, SdfSource, Version, parse_root
from meshforge.formats.sdf.frames import MODEL, WORLD, FramePlaces, ModelScope, SdfFrame, is_true, pose_of, text_of
from meshforge.formats.xml import Element, XmlText
from meshforge.geometry import Pose

_DEEPEST = 50  # models one in another; no author nests so far
_MOST_MODELS = 5000  # models of one asset, so that includes of includes end


@dataclass(slots=True, eq=False)
class ModelTree:
    """All files as one tree. root: the scope around all models; worlds: names of worlds in it, which are read only."""

    root: ModelScope
    sources: list[SdfSource]
    worlds: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)

    def scopes(self) -> Iterator[ModelScope]:
        """The models, each before those within, in the order of the files."""
        waiting = list(reversed(self.root.inner))
        while waiting:
            scope = waiting.pop()
            yield scope
            waiting.extend(reversed(scope.inner))


def compose_models(path: Path, roots: tuple[Path, ...]) -> ModelTree:
    """The models of the file at an absolute path, and of those it includes.

    Raises AssetError with `file:line`: text that is not understood, a model that is not there or includes itself.
    """
    return _Composer(path, roots).models


@dataclass(frozen=True, slots=True)
class _File:
    number: int
    root: Element
    version: Version


class _Composer:
    def __init__(self, path: Path, roots: tuple[Path, ...]) -> None:
        self.roots, self.count = roots, 0
        self.files: dict[Path, _File] = {}
        self.sources: list[SdfSource] = []
        main = self._open_file(path, path.name, "")
        world = main.root.first("world")
        around = ModelScope("", world or main.root, 0, str(path), main.version, is_world=True)
        self.models = ModelTree(around, self.sources)
        if world is not None:
            self.models.worlds = [w.attributes.get("name", "") for w in main.root.each("world")]
            self._add_frames(around, world)
        models = [model for holder in (main.root, *main.root.each("world")) for model in holder.each("model")]
        includes = [include for holder in main.root.each("world") for include in holder.each("include")]
        alone = len(models) == 1 and not includes
        for element in sorted((*models, *includes), key=lambda e: e.start):
            if element.tag == "include":
                self._add_include(around, element, [path])
            else:
                self._add_model(around, element, main, None, [path], "" if alone else None)
        if not around.inner:
            raise AssetError("there is no <model> in it", where=str(path))
        for scope in self.models.scopes():
            self._repair_old_frames(scope)
        if len(models) > 1 and world is None:
            self.models.notes.append(f"it holds {len(models)} models, of which new Gazebo takes the first alone")

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
        prefix: str | None,
    ) -> None:
        """Add a `<model>` to the scope around it; files: those that are open, the innermost last."""
        where = str(files[-1])
        self._refuse_too_many(around, element, where)
        merged = include is not None and is_true(include.attributes.get("merge", ""))
        name = text_of(include, "name") or element.attributes.get("name", "")
        if prefix is None:
            prefix = around.prefix if merged else f"{around.prefix}{name}::"
        scope = ModelScope(prefix, element, file.number, where, file.version, merged=merged)
        frame = self._frame_of(around, element, include, where)
        frame.inside, scope.frame = scope, frame
        self._add_links(scope)
        self._add_frames(scope, element)
        for child in element.children:
            if child.tag == "model":
                self._add_model(scope, child, file, None, files, None)
            elif child.tag == "include":
                self._add_include(scope, child, files)
        around.inner.append(scope)
        if merged:
            for known in (*scope.frames, *scope.through):
                around.through.setdefault(known, scope)
        elif name:
            around.frames.setdefault(name, frame)

    def _frame_of(self, around: ModelScope, element: Element, include: Element | None, where: str) -> SdfFrame:
        """The frame of a model in the scope around it; what an include says goes before what the model does."""
        placement = element.attributes.get("placement_frame", "")
        owner = element
        if include is not None:
            placement = text_of(include, "placement_frame") or placement
            if include.first("pose") is not None:
                owner, where = include, str(self.sources[around.source].path)
        at = pose_of(owner, where)
        return SdfFrame(around, at.pose, at.base, f"{where}:{at.line}", placement=placement)

    def _refuse_too_many(self, around: ModelScope, element: Element, where: str) -> None:
        self.count += 1
        depth, at = 0, around
        while at.frame is not None:
            depth, at = depth + 1, at.frame.scope
        if self.count > _MOST_MODELS or depth > _DEEPEST:
            many = f"{_MOST_MODELS:,} models" if self.count > _MOST_MODELS else f"{_DEEPEST} models, one in another"
            problem = f"more than {many}"
            raise AssetError(problem, where=f"{where}:{element.line}", remedy="No model is made of so many.")

    def _add_include(self, around: ModelScope, include: Element, files: list[Path]) -> None:
        where = f"{files[-1]}:{include.line}"
        uri = text_of(include, "uri")
        if not uri:
            raise AssetError("this <include> names no model: it has no <uri>", where=where)
        outer = self.sources[around.source]
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
        models = list(file.root.each("model"))
        if not models:
            self.models.notes.append(f"the included file {uri!r} has no model: passed over")
            return
        self._add_model(around, models[0], file, include, [*files, path], None)

    def _add_links(self, scope: ModelScope) -> None:
        for link in scope.element.each("link"):
            name, place = link.attributes.get("name"), f"{scope.where}:{link.line}"
            if not name:
                raise AssetError("a <link> has no name", where=place)
            if name in scope.links:
                problem = f"link {name!r} is there twice, first on line {scope.links[name].line}"
                raise AssetError(problem, where=place, remedy="Rename one of them.")
            scope.links[name] = link
            self._add_frame(scope, name, link, "", True)

    def _add_frames(self, scope: ModelScope, element: Element) -> None:
        """The frames of joints and of `<frame>` elements."""
        for child in element.children:
            name = child.attributes.get("name", "")
            if child.tag == "joint" and name:
                end = text_of(child, "child")
                self._add_frame(scope, name, child, "" if end == WORLD else end, False)
            elif child.tag == "frame" and name and scope.version >= RELATIVE_TO:
                self._add_frame(scope, name, child, child.attributes.get("attached_to", ""), False)
            elif child.tag == "frame" and name:
                self._add_frame(scope, name, child, "", False)

    def _repair_old_frames(self, scope: ModelScope) -> None:
        """Let frames of old files whose `frame`, which few readers saw, is not there count from their usual base."""
        if scope.version < RELATIVE_TO:
            for name, frame in scope.frames.items():
                if not scope.has(frame.base):
                    self.models.notes.append(f"the pose of {name!r} counts from {frame.base!r}, which is not there")
                    frame.base = frame.attached if scope.has(frame.attached) else ""

    def _add_frame(self, scope: ModelScope, name: str, element: Element, attached: str, link: bool) -> None:
        at = pose_of(element, scope.where)
        frame = SdfFrame(scope, at.pose, at.base or attached, f"{scope.where}:{at.line}", link, attached)
        scope.frames.setdefault(name, frame)


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


@dataclass(frozen=True, eq=False, slots=True)
class SdfLink:
    """A `<link>` as a body: its name in the asset, its scope, and root_T_link."""

    body: str
    scope: ModelScope
    element: Element
    pose: Pose

    @property
    def where(self) -> str:
        return self.scope.where


@dataclass(frozen=True, eq=False, slots=True)
class SdfCollision:
    """A `<collision>` of a link."""

    link: SdfLink
    element: Element
    pose: Pose


@dataclass(frozen=True, eq=False, slots=True)
class SdfLinks:
    """The links by the names of their bodies, their collisions in order, and where frames are."""

    by_body: dict[str, SdfLink]
    collisions: tuple[SdfCollision, ...]
    places: FramePlaces


def place_links(composed: ModelTree) -> SdfLinks:
    """The links of all models, placed.

    Raises AssetError with `where:line`: no link at all, two of one name, a frame that is not there.
    """
    places = FramePlaces()
    found: dict[str, SdfLink] = {}
    for scope, name, link in ((within, *named) for within in composed.scopes() for named in within.links.items()):
        body, place = f"{scope.prefix}{name}", f"{scope.where}:{link.line}"
        pose = places.pose_of(scope, name, place)
        if body in found:
            problem = f"link {body!r} is there twice, in two models that are merged or of one name"
            raise AssetError(problem, where=place, remedy="Rename one of them.")
        found[body] = SdfLink(body, scope, link, pose)
    if not found:
        raise AssetError("there is no <link> in it", where=composed.root.where)
    collisions = tuple(
        SdfCollision(link, element, pose_in_link(places, link, element))
        for link in found.values()
        for element in link.element.each("collision")
    )
    return SdfLinks(found, collisions, places)


def pose_in_link(places: FramePlaces, link: SdfLink, element: Element) -> Pose:
    """root_T_element of something in a link, whose pose counts from the link or from a frame of its model."""
    at = pose_of(element, link.where)
    if not at.base or (link.scope.version < RELATIVE_TO and not link.scope.has(at.base)):
        return link.pose @ at.pose
    scope = link.scope
    while at.base == MODEL and scope.merged and scope.frame is not None:  # as libsdformat has it
        scope = scope.frame.scope
    return places.pose_of(scope, at.base, f"{link.where}:{at.line}") @ at.pose
