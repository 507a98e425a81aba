"""XML files that are edited in place: text, elements with byte offsets, edits, and numbers as text."""

from __future__ import annotations

import codecs
import math
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import NoReturn
from xml.parsers import expat

from meshforge.common import AssetError

_TAG_END = re.compile(rb"(?:[^\"'>]++|\"[^\"]*\"|'[^']*')*+>")

_MARKS = ((codecs.BOM_UTF8, "utf-8"), (codecs.BOM_UTF16_LE, "utf-16-le"), (codecs.BOM_UTF16_BE, "utf-16-be"))
_DECLARED = re.compile(rb"\s*<\?xml[^>]*?encoding\s*=\s*[\"']([\w.:-]+)")
_OPENERS = re.compile(rb"<!--|<!\[CDATA\[|<\?|<!DOCTYPE")
_CLOSERS = {b"<!--": b"-->", b"<![CDATA[": b"]]>", b"<?": b"?>", b"<!DOCTYPE": b">"}

_ATTRIBUTE = re.compile(rb"\s+([^\s=/>\"']+)\s*=\s*(\"[^\"]*\"|'[^']*')")
_ESCAPES = {"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;", "'": "&apos;"}
_ESCAPES |= {"\t": "&#9;", "\n": "&#10;", "\r": "&#13;"}
COMMENT = re.compile(rb"\s*<!--.*?-->", re.S)


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
        """Return the direct children of that tag."""
        return (child for child in self.children if child.tag == tag)

    def first(self, tag: str) -> Element | None:
        """Return the first direct child of that tag."""
        return next(self.each(tag), None)

    def walk(self) -> Iterator[Element]:
        """Yield this element and all below it, in order of their start tags."""
        waiting = [self]
        while waiting:
            element = waiting.pop()
            yield element
            waiting.extend(reversed(element.children))


def parse_xml(data: bytes, where: str) -> Element:
    """Return the root element of an XML text in UTF-8.

    Raises AssetError with `where:line` for text that is not well formed, or that declares entities.
    """
    if not data.strip():
        raise AssetError("the file is empty", where=where)
    data = blank_markup(data)
    opened: list[tuple[Element, list[str]]] = []
    done: list[Element] = []
    parser = expat.ParserCreate("utf-8")
    parser.buffer_text = parser.specified_attributes = True

    def start(tag: str, attributes: dict[str, str]) -> None:
        match = _TAG_END.match(data, parser.CurrentByteIndex)
        assert match is not None  # expat saw the tag's end
        element = Element(tag, attributes, parser.CurrentLineNumber, parser.CurrentByteIndex, match.end())
        if opened:
            opened[-1][0].children.append(element)
        opened.append((element, []))

    def end(tag: str) -> None:
        element, texts = opened.pop()
        element.text = "".join(texts).strip()
        empty = data[element.inside - 2 : element.inside] == b"/>"
        element.end = data.index(b">", element.inside - 1 if empty else parser.CurrentByteIndex) + 1
        done.append(element)

    def refuse_entity(*declaration: object) -> NoReturn:
        problem, place = "declares XML entities, which are not read", f"{where}:{parser.CurrentLineNumber}"
        remedy = "Remove the document type; it may also be an attack on the reader."
        raise AssetError(problem, where=place, remedy=remedy)

    parser.StartElementHandler, parser.EndElementHandler, parser.EntityDeclHandler = start, end, refuse_entity
    parser.CharacterDataHandler = lambda text: opened[-1][1].append(text)
    try:
        parser.Parse(data, True)
    except expat.ExpatError as error:
        reason = expat.ErrorString(error.code)
        raise AssetError(f"is not well-formed XML: {reason}", where=f"{where}:{error.lineno}") from None
    return done[-1]  # expat refuses a text without an element


@dataclass(frozen=True, slots=True)
class XmlText:
    """The text of an XML file as UTF-8 without a byte order mark, and how it was encoded."""

    data: bytes
    encoding: str
    mark: bytes

    @staticmethod
    def of(raw: bytes) -> XmlText:
        """Return the text of authored bytes; what is no valid text in its own encoding is taken byte by byte."""
        for mark, encoding in _MARKS:
            if raw.startswith(mark):
                return XmlText._decode(raw[len(mark) :], encoding, mark)
        declared = _DECLARED.match(raw[:1000])
        name = declared[1].decode("ascii", "replace").lower() if declared else "utf-8"
        return XmlText._decode(raw, "utf-8" if name.startswith(("utf-16", "utf-32", "ucs")) else name, b"")

    @staticmethod
    def _decode(raw: bytes, encoding: str, mark: bytes) -> XmlText:
        try:
            return XmlText(raw.decode(encoding).encode(), encoding, mark)
        except (LookupError, UnicodeError):
            return XmlText(raw.decode("latin-1").encode(), "latin-1", mark)

    def encode(self, data: bytes) -> bytes:
        """Return edited UTF-8 in the authored encoding, with its byte order mark."""
        return self.mark + data.decode().encode(self.encoding, "xmlcharrefreplace")


