"""The files of one output, written aside and read back before they are put in place."""

from __future__ import annotations

import secrets
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from meshforge.asset import Asset
from meshforge.batch.assets.digests import file_digest, text_digest
from meshforge.batch.assets.folder import STATE
from meshforge.batch.assets.job import AssetJob, Task
from meshforge.errors import AssetError
from meshforge.formats import Mass, Names, labels_beside, placed, read, save
from meshforge.symbolic import SymbolicMesh, write_labels

FILES, STAMP = "files", "stamp.json"
"""What there is in the folder of a draft."""


@dataclass(frozen=True, slots=True)
class Draft:
    """An output that lies aside: its files, and beside their folder the stamp that is to vouch for them.

    files: the digest of each file by its path in `folder`; main: the path of the main one; notes: what the format
    could not hold, or holds in another form; labels: of its hulls, in the order that the main file reads back in.
    """

    folder: Path
    main: str
    files: Mapping[str, str] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    labels: tuple[str | None, ...] = ()

    @property
    def root(self) -> Path:
        """The folder of the files' folder and the stamp: what is put in place."""
        return self.folder.parent


def drafts(out: Path) -> Path:
    """The folder for outputs that are not in place yet; on the disk of the output, so that they can be renamed."""
    return out / STATE / "drafts"


def planned(task: Task, job: AssetJob, asset: Asset) -> Draft:
    """Where the output of an asset would be."""
    attempt = secrets.token_hex(8)  # two nodes may be at it, when one that was given up for dead lives on
    folder = drafts(task.out) / f"{text_digest(job.id)}-{attempt}" / FILES
    if task.to is None:
        return Draft(folder, placed(asset, job.base, folder).relative_to(folder).as_posix())
    stem = job.id if job.path.is_dir() else job.id.removesuffix(job.path.suffix)
    return Draft(folder, f"{stem}{task.to}")


def written(
    plan: Draft,
    mesh: SymbolicMesh,
    vocabulary: tuple[str, ...],
    *,
    mass: Mass = "keep",
    link: bool = False,
    names: Names | None = None,
) -> Draft:
    """The output, with the labels of the edited mesh beside it, by the names that it reads back with.

    Raises AssetError where the format cannot hold the mesh, or what was written reads back as other hulls.
    """
    main = plan.folder / plan.main
    saved = save(mesh, main, mass=mass, link=link, names=names)
    written = mesh.with_hulls(replace(hull, name=saved.names.get(hull.name, hull.name)) for hull in mesh.hulls)
    order = _read_back(main, written)
    if written.labels:
        write_labels(labels_beside(main), written, vocabulary)
    files = sorted(path for path in plan.folder.rglob("*") if path.is_file())
    digests = {path.relative_to(plan.folder).as_posix(): file_digest(path) for path in files}
    labels = tuple(written.hull_of(name).label for name in order)
    return Draft(plan.folder, plan.main, digests, saved.notes, labels)


def _read_back(main: Path, mesh: SymbolicMesh) -> list[str]:
    """The names that the file reads back as; labels are keyed by them, so these must be those of the mesh."""
    back = [geom.name for geom in read(main).geoms]
    wanted = [hull.name for hull in mesh.hulls]
    if sorted(back) != sorted(wanted):
        odd = ", ".join(sorted(set(back) ^ set(wanted))[:5])
        raise AssetError(
            f"the edited file reads back with other hulls than it should have: {odd}",
            remedy="This is a fault of MeshForge; nothing was written. Please report the asset.",
        )
    return back
