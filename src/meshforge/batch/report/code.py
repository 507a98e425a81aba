"""Program text in colours."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from meshforge.batch.report.html import Child, tag
from meshforge.language import ACTIONS, OPERATORS, show_label

_TOKEN = re.compile(
    r'(?P<text>"(?:[^"\\]|\\.)*")|(?P<direction>[+-][XYZ]\b)|(?P<number>\d[\d.eE+-]*)|(?P<word>[^\W\d]\w*)|=>|->'
)
_KEYWORDS = frozenset({"labels", "orient", "contact", "extremity", "snap", "as"})


def colored(text: str, colors: Mapping[str, str]) -> Iterator[Child]:
    """Program text, each token in an element of its kind; labels are underlined in their colours."""
    written = {show_label(label): color for label, color in colors.items()}
    done = 0
    for match in _TOKEN.finditer(text):
        yield text[done : match.start()]
        token, done = match.group(), match.end()
        if token in written:
            yield tag("span", token, class_="label", style=f"--c:{written[token]}")
        else:
            yield tag("span", token, class_=_kind(match, token))
    yield text[done:]


def _kind(match: re.Match[str], token: str) -> str:
    if token in OPERATORS:
        return "operator"
    if token in ACTIONS:
        return "action"
    if token in _KEYWORDS or match.lastgroup is None:
        return "keyword"
    return match.lastgroup
