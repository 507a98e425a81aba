"""The program on the page: its text in colours, a sentence for each rule, and what each rule did in all."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from meshforge.batch.report.asset import ReportAsset
from meshforge.batch.report.code import colored
from meshforge.batch.report.html import Child, Node, tag
from meshforge.language import Program, explain, show, show_label
from meshforge.words import counted


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
    hulls = counted(sum(len(t.selected) for t in active), "hull")
    yield f"{hulls} on {len(active)} of {counted(len(traces), 'asset')}, "
    yield tag("br")
    yield f"{sum(len(t.made) for t in active):,} made"
