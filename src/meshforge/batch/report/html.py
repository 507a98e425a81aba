"""Elements of the page, whose texts the serializer escapes, program text in colours, and pictures as addresses."""

from __future__ import annotations

import base64
import re
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from lxml import etree

from meshforge.language import ACTIONS, OPERATORS, show_label
from meshforge.rendering import encode_webp

if TYPE_CHECKING:
    from PIL.Image import Image


HtmlNode = Any
HtmlChild = HtmlNode | str | None
_UNPRINTABLE = re.compile(r"[^\t\n\r\x20-\uD7FF\uE000-\uFFFD\U00010000-\U0010FFFF]")

_TOKEN = re.compile(
    r'(?P<text>"(?:[^"\\]|\\.)*")|(?P<direction>[+-][XYZ]\b)|(?P<number>\d[\d.eE+-]*)|(?P<word>[^\W\d]\w*)|=>|->'
)
_KEYWORDS = frozenset({"labels", "orient", "contact", "extremity", "snap", "as"})


def tag(kind: str, *children: HtmlChild, **attributes: str | int | bool | None) -> HtmlNode:
    """An element. Attribute names: a last `_` is dropped, others become `-`; None and False leave one out."""
    element = etree.Element(kind)
    for name, value in attributes.items():
        if value is not None and value is not False:
            element.set(name.rstrip("_").replace("_", "-"), "" if value is True else clean(str(value)))
    for child in children:
        _append(element, child)
    return element


def clean(text: str) -> str:
    """The text without characters that no document can hold."""
    return _UNPRINTABLE.sub("\N{REPLACEMENT CHARACTER}", text)


def to_html(root: HtmlNode) -> str:
    """The whole page as text."""
    page: str = etree.tostring(root, method="html", encoding="unicode", doctype="<!DOCTYPE html>")
    return page + "\n"


def _append(element: HtmlNode, child: HtmlChild) -> None:
    if child is None:
        return
    if not isinstance(child, str):
        element.append(child)
    elif len(element):
        element[-1].tail = (element[-1].tail or "") + clean(child)
    else:
        element.text = (element.text or "") + clean(child)


def highlight_code(text: str, colors: Mapping[str, str]) -> Iterator[HtmlChild]:
    """Program text, each token in an element of its kind; labels are underlined in their colours."""
    written = {show_label(label): color for label, color in colors.items()}
    done = 0
    for match in _TOKEN.finditer(text):
        yield text[done : match.start()]
        token, done = match.group(), match.end()
        if token in written:
            yield tag("span", token, class_="label", style=f"--c:{written[token]}")
        else:
            yield tag("span", token, class_=_token_kind(match, token))
    yield text[done:]


def _token_kind(match: re.Match[str], token: str) -> str:
    if token in OPERATORS:
        return "operator"
    if token in ACTIONS:
        return "action"
    if token in _KEYWORDS or match.lastgroup is None:
        return "keyword"
    return match.lastgroup


def to_data_url(image: Image) -> str:
    """A picture as an address `data:…` that holds it."""
    return f"data:image/webp;base64,{base64.b64encode(encode_webp(image)).decode()}"
