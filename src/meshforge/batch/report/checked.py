"""What was measured of an asset, on its card: sentences, findings, errors first, and pictures."""

from __future__ import annotations

from meshforge.batch.report.asset import ReportAsset
from meshforge.batch.report.html import Child, Node, tag
from meshforge.batch.report.pictures import address
from meshforge.checks import Examination, Finding, pictures
from meshforge.words import counted

SIZE = (420, 315)
_FINDINGS = 40  # of one asset that are listed, errors first


def checked(asset: ReportAsset, pictured: bool) -> Child:
    """The section about what was measured; None where nothing was. pictured: whether with pictures."""
    found = asset.checked
    if found is None:
        return None
    errors = [f for f in found.findings if f.severity == "error"]
    warnings = [f for f in found.findings if f.severity != "error"]
    counts = f"{counted(len(errors), 'error')}, {counted(len(warnings), 'warning')}"
    rows = [_row(finding) for finding in (*errors, *warnings)[:_FINDINGS]]
    if len(found.findings) > _FINDINGS:
        rows.append(tag("li", f"and {len(found.findings) - _FINDINGS:,} more"))
    return tag(
        "details",
        tag("summary", f"checks: {counts}" if found.findings else "checks: all is well"),
        *(tag("p", line, class_="note") for line in found.descriptions),
        tag("ul", *rows, class_="findings") if rows else None,
        *(_pictures(asset) if pictured else ()),
        class_="checks",
        open=bool(errors) or asset.status == "warnings",
    )


def _row(finding: Finding) -> Node:
    remedy = tag("small", f" {finding.remedy}") if finding.remedy else None
    return tag("li", tag("b", finding.severity, class_=finding.severity), f" {finding.message} ", remedy)


def _pictures(asset: ReportAsset) -> list[Node]:
    mesh = asset.after or asset.before
    if mesh is None or not isinstance(asset.checked, Examination):
        return []
    return [_figure(asset.name, words, address(image)) for _, words, image in pictures(mesh, asset.checked, SIZE)]


def _figure(name: str, words: str, source: str) -> Node:
    image = tag("img", src=source, alt=f"{name}: {words}", width=SIZE[0], height=SIZE[1], loading="lazy")
    return tag("figure", image, tag("figcaption", words))
