"""What an extractor selects on an asset."""

from __future__ import annotations

import re
from collections.abc import Iterable

from meshforge.errors import ProgramError
from meshforge.language import (
    EXTREMITY,
    Extractor,
    Program,
    explain,
    labels_used,
    parse_extractor,
    select_mask,
    show_label,
)
from meshforge.language.program import check_declared
from meshforge.project import Project
from meshforge.studio.showing.programs import mark
from meshforge.studio.showing.replaying import walk
from meshforge.studio.wire.lesson import Mark, Selected
from meshforge.studio.wire.requests import SelectRequest
from meshforge.symbolic import SymbolicMesh, bits


def selected(
    project: Project, asset: str, mesh: SymbolicMesh, request: SelectRequest, program: Program | None = None
) -> Selected:
    """What an extractor selects on an asset after some of its steps, or what is wrong with its text.

    mesh: the asset as it comes; program: whose rule is meant, where one is asked for. Raises MeshForgeError where the
    asset cannot be turned, or a rule before fails.
    """
    text = request.extractor
    try:
        extractor = parse_extractor(text)
    except ProgramError as error:
        return Selected(mark=mark(error, *_indent(text)))
    now = _state(project, asset, mesh, request, program)
    unknown = _unknown_label(extractor, text, [*project.vocabulary, *(hull.label for hull in now.hulls if hull.label)])
    if unknown:
        return Selected(mark=unknown)
    mask = select_mask(extractor, now, project.settings.thresholds.extremity or EXTREMITY)
    names = tuple(now.hulls[k].name for k in sorted(bits(mask)))
    return Selected(select=names, sentence=explain(extractor))


def _state(
    project: Project, asset: str, mesh: SymbolicMesh, request: SelectRequest, program: Program | None
) -> SymbolicMesh:
    if request.rule is None:
        return walk(project, asset, mesh, request.steps).mesh
    return project.mesh_before_rule(asset, request.rule, program or Program(orient=project.orientation), {asset: mesh})


def _indent(text: str) -> tuple[int, int]:
    """Lines and columns before the first character that is no space: the parser sees the text without them."""
    return _behind(text[: len(text) - len(text.lstrip())])


def _behind(text: str) -> tuple[int, int]:
    """Lines and columns from the beginning of a text to its end."""
    return text.count("\n"), len(text) - (text.rfind("\n") + 1)


def _unknown_label(extractor: Extractor, text: str, known: Iterable[str]) -> Mark | None:
    """The place of a label that neither the vocabulary nor any hull has; None where all are known, or none is."""
    known = tuple(dict.fromkeys(known))
    for label in labels_used(extractor) if known else ():
        try:
            check_declared(label, known)
        except ProgramError as error:
            found = re.search(rf"(?<!\w){re.escape(show_label(label))}(?!\w)", text)
            lines, columns = _behind(text[: found.start() if found else 0])
            return mark(error, lines, columns)
    return None
