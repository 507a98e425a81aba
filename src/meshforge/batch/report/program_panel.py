"""The program on the page: its text in colours, a sentence for each rule, and what each rule did in all."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

from meshforge.batch.report.asset import ReportAsset
from meshforge.batch.report.html import Child, Node, tag
from meshforge.batch.report.words import counted
from meshforge.language import ACTIONS, OPERATORS, Program, explain, show, show_label

_TOKEN = re.compile(
    r'(?P<text>"(?:[^"\\]|\\.)*")|(?P<direction>[+-][XYZ]\b)|(?P<number>\d[\d.eE+-]*)|(?P<word>[^\W\d]\w*)|=>|->'
)
_KEYWORDS = frozenset({"labels", "orient", "contact", "extremity", "snap", "as"})


def program_panel(program: Program, assets: Sequence[ReportAsset], colors: Mapping[str, str]) -> Node:
    """The section with the program."""
    rows = [_header_row(line, sentence, colors) for line, sentence in _header(program)]
    for number, rule in enumerate(program.rules, 1):
        above = [c.strip() for c in rule.comments.above if c]
        comment = " ".join([*above, *([rule.comments.beside.strip()] if rule.comments.beside else [])])
        body = tag("td", tag("code", *colored(show(rule), colors)), tag("p", explain(rule)))
        if comment:
            body.append(tag("p", f"# {comment}", class_="comment"))
        rows.append(
            tag("tr", tag("th", str(number), scope="row"), body, tag("td", *_did(number, assets), class_="did"))
        )
    return tag("section", tag("h2", "Program"), tag("table", *rows, class_="program"), id_="program")


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


def _header(program: Program) -> Iterator[tuple[str, str | None]]:
    """The lines above the rules, with a sentence where they need one."""
    if program.labels:
        yield f"labels {', '.join(map(show_label, program.labels))}", None
    if program.contact is not None:
        yield f"contact {program.contact:g}", "Hulls this near each other touch (a share of the diagonal)."
    if program.extremity is not None:
        yield (
            f"extremity {program.extremity:g}",
            "Hulls this near the boundary are extreme (a share of the diagonal).",
        )
    if program.orient:
        yield show(program.orient), explain(program.orient)


def _header_row(line: str, sentence: str | None, colors: Mapping[str, str]) -> Node:
    body = tag("td", tag("code", *colored(line, colors)), tag("p", sentence) if sentence else None, colspan=2)
    return tag("tr", tag("th"), body)


def _did(number: int, assets: Sequence[ReportAsset]) -> Iterator[Child]:
    """What one rule did over all assets."""
    traces = [t for a in assets for t in a.trace if t.rule == number]
    active = [t for t in traces if t.selected]
    if not active:
        yield "selected nothing"
        return
    yield f"{counted(sum(len(t.selected) for t in active), 'hull')} on {len(active)} of {counted(len(traces), 'asset')}"
    yield tag("br")
    yield f"{sum(len(t.made) for t in active):,} made"
