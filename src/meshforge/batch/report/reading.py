"""Assets read again, to be shown: only those, when a run is over, so that its meshes need not be kept."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from meshforge.batch.assets.job import AssetJob
from meshforge.batch.workers.pool import Lost
from meshforge.batch.workers.spread import Spread
from meshforge.formats import load
from meshforge.symbolic import SymbolicMesh

Reader = Callable[[], SymbolicMesh]
"""Reads an asset, in this process or another."""
PATIENCE = 300.0
"""Seconds for one asset."""


def read_again(readers: Sequence[Reader | None]) -> list[SymbolicMesh | None]:
    """The meshes, in their order, read in worker processes: one that crashes or hangs costs no more than itself.

    None for what cannot be read any more, or has no reader.
    """
    wanted = [reader for reader in readers if reader]
    found = iter(Spread(timeout=PATIENCE).run(_read, wanted) if wanted else ())
    meshes = [next(found) if reader else None for reader in readers]
    return [None if isinstance(mesh, Lost) else mesh for mesh in meshes]


def read_job(job: AssetJob) -> SymbolicMesh:
    """An asset with its labels, as it lies in its file. Raises as `load`."""
    return load(job.path, labels=job.labels)


def _read(reader: Reader) -> SymbolicMesh | None:
    try:
        return reader()
    except Exception:  # why it cannot be read is told already, or is not what the report is about
        return None