@dataclass(frozen=True, eq=False, slots=True)
class SourceFile:
    """An authored file: the main one, or one that is included.

    path: absolute; place: its path relative to the main file's folder, where an output has it too, None for one that
    is included by an absolute path; reference: as the `<include>` has it, empty for the main file.
    """

    path: Path
    place: str | None
    reference: str
    raw: bytes

    @property
    def text(self) -> XmlText:
        """The text in which offsets of elements count."""
        return XmlText.of(self.raw)


def blank_markup(data: bytes) -> bytes:
    """Return the bytes of a text with spaces for comments, raw text, processing instructions and a plain document type.

    Engines read past an XML declaration of version 0.0 or after blank lines, and past `--` in comments; a strict
    parser does not. Offsets and lines stay. A document type with declarations of its own stays too, to be refused.
    """
    out, at = bytearray(data), 0
    while opener := _OPENERS.search(data, at):
        end = data.find(_CLOSERS[opener[0]], opener.end())
        if end < 0:
            break
        at = end + len(_CLOSERS[opener[0]])
        inside = data[opener.start() : at]
        if not (opener[0] == b"<!DOCTYPE" and b"[" in inside):
            out[opener.start() : at] = re.sub(rb"[^\r\n]", b" ", inside)
    return bytes(out)


@dataclass(frozen=True, slots=True)
class Splice:
    """New bytes in place of [start, end)."""

    start: int
    end: int
    text: bytes


def apply_splices(data: bytes, splices: Iterable[Splice], start: int = 0, end: int | None = None) -> bytes:
    """Return the bytes [start, end) after splices within them, which do not overlap."""
    out, at = [], start
    for splice in sorted(splices, key=lambda s: (s.start, s.end)):
        out += [data[at : splice.start], splice.text]
        at = splice.end
    return b"".join([*out, data[at:end]])


def set_attribute(data: bytes, element: Element, name: str, value: str | None, *, last: bool = False) -> Splice:
    """Return the edit that sets an attribute of an element, in its place and quotes where it is there; None removes it.

    last: a new one goes after the others instead of before them.
    """
    at = element.start + 1 + len(element.tag.encode())
    for found in _ATTRIBUTE.finditer(data, at, element.inside):
        if found[1] == name.encode():
            if value is None:
                return Splice(found.start(), found.end(), b"")
            return Splice(found.start(2) + 1, found.end(2) - 1, escape(value))
        at = found.end() if last else at
    return Splice(at, at, b"" if value is None else b' %s="%s"' % (name.encode(), escape(value)))


def escape(value: str) -> bytes:
    """Return a text as it stands between the quotes of an attribute."""
    return "".join(_ESCAPES.get(letter, letter) for letter in value).encode()


def tag(name: str, attributes: Mapping[str, str] | None = None, closed: bool = True) -> bytes:
    """Return an element without children; closed: else only its start tag."""
    text = "".join(f' {key}="{escape(value).decode()}"' for key, value in (attributes or {}).items())
    return f"<{name}{text}{'/' if closed else ''}>".encode()


def nest(element: str, /, *inside: bytes, **attributes: str) -> list[bytes]:
    """Return the lines of an element that holds others, each line of which is indented."""
    return [tag(element, attributes, closed=False), *(b"  " + line for line in inside), b"</%s>" % element.encode()]


def newline_of(data: bytes) -> bytes:
    """Return the line end of a text."""
    return b"\r\n" if b"\r\n" in data else b"\n"


def indent_of(data: bytes, at: int) -> bytes | None:
    """Return the blanks between the start of the line and `at`, None where something else is there."""
    line = data.rfind(b"\n", 0, at) + 1
    blanks = data[line:at]
    return blanks if not blanks.strip() else None


def line_gap(data: bytes, at: int) -> bytes:
    """Return what parts an element at `at` from the next: a line end and its indent, nothing where it has no line."""
    lead = indent_of(data, at)
    return b"" if lead is None else newline_of(data) + lead


def replace_or_insert(data: bytes, parent: Element, tag: str, before: str, text: bytes) -> Splice:
    """Return the edit that replaces a child of an element, or inserts it before another one."""
    old, next_ = parent.first(tag), parent.first(before)
    if old is not None:
        return Splice(old.start, old.end, text)
    assert next_ is not None
    return Splice(next_.start, next_.start, text + line_gap(data, next_.start))


def remove_element(data: bytes, element: Element) -> Splice:
    """Return the edit that removes an element, with its lines where it has them for itself."""
    end = data.find(b"\n", element.end) + 1 or len(data)
    before = indent_of(data, element.start)
    if before is None or data[element.end : end].strip():
        return Splice(element.start, element.end, b"")
    return Splice(element.start - len(before), end, b"")


def format_numbers(values: Iterable[float]) -> str:
    """Return numbers as text that reads back as the same numbers; no negative zeros."""
    return " ".join(repr(float(value) + 0.0).removesuffix(".0") for value in values)


def parse_numbers(text: str) -> list[float] | None:
    """Return the numbers of a text, apart by blanks or commas, None where one is none or not finite."""
    if "_" in text or not text.isascii():  # Python's own ways to write numbers, which no engine reads
        return None
    try:
        values = [float(word) for word in text.replace(",", " ").split()]
    except ValueError:
        return None
    return values if all(map(math.isfinite, values)) else None
