"""Labels taken from names: hulls, bodies, meshes and materials are often called what they are."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from meshforge.batch import Spread
from meshforge.errors import ProjectError
from meshforge.perception.names import Names, Pattern, Told, told
from meshforge.project.labels.labelling import Labelled
from meshforge.project.labels.name_patterns import Meanings, name_patterns
from meshforge.project.labels.taking import Report, Taker, none_there
from meshforge.project.survey import Facts, surveyed
from meshforge.symbolic import Label, SymbolicMesh

if TYPE_CHECKING:
    from meshforge.project.project import Project


def label_from_names(project: Project, meanings: Meanings, spread: Spread, report: Report) -> tuple[Labelled, ...]:
    """Give the labels that names say to hulls that have none; a problem with one asset is told in its report.

    meanings: patterns besides those of the project, which they precede.
    Raises ProjectError: no vocabulary; UsageError: a pattern that makes no sense.
    """
    patterns = checked_patterns(project, project.vocabulary, meanings)
    taker, reports = Taker(project), list[Labelled]()
    for asset, facts in surveyed(project.found, project.layout, spread=spread):
        reports.append(_labelled(taker, asset, facts, patterns))
        report(reports[-1])
    return tuple(reports)


def checked_patterns(project: Project, vocabulary: Sequence[str], meanings: Meanings) -> tuple[Pattern, ...]:
    """The patterns that say what names mean. Raises as `label_from_names`."""
    if not vocabulary:
        remedy = "Say first what hulls can be."
        raise ProjectError("the vocabulary is empty", where=str(project.folder), remedy=remedy)
    return name_patterns(project.folder, project.settings, vocabulary, meanings)


def _labelled(taker: Taker, asset: str, facts: Facts, patterns: Sequence[Pattern]) -> Labelled:
    if facts.error:
        return Labelled(asset, problems=(facts.error,))
    said = ((names.hull, told(names, taker.vocabulary, patterns)) for names in names_of(facts))
    given = {hull: label for hull, one in said if one and (label := as_label(one))}
    return taker.try_write(asset, facts.hulls, given, none_there)


def as_label(one: Told) -> Label | None:
    """The label that names say, None where a pattern leaves the hull without one."""
    return Label(one.label, one.confidence, "name") if one.label else None


def names_in(mesh: SymbolicMesh) -> Iterator[Names]:
    """The names of each hull of a mesh."""
    mentions = {geom.name: geom.mentions for geom in mesh.asset.geoms} if mesh.asset else {}
    return (Names(hull.name, hull.body, mentions.get(hull.name, ())) for hull in mesh.hulls)


def names_of(facts: Facts) -> Iterator[Names]:
    """The same from what is known of an asset."""
    return map(Names, facts.hulls, facts.bodies, facts.mentions)
