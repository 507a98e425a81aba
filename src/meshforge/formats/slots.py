"""Elements of an edited description before they are text, authored, copied or new, and where they go."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from meshforge.formats.xml import (
    Element,
    Splice,
    attribute,
    indent,
    newline,
    removed,
    spliced,
    without_comments,
)

_TAG = re.compile(rb"<([^\s/>]+)")


@dataclass(slots=True, eq=False)
class Slot:
    """One element of the output that holds collision geometry.

    names: what its pieces must read back as; name: its name attribute; source: the authored element that it is, or is
    copied from with `edits`; a copy leaves the comments out. text: of an element without a source.
    """

    body: str
    names: tuple[str, ...]
    name: str | None = None
    source: Element | None = None
    edits: tuple[Splice, ...] = ()
    copy: bool = False
    text: bytes = b""

    @property
    def is_untouched(self) -> bool:
        """Whether it is an element of the file to which nothing is done."""
        same_name = self.source is not None and self.name == self.source.attributes.get("name")
        return same_name and not self.edits and not self.copy

    def to_bytes(self, data: bytes) -> bytes:
        """Its text; data: the authored document."""
        if self.source is None:
            return spliced(self.text, [attribute(self.text, _new(self.text), "name", self.name)])
        edits = self.edits
        if self.name != self.source.attributes.get("name"):
            edits = (attribute(data, self.source, "name", self.name), *edits)
        text = spliced(data, edits, self.source.start, self.source.end)
        return without_comments(text) if self.copy else text


def in_place(data: bytes, element: Element, slots: Sequence[Slot]) -> Splice:
    """What stands in the place of an authored element; nothing takes its line away."""
    if not slots:
        return removed(data, element)
    return Splice(element.start, element.end, _joined(data, slots, indent(data, element.start)))


def at_end(data: bytes, parent: Element, slots: Sequence[Slot]) -> Splice:
    """What is added at the end of an element."""
    line_end, before = newline(data), indent(data, parent.start) or b""
    if parent.children:
        last = parent.children[-1]
        lead = indent(data, last.start)
        return Splice(last.end, last.end, (b"" if lead is None else line_end + lead) + _joined(data, slots, lead))
    lead = before + b"  "
    added = lead + _joined(data, slots, lead) + line_end
    if data[parent.inside - 2 : parent.inside] == b"/>":
        closing_tag = b"</%s>" % parent.tag.encode()
        return Splice(parent.inside - 2, parent.inside, b">" + line_end + added + before + closing_tag)
    closing = data.rfind(b"</", parent.inside, parent.end)
    blanks = indent(data, closing)
    if blanks is None:
        return Splice(closing, closing, line_end + added + before)
    return Splice(closing - len(blanks), closing - len(blanks), added)


def lead_inside(data: bytes, parent: Element) -> bytes:
    """The blanks before the children of an element."""
    if parent.children:
        return indent(data, parent.children[-1].start) or b""
    return (indent(data, parent.start) or b"") + b"  "


def _joined(data: bytes, slots: Iterable[Slot], lead: bytes | None) -> bytes:
    """Elements one after another, each on lines of its own where the first is."""
    gap = b"" if lead is None else newline(data) + lead
    return gap.join(slot.to_bytes(data) for slot in slots)


def _new(text: bytes) -> Element:
    """The element of a text that has no name attribute."""
    found = _TAG.match(text)
    assert found is not None  # a text is an element
    return Element(found[1].decode(), {}, line=0, start=0, inside=found.end())
