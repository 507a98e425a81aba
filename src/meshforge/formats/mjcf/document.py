"""What is kept of an MJCF to write it back, its files as one tree, and the names of its geoms and bodies."""

import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from meshforge.common import AssetError, MissingFilesError, is_file, plain_path, relative_name
from meshforge.formats.mesh_reader import read_content
from meshforge.formats.xml import Element, SourceFile, XmlText, parse_xml
from meshforge.symbolic import Document, unique_names

_DEEPEST = 100  # includes one in another; no author nests so far


@dataclass(frozen=True, eq=False, slots=True)
class MjcfDocument(Document):
    """The source of an asset read from an MJCF.

    sources: the authored files, main first, then in order of mention; names: of the geoms that collide; refusal:
    MuJoCo's message where it refuses the file; then only the collision geometry was read, maybe without masses.
    """

    sources: tuple[SourceFile, ...]
    names: tuple[str, ...]
    refusal: str = ""

    @property
    def tree(self) -> "MjcfTree":
        """The elements of all files, parsed from the kept bytes."""
        return read_tree(self.sources[0].path, {source.path: source.raw for source in self.sources})


def geom_names(geoms: Sequence[tuple[str, str]]) -> list[str]:
    """Return the names that geoms read as; for each, in MuJoCo's order, its body's name and its own or "".

    `body/name`, or `body/geomK` for the K-th geom of a body, visual ones counted too: so a name does not depend on
    contact bits, which a default class may set. A name that begins with `body/` is the whole name: in MuJoCo names are
    unique in the model, so an edit names a geom so where its plain name is another body's geom's already.
    """
    count: dict[str, int] = {}
    names = []
    for body, name in geoms:
        tail = name.removeprefix(f"{body}/") or f"geom{count.get(body, 0)}"
        names.append(f"{body}/{tail}")
        count[body] = count.get(body, 0) + 1
    return unique_names(names)


def body_names(names: Sequence[str]) -> list[str]:
    """Return the names of bodies in MuJoCo's order; the K-th is `bodyK` where it has none, the world is the 0-th."""
    return unique_names(name or f"body{k}" for k, name in enumerate(names))


@dataclass(slots=True, eq=False)
class MjcfNode:
    """An element in the tree of all files, and which of the sources it stands in."""

    element: Element
    source: int
    children: "list[MjcfNode]" = field(default_factory=list)

    @property
    def tag(self) -> str:
        return self.element.tag

    @property
    def attributes(self) -> dict[str, str]:
        return self.element.attributes

    def each(self, tag: str) -> "Iterator[MjcfNode]":
        """Return the direct children of that tag."""
        return (child for child in self.children if child.tag == tag)

    @property
    def is_coupling(self) -> bool:
        """Whether it is an equality by which a joint follows another one."""
        own = self.attributes
        return self.tag == "joint" and "joint2" in own and own.get("active") != "false"

    def walk(self) -> "Iterator[MjcfNode]":
        """Yield this node and all below it, in document order."""
        waiting = [self]
        while waiting:
            node = waiting.pop()
            yield node
            waiting.extend(reversed(node.children))


@dataclass(frozen=True, eq=False, slots=True)
class MjcfTree:
    """All files of an MJCF as one tree without includes.

    faults: what MuJoCo refuses of the includes themselves; files: contents that count instead of those on disk.
    """

    root: MjcfNode
    sources: tuple[SourceFile, ...]
    faults: tuple[str, ...]
    files: Mapping[Path, bytes]

    @property
    def main(self) -> SourceFile:
        return self.sources[0]

    def where(self, node: MjcfNode) -> str:
        """Return `file:line` of an element."""
        return f"{self.sources[node.source].path}:{node.element.line}"

    def has(self, path: Path) -> bool:
        """Return whether a file is there."""
        return path in self.files or is_file(path)


def read_tree(main: Path, files: Mapping[Path, bytes] | None = None) -> MjcfTree:
    """Return the tree of a main file and all that it includes; files: contents that count instead of those on disk.

    An include is searched from the main file's folder, then from that of the file it stands in.
    Raises AssetError with `file:line`: a file that cannot be read, is not well formed, or is included twice.
    """
    known = {plain_path(path): data for path, data in (files or {}).items()}
    reader = _TreeReader(plain_path(main), known)
    root = reader.build_node(reader.parse(reader.main, ""), 0)
    return MjcfTree(root, tuple(reader.sources), tuple(reader.faults), known)


class _TreeReader:
    """Reads files in the order of mention."""

    def __init__(self, main: Path, files: Mapping[Path, bytes]) -> None:
        self.main, self.files = main, files
        self.sources: list[SourceFile] = []
        self.faults: list[str] = []

    def parse(self, path: Path, reference: str) -> Element:
        raw = self.files[path] if path in self.files else read_content(path)
        absolute = bool(reference) and Path(reference).is_absolute()
        place = None if absolute else relative_name(path, self.main.parent)
        text = XmlText.of(raw)
        self.sources.append(SourceFile(path, place, reference, raw))
        if text.encoding.startswith("utf-16"):
            self.faults.append(f"{path.name} is text in UTF-16")
        return parse_xml(text.data, str(path))

    def build_node(self, element: Element, source: int, depth: int = 0) -> MjcfNode:
        top = MjcfNode(element, source)
        waiting = [top]
        while waiting:
            node = waiting.pop()
            for child in node.element.children:
                if child.tag == "include":
                    made = self._resolve_include(child, node.source, depth)
                else:
                    made = [MjcfNode(child, node.source)]
                    waiting.extend(made)
                node.children += made
        return top

    def _resolve_include(self, include: Element, source: int, depth: int) -> list[MjcfNode]:
        where = f"{self.sources[source].path}:{include.line}"
        reference = include.attributes.get("file", "").strip()
        if not reference:
            raise AssetError("this <include> names no file", where=where)
        folders = (self.main.parent, self.sources[source].path.parent)
        candidates = [Path(os.path.normpath(folder / reference.replace("\\", "/"))) for folder in folders]
        path = next((path for path in candidates if path in self.files or is_file(path)), None)
        if path is None:
            remedy = f"Looked for {' and '.join(dict.fromkeys(map(str, candidates)))}."
            problem = f"the included file {reference!r} is not there"
            raise MissingFilesError(problem, missing=(reference,), where=where, remedy=remedy)
        if any(known.path == path for known in self.sources) or depth > _DEEPEST:
            problem = f"{reference!r} is included twice, or includes itself"
            remedy = "MuJoCo includes a file at most once; take this <include> away."
            raise AssetError(problem, where=where, remedy=remedy)
        root = self.parse(path, reference)
        if not root.children:
            self.faults.append(f"the included file {reference!r} is empty")
        return self.build_node(root, len(self.sources) - 1, depth + 1).children
