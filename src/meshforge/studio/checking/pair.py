"""An output with the asset that it was made from, as both lie on disk."""

from __future__ import annotations

from dataclasses import dataclass

from meshforge.batch import Stamp, read_stamp, same_files
from meshforge.errors import ProjectError
from meshforge.formats import load
from meshforge.preparation import record_digest
from meshforge.project import Project
from meshforge.studio.checking.key import check_key
from meshforge.studio.errors import NotHereError
from meshforge.symbolic import SymbolicMesh

_APPLY = "Apply the program to it again."


@dataclass(frozen=True, slots=True)
class Work:
    """What a worker looks at; project: with this asset alone; key: of the output that is meant."""

    project: Project
    asset: str
    key: str


@dataclass(frozen=True, eq=False, slots=True)
class Pair:
    """An asset as it is prepared, and its output."""

    before: SymbolicMesh
    after: SymbolicMesh


def pair_of(work: Work) -> Pair:
    """Read both. Raises NotHereError where the output is another by now, ProjectError where one of them changed since
    it was written, AssetError where one cannot be read."""
    project, asset = work.project, work.asset
    stamp = read_stamp(project.layout.edited, asset)
    if stamp is None or check_key(stamp) != work.key:
        raise NotHereError("its output is another by now", where=asset, remedy="Look at the present one.")
    if not _is_same(project, asset, stamp):
        raise ProjectError("the asset changed since its output was made", where=asset, remedy=_APPLY)
    if not stamp.is_whole(project.layout.edited):
        raise ProjectError("files of its output are gone or changed", where=asset, remedy=_APPLY)
    return Pair(project.mesh(asset), load(project.layout.edited / stamp.out))


def _is_same(project: Project, asset: str, stamp: Stamp) -> bool:
    made = stamp.inputs
    if made is None or record_digest(project.layout.preparation(asset)) != made.preparation:
        return False
    return same_files(made.asset, project.path(asset), project.found.base)
