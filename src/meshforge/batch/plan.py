"""What a run over many assets has before it, known before anything is done."""

from __future__ import annotations

import shutil
from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from meshforge.batch.jobs import AssetJob
from meshforge.batch.provenance import stamp_path
from meshforge.batch.workers import GIB, MIB
from meshforge.common import pluralize


@dataclass(frozen=True, slots=True)
class RunPlan:
    """kinds: how many assets have which suffix, `folder` for folders; size: of the assets' own files [bytes], without
    those that they refer to; labelled: how many have a labels file; out: the folder of outputs, None where there are
    none; earlier: how many an earlier run was at; free: on the disk of the output [bytes].
    """

    kinds: Mapping[str, int]
    size: int
    labelled: int
    earlier: int
    out: Path | None
    free: int

    @property
    def count(self) -> int:
        """How many assets there are."""
        return sum(self.kinds.values())

    @property
    def is_tight(self) -> bool:
        """Whether the disk may not hold as much again as the assets that no earlier run was at."""
        return self.free < self.size * (self.count - self.earlier) / max(self.count, 1)

    @property
    def assets(self) -> str:
        """How many there are of what, in words."""
        kinds = ", ".join(f"{number:,} {kind}" for kind, number in self.kinds.items())
        return f"{pluralize(self.count, 'asset')} ({kinds}; {format_size(self.size)}), {self.labelled:,} with labels"

    def __str__(self) -> str:
        if self.out is None:
            return self.assets
        known = (
            f", where an earlier run was at {self.earlier:,} of them: what is up to date stays" if self.earlier else ""
        )
        lines = [self.assets, f"into {self.out}{known}; {format_size(self.free)} free"]
        if self.is_tight:
            lines.append("the disk may be too small for all of it; a run that this stops goes on when there is room")
        return "\n".join(lines)


def plan_run(jobs: Iterable[AssetJob], out: Path | None) -> RunPlan:
    """Look at the assets from outside, without reading them."""
    kinds: Counter[str] = Counter()
    size = labelled = earlier = 0
    for job in jobs:
        kinds[job.path.suffix.lower().lstrip(".").upper() or "folder"] += 1
        size += _size_on_disk(job.path)
        labelled += job.labels is not None
        earlier += out is not None and stamp_path(out, job.id).is_file()
    target = Path.cwd() if out is None else out.absolute()
    place = next(folder for folder in (target, *target.parents) if folder.exists())
    return RunPlan(dict(kinds.most_common()), size, labelled, earlier, out, shutil.disk_usage(place).free)


def format_size(size: int) -> str:
    """Bytes as people say them: `3.2 MiB`."""
    return f"{size / GIB:,.1f} GiB" if size >= GIB else f"{size / MIB:,.1f} MiB"


def _size_on_disk(path: Path) -> int:
    try:
        return sum(entry.stat().st_size for entry in path.iterdir()) if path.is_dir() else path.stat().st_size
    except OSError:
        return 0
