"""The characters of an XML file, in a form in which byte offsets can be edited, and back to the authored encoding."""

from __future__ import annotations

import codecs
import re
from dataclasses import dataclass

_MARKS = ((codecs.BOM_UTF8, "utf-8"), (codecs.BOM_UTF16_LE, "utf-16-le"), (codecs.BOM_UTF16_BE, "utf-16-be"))
_DECLARED = re.compile(rb"\s*<\?xml[^>]*?encoding\s*=\s*[\"']([\w.:-]+)")
_OPENERS = re.compile(rb"<!--|<!\[CDATA\[|<\?|<!DOCTYPE")
_CLOSERS = {b"<!--": b"-->", b"<![CDATA[": b"]]>", b"<?": b"?>", b"<!DOCTYPE": b">"}


@dataclass(frozen=True, slots=True)
class Text:
    """The text of an XML file as UTF-8 without a byte order mark, and how it was encoded."""

    data: bytes
    encoding: str
    mark: bytes

    @staticmethod
    def of(raw: bytes) -> Text:
        """The text of authored bytes; what is no valid text in its own encoding is taken byte by byte."""
        for mark, encoding in _MARKS:
            if raw.startswith(mark):
                return Text._decode(raw[len(mark) :], encoding, mark)
        declared = _DECLARED.match(raw[:1000])
        name = declared[1].decode("ascii", "replace").lower() if declared else "utf-8"
        return Text._decode(raw, "utf-8" if name.startswith(("utf-16", "utf-32", "ucs")) else name, b"")

    @staticmethod
    def _decode(raw: bytes, encoding: str, mark: bytes) -> Text:
        try:
            return Text(raw.decode(encoding).encode(), encoding, mark)
        except (LookupError, UnicodeError):
            return Text(raw.decode("latin-1").encode(), "latin-1", mark)

    def encode(self, data: bytes) -> bytes:
        """Edited UTF-8 in the authored encoding, with its byte order mark."""
        return self.mark + data.decode().encode(self.encoding, "xmlcharrefreplace")


def blanked(data: bytes) -> bytes:
    """The same bytes with spaces for comments, raw text, processing instructions and a plain document type.

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
