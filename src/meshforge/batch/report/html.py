"""Elements of the page; texts are escaped by the serializer, so that a hull may be named anything."""

from __future__ import annotations

import re
from typing import Any

from lxml import etree

Node = Any
Child = Node | str | None
_UNPRINTABLE = re.compile(r"[^\t\n\r\x20-\uD7FF\uE000-\uFFFD\U00010000-\U0010FFFF]")


def tag(kind: str, *children: Child, **attributes: str | int | bool | None) -> Node:
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


def document(root: Node) -> str:
    """The whole page as text."""
    page: str = etree.tostring(root, method="html", encoding="unicode", doctype="<!DOCTYPE html>")
    return page + "\n"


def _append(element: Node, child: Child) -> None:
    if child is None:
        return
    if not isinstance(child, str):
        element.append(child)
    elif len(element):
        element[-1].tail = (element[-1].tail or "") + clean(child)
    else:
        element.text = (element.text or "") + clean(child)
