"""Pages of reports, read."""

from pathlib import Path
from typing import Any

import lxml.html


def opened(path: Path | str) -> Any:
    """The page in a file, which has to be well-formed."""
    parser = lxml.html.HTMLParser(recover=False)
    return lxml.html.document_fromstring(Path(path).read_text("utf-8"), parser=parser)


def texts(tree: Any, path: str) -> list[str]:
    """The texts of elements, with single blanks."""
    return [" ".join(e.text_content().split()) for e in tree.xpath(path)]


def names(tree: Any) -> list[str]:
    """The assets, in their order."""
    return texts(tree, "//article//bdi")


def kinds(tree: Any) -> list[str]:
    """What each is, by which the page filters."""
    return [kind.split()[0] for kind in tree.xpath("//article/@data-kind")]


def figures(tree: Any) -> dict[str, str]:
    """The figures at the top, without the time that it took."""
    found = dict(zip(texts(tree, "//dl//dt"), texts(tree, "//dl//dd"), strict=True))
    return {name: value for name, value in found.items() if name != "run time"}
