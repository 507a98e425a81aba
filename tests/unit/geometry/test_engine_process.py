import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

from meshforge.geometry.decomposition import worker

_CALLER = """
import subprocess, sys
engine = subprocess.Popen([sys.executable, "-P", *sys.argv[1:]])
print(engine.pid, flush=True)
engine.wait()
"""


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux ends a process with the one that started it")
def test_an_engine_ends_with_the_process_that_started_it(tmp_path: Path) -> None:
    pipe = tmp_path / worker.MESH.format(0)
    os.mkfifo(pipe)
    (tmp_path / worker.JOBS).write_text('[{"engine": "coacd"}]')
    words = [sys.executable, "-c", _CALLER, worker.__file__, str(tmp_path), "0"]
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as caller:
        assert caller.stdout
        engine = int(caller.stdout.readline())
        with pipe.open("wb"):  # opens when the engine does, which then waits for its mesh
            assert _runs(engine)
            caller.kill()
            caller.wait()
            end = time.monotonic() + 20
            while _runs(engine) and time.monotonic() < end:
                time.sleep(0.01)
            assert not _runs(engine)


def _runs(process: int) -> bool:
    """Whether a process is there, and is not merely waiting to be buried."""
    try:
        return "State:\tZ" not in Path(f"/proc/{process}/status").read_text()
    except (FileNotFoundError, ProcessLookupError):
        return False
