"""The files that make up an MJCF, and the one tree that MuJoCo sees: includes are replaced by what they include."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from meshforge.errors import AssetError
from meshforge.files import is_file, plain_path, relative_name
from meshforge.formats.triangles import contents
from meshforge.formats.xml import Element, Text, parsed

_DEEPEST = 100  # includes one in another; no author nests so far


@dataclass(frozen=True, eq=False, slots=True)
class Source:
    """An authored file: the main one, or one that is included.

    path: absolute; place: its path relative to the main file's folder, where an output has it too, None for one that
    is included by an absolute path; reference: as the `<include>` has it, empty for the main file.
    """

    path: Path
    place: str | None
    reference: str
    raw: bytes

    @property
    def text(self) -> Text:
        """The text in which offsets of elements count."""
        return Text.of(self.raw)


@dataclass(slots=True, eq=False)
class Node:
    """An element in the tree of all files, and which of the sources it stands in."""

    element: Element
    source: int
    children: list[Node] = field(default_factory=list)

    @property
    def tag(self) -> str:
        return self.element.tag

    @property
    def attributes(self) -> dict[str, str]:
        return self.element.attributes

    def each(self, tag: str) -> Iterator[Node]:
        """The direct children of that tag."""
        return (child for child in self.children if child.tag == tag)

    def walk(self) -> Iterator[Node]:
        """This node and all below it, in document order."""
        waiting = [self]
        while waiting:
            node = waiting.pop()
            yield node
            waiting.extend(reversed(node.children))


@dataclass(frozen=True, eq=False, slots=True)
class Tree:
    """All files of an MJCF as one tree without includes.

    faults: what MuJoCo refuses of the includes themselves; files: contents that count instead of those on disk.
    """

    root: Node
    sources: tuple[Source, ...]
    faults: tuple[str, ...]
    files: Mapping[Path, bytes]

    @property
    def main(self) -> Source:
        return self.sources[0]

    def where(self, node: Node) -> str:
        """`file:line` of an element."""
        return f"{self.sources[node.source].path}:{node.element.line}"

    def has(self, path: Path) -> bool:
        """Whether a file is there."""
        return path in self.files or is_file(path)


def gather(main: Path, files: Mapping[Path, bytes] | None = None) -> Tree:
    """The tree of a main file and all that it includes; files: contents that count instead of those on disk.

    An include is searched from the main file's folder, then from that of the file it stands in.
    Raises AssetError with `file:line`: a file that cannot be read, is not well formed, or is included twice.
    """
    return _Gatherer(plain_path(main), {plain_path(p): data for p, data in (files or {}).items()}).read()


class _Gatherer:
    """Reads files in the order of mention."""

    def __init__(self, main: Path, files: Mapping[Path, bytes]) -> None:
        self.main, self.files = main, files
        self.sources: list[Source] = []
        self.faults: list[str] = []

    def read(self) -> Tree:
        root = self._parse(self.main, "")
        return Tree(self._build_node(root, 0), tuple(self.sources), tuple(self.faults), self.files)

    def _parse(self, path: Path, reference: str) -> Element:
        raw = self.files[path] if path in self.files else contents(path)
        absolute = bool(reference) and Path(reference).is_absolute()
        place = None if absolute else relative_name(path, self.main.parent)
        text = Text.of(raw)
        self.sources.append(Source(path, place, reference, raw))
        if text.encoding.startswith("utf-16"):
            self.faults.append(f"{path.name} is text in UTF-16")
        return parsed(text.data, str(path))

    def _build_node(self, element: Element, source: int, depth: int = 0) -> Node:
        top = Node(element, source)
        waiting = [top]
        while waiting:
            node = waiting.pop()
            for child in node.element.children:
                if child.tag == "include":
                    made = self._resolve_include(child, node.source, depth)
                else:
                    made = [Node(child, node.source)]
                    waiting.extend(made)
                node.children += made
        return top

    def _resolve_include(self, include: Element, source: int, depth: int) -> list[Node]:
        """What stands in the place of an `<include>`."""
        where = f"{self.sources[source].path}:{include.line}"
        reference = include.attributes.get("file", "").strip()
        if not reference:
            raise AssetError("this <include> names no file", where=where)
        path = self._find(reference, source)
        if path is None:
            looked = " and ".join(dict.fromkeys(str(p) for p in self._list_candidates(reference, source)))
            raise AssetError(
                f"the included file {reference!r} is not there", where=where, remedy=f"Looked for {looked}."
            )
        if any(known.path == path for known in self.sources) or depth > _DEEPEST:
            raise AssetError(
                f"{reference!r} is included twice, or includes itself",
                where=where,
                remedy="MuJoCo includes a file at most once; take this <include> away.",
            )
        root = self._parse(path, reference)
        if not root.children:
            self.faults.append(f"the included file {reference!r} is empty")
        return self._build_node(root, len(self.sources) - 1, depth + 1).children

    def _find(self, reference: str, source: int) -> Path | None:
        return next((p for p in self._list_candidates(reference, source) if p in self.files or is_file(p)), None)

    def _list_candidates(self, reference: str, source: int) -> list[Path]:
        """Where an included file may be: from the main file's folder, from that of the file which includes it."""
        folders = (self.main.parent, self.sources[source].path.parent)
        return [Path(os.path.normpath(folder / reference.replace("\\", "/"))) for folder in folders]
