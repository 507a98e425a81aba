import os
import signal
from functools import partial
from pathlib import Path

from meshforge.batch.report.contents import read_again
from meshforge.formats import load
from meshforge.symbolic import SymbolicMesh
from tests.unit.batch.families import write_table


def dying() -> SymbolicMesh:
    """What a crash in native code looks like."""
    os.kill(os.getpid(), signal.SIGKILL)
    raise AssertionError


def test_what_crashes_or_cannot_be_read_costs_the_others_nothing(tmp_path: Path) -> None:
    good = partial(load, write_table(tmp_path / "a.obj"))
    found = read_again([dying, None, good, partial(load, tmp_path / "gone.obj"), good])
    assert [mesh is not None for mesh in found] == [False, False, True, False, True]
    assert found[2] and [hull.name for hull in found[2].hulls] == [hull.name for hull in good().hulls]
