"""What files say of the hulls of assets: labels files by what is known of these, others by their meshes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from meshforge.batch import Lost, Spread
from meshforge.errors import MeshForgeError, told
from meshforge.preparation import read_prepared
from meshforge.project.labels.from_files.finding import kind_of
from meshforge.project.labels.from_files.given import Given
from meshforge.project.labels.from_files.links import link_labels
from meshforge.project.labels.from_files.points import Reading, point_labels
from meshforge.project.labels.labelling import digests
from meshforge.project.labels.name_patterns import Meanings
from meshforge.project.survey import Facts, surveyed
from meshforge.symbolic import SymbolicMesh, label_homes, read_labels

if TYPE_CHECKING:
    from meshforge.perception.names import Pattern
    from meshforge.project.project import Project


@dataclass(frozen=True, slots=True)
class Filing:
    """How files are read. meanings: what names of classes mean, besides the patterns of the project, which they
    precede; reading: how segmented points are read."""

    meanings: Meanings = ()
    reading: Reading = field(default_factory=Reading)


@dataclass(frozen=True, slots=True)
class Says:
    """What a file says of an asset. hulls: digests by name, in order; error: why the asset or its file is not read."""

    hulls: Mapping[str, str] = field(default_factory=dict)
    given: Given = field(default_factory=Given)
    error: str | None = None


@dataclass(frozen=True, slots=True)
class _Work:
    """An asset, the folder of its preparation, and a file that only its mesh makes sense of."""

    path: Path
    preparation: Path
    file: Path
    how: Filing
    vocabulary: tuple[str, ...]
    patterns: tuple[Pattern, ...]


def sayings(
    project: Project,
    files: Mapping[str, Path],
    how: Filing,
    vocabulary: Sequence[str],
    patterns: Sequence[Pattern],
    spread: Spread,
) -> Iterator[tuple[str, Says]]:
    """What the file of each asset says, in their order, as soon as it is known; read in worker processes."""
    plain = {asset for asset, file in files.items() if kind_of(file) == "labels file"}
    layout, words, known = project.layout, tuple(vocabulary), tuple(patterns)
    work = [
        _Work(project.path(asset), layout.preparation(asset), file, how, words, known)
        for asset, file in files.items()
        if asset not in plain
    ]
    with (
        closing(surveyed(project.found, layout, plain, spread=spread)) as facts,
        closing(spread.run(_by_mesh, work)) as others,
    ):
        for asset, file in files.items():
            if asset in plain:
                yield asset, _by_facts(next(facts)[1], file)
            else:
                says = next(others)
                yield asset, Says(error=f"{project.path(asset)}: {says.why}") if isinstance(says, Lost) else says


def _by_facts(facts: Facts, file: Path) -> Says:
    if facts.error:
        return Says(error=facts.error)
    try:
        said = read_labels(file)
    except MeshForgeError as error:
        return Says(facts.hulls, error=error.message)
    homes = label_homes(said, facts.hulls)
    present = {name: homes.labels[name] for name in facts.hulls if name in homes.labels}
    return Says(facts.hulls, Given({name: said.labels[name] for name in homes.gone} | present))


def _by_mesh(work: _Work) -> Says:
    try:
        mesh = SymbolicMesh.of(read_prepared(work.path, work.preparation))
        if kind_of(work.file) == "points":
            given = point_labels(mesh, work.file, work.how.reading, work.vocabulary, work.patterns)
        else:
            given = link_labels(mesh, work.file, work.vocabulary, work.patterns)
        return Says(digests(mesh), given)
    except Exception as error:  # one asset never stops the others
        return Says(error=told(error, str(work.path)))
