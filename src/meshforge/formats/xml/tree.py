"""The elements of an XML text with their places in it, read by a parser that follows no entity and no address."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NoReturn
from xml.parsers import expat

from meshforge.errors import AssetError
from meshforge.formats.xml.text import blanked

_TAG_END = re.compile(rb"(?:[^\"'>]++|\"[^\"]*\"|'[^']*')*+>")


@dataclass(slots=True, eq=False)
class Element:
    """An element and where it lies: bytes [start, end) with its start tag [start, inside), on `line`.

    text: the characters that stand directly in it, comments and raw text left out.
    """

    tag: str
    attributes: dict[str, str]
    line: int
    start: int
    inside: int
    end: int = -1
    children: list[Element] = field(default_factory=list)
    text: str = ""

    def each(self, tag: str) -> Iterator[Element]:
        """The direct children of that tag."""
        return (child for child in self.children if child.tag == tag)

    def first(self, tag: str) -> Element | None:
        """The first direct child of that tag."""
        return next(self.each(tag), None)

    def walk(self) -> Iterator[Element]:
        """This element and all below it, in order of their start tags."""
        waiting = [self]
        while waiting:
            element = waiting.pop()
            yield element
            waiting.extend(reversed(element.children))


def parsed(data: bytes, where: str) -> Element:
    """The root element of an XML text in UTF-8.

    Raises AssetError with `where:line` for text that is not well formed, or that declares entities.
    """
    if not data.strip():
        raise AssetError("the file is empty", where=where)
    reader = _Reader(blanked(data), where)
    return reader.root()


class _Reader:
    """Builds the tree from expat's events; offsets are those of the text."""

    def __init__(self, data: bytes, where: str) -> None:
        self.data, self.where = data, where
        self.open: list[Element] = []
        self.texts: list[list[str]] = []
        self.done: Element | None = None
        self.parser = expat.ParserCreate("utf-8")
        self.parser.StartElementHandler = self._start
        self.parser.EndElementHandler = self._end
        self.parser.CharacterDataHandler = self._characters
        self.parser.buffer_text = True
        self.parser.EntityDeclHandler = self._entity
        self.parser.specified_attributes = True

    def root(self) -> Element:
        try:
            self.parser.Parse(self.data, True)
        except expat.ExpatError as error:
            reason = expat.ErrorString(error.code)
            raise AssetError(f"is not well-formed XML: {reason}", where=f"{self.where}:{error.lineno}") from None
        assert self.done is not None  # expat refuses a text without an element
        return self.done

    def _start(self, tag: str, attributes: dict[str, str]) -> None:
        start = self.parser.CurrentByteIndex
        match = _TAG_END.match(self.data, start)
        assert match is not None  # expat saw the tag's end
        element = Element(tag, attributes, self.parser.CurrentLineNumber, start, match.end())
        if self.open:
            self.open[-1].children.append(element)
        self.open.append(element)
        self.texts.append([])

    def _characters(self, text: str) -> None:
        self.texts[-1].append(text)

    def _end(self, tag: str) -> None:
        element = self.open.pop()
        element.text = "".join(self.texts.pop()).strip()
        empty = self.data[element.inside - 2 : element.inside] == b"/>"
        closing = element.inside - 1 if empty else self.parser.CurrentByteIndex
        element.end = self.data.index(b">", closing) + 1
        self.done = element

    def _entity(self, *declaration: object) -> NoReturn:
        raise AssetError(
            "declares XML entities, which are not read",
            where=f"{self.where}:{self.parser.CurrentLineNumber}",
            remedy="Remove the document type; it may also be an attack on the reader.",
        )
