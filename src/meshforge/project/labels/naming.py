"""Labels taken from names: hulls, bodies, meshes and materials are often called what they are."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from meshforge.errors import MeshForgeError, ProjectError
from meshforge.perception.names import Names, Pattern, Told, told
from meshforge.project.labels.labelling import Labelled, merged, write_merged
from meshforge.project.labels.name_patterns import Meanings, name_patterns
from meshforge.project.survey import Facts
from meshforge.symbolic import Label, SymbolicMesh

if TYPE_CHECKING:
    from meshforge.project.project import Project


def label_from_names(project: Project, meanings: Meanings = ()) -> tuple[Labelled, ...]:
    """Give the labels that names say to hulls that have none; a problem with one asset is told in its report.

    meanings: patterns besides those of the project, which they precede.
    Raises ProjectError: no vocabulary; UsageError: a pattern that makes no sense.
    """
    patterns = checked_patterns(project, project.vocabulary, meanings)
    return tuple(_labelled(project, asset, patterns) for asset in project.assets())


def checked_patterns(project: Project, vocabulary: Sequence[str], meanings: Meanings) -> tuple[Pattern, ...]:
    """The patterns that say what names mean. Raises as `label_from_names`."""
    if not vocabulary:
        remedy = "Say first what hulls can be."
        raise ProjectError("the vocabulary is empty", where=str(project.folder), remedy=remedy)
    return name_patterns(project.folder, project.settings, vocabulary, meanings)


def _labelled(project: Project, asset: str, patterns: Sequence[Pattern]) -> Labelled:
    with project.lock():
        try:
            mesh = project.mesh(asset)
        except MeshForgeError as error:
            return Labelled(asset, problems=(error.message,))
        vocabulary = project.vocabulary
        bare = (names for names in names_in(mesh) if mesh.named(names.hull).label is None)
        said = ((names.hull, told(names, vocabulary, patterns)) for names in bare)
        given = {hull: label for hull, one in said if one and (label := as_label(one))}
        labelled, report = merged(asset, mesh, given, vocabulary)
        if report.taken:
            write_merged(project, asset, labelled)
        return report


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
