"""How much memory one asset may take, so that a monster fails alone instead of taking the machine with it."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

_LEFT = 0.9  # of the machine's memory, for all workers together
_GROUP = Path("/sys/fs/cgroup/memory.max")
_STATUS = Path("/proc/self/status")
MIB = 1 << 20
GIB = 1 << 30


def share(workers: int) -> int | None:
    """An even share [bytes] of the memory that this machine, or this container, has; None where it does not tell."""
    try:
        whole = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (AttributeError, ValueError, OSError):
        return None
    with suppress(OSError, ValueError):  # no container, or one without a bound
        whole = min(whole, int(_GROUP.read_text()))
    return int(whole * _LEFT) // max(workers, 1)


def bound(more: int) -> None:
    """Let this process take so many bytes more than it has by now. Only Linux counts them; elsewhere nothing is bound.

    What goes beyond that is a MemoryError, or the end of native code that does not expect one.
    """
    if not _STATUS.exists():
        return
    import resource

    row = next(line for line in _STATUS.read_text().splitlines() if line.startswith("VmData"))
    most = int(row.split()[1]) * 1024 + more
    hard = resource.getrlimit(resource.RLIMIT_DATA)[1]
    resource.setrlimit(resource.RLIMIT_DATA, (most if hard == resource.RLIM_INFINITY else min(most, hard), hard))
