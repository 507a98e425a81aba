"""Headless Blender in a process of its own: no network, no files, no keys, little memory, and by the clock.

What keeps a script in, from the outside inwards. Always: a clock for each mesh, after which the process is killed with
all that it started; limits on memory, on the size of files and on processor time; an environment without any variable
of ours; an audit hook of the interpreter, which refuses sockets, other processes, calls into the system, and files
outside of a folder that is removed afterwards. Where the system allows it: namespaces of its own, in which there is no
network and no other process; and Landlock, by which the kernel itself refuses to read and write anything else than
Blender needs, to start a program, and to connect by TCP.

Not prevented: what Python, Blender and the system's libraries consist of can be read; a processor is busy for as long
as the clock lets it be; the folder may be filled with many files; faults of the kernel may be used. Without Landlock
Blender's own code, which no audit hook sees, reads and writes files; without namespaces it may open connections.
"""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import tempfile
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Any

from benchmark.baselines.blender.apart import alone, environment
from benchmark.baselines.blender.exchange import exchange
from meshforge.common import UsageError

_INSIDE = "benchmark.baselines.blender.inside"
_INSTALL = (
    "Blender is the package bpy, for Python 3.11: python3.11 -m venv .bench/blender && "
    ".venv/bin/python -m pip --python .bench/blender/bin/python install --group blender"
)


@dataclass(frozen=True, slots=True)
class Limits:
    """seconds: for a script on one mesh, and start for Blender itself; memory, file [bytes]; cpu [s]: in all."""

    seconds: float = 20.0
    start: float = 120.0
    memory: int = 4 << 30
    file: int = 32 << 20
    cpu: int = 3600


@dataclass(frozen=True, slots=True)
class Fences:
    """What keeps a script in. alone: namespaces without a network and without other processes; landlock: the version
    of the kernel's fence around files, 0 for none."""

    blender: str
    alone: bool
    landlock: int

    def __str__(self) -> str:
        network = "a network namespace" if self.alone else "Python's own audit hook alone"
        files = f"Landlock {self.landlock}" if self.landlock else "Python's own audit hook alone"
        return f"the network by {network}, files and other programs by {files}"


class Blender:
    """Runs scripts, each on a fresh scene; started when it is first needed, and again after it was stopped.

    python: one that has the module bpy. To be closed. Raises UsageError, from any of its methods, where it has not.
    """

    def __init__(self, python: Path, limits: Limits | None = None) -> None:
        self._python, self.limits = python.absolute(), limits or Limits()
        self._process: subprocess.Popen[bytes] | None = None
        self._scratch = ""
        self._fences: Fences | None = None
        self._count = 0

    def __enter__(self) -> Blender:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self.close()

    @property
    def fences(self) -> Fences:
        """What is in force."""
        self._start()
        assert self._fences
        return self._fences

    def run(self, script: str, scene: Mapping[str, Any]) -> Mapping[str, Any]:
        """What a script makes of a scene, as of `objects.edit_scene`."""
        process, self._count = self._start(), self._count + 1
        request = json.dumps({"number": self._count, "script": script, "scene": scene}).encode() + b"\n"
        try:
            answer = json.loads(exchange(process, request, self.limits.seconds))
            match answer:
                case {"number": self._count, "objects": [*_]} | {"number": self._count, "error": str()}:
                    return dict(answer)
            why = "it wrote where only results are written"
        except TimeoutError:
            why = f"it took longer than {self.limits.seconds:g} seconds"
        except (EOFError, ValueError, RecursionError):
            why = "Blender broke down under it"
        self.close()
        return {"error": why}

    def close(self) -> None:
        """Stop Blender and all that it started, and remove its folder."""
        process, self._process = self._process, None
        if process:
            with suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            for stream in (process.stdin, process.stdout):
                with suppress(OSError):
                    stream.close()  # type: ignore[union-attr]  # both are pipes
        if self._scratch:
            shutil.rmtree(self._scratch, ignore_errors=True)
            self._scratch = ""

    def _start(self) -> subprocess.Popen[bytes]:
        if self._process and self._process.poll() is None:
            return self._process
        self.close()
        if not os.access(self._python, os.X_OK):
            raise UsageError("there is no program here", where=str(self._python), remedy=_INSTALL)
        self._scratch = tempfile.mkdtemp(prefix="blender-")
        most = self.limits
        limits = map(str, (most.memory, most.file, most.cpu))
        namespaces = alone()
        command = [*namespaces, str(self._python), "-s", "-P", "-m", _INSIDE, self._scratch, *limits]
        with tempfile.TemporaryFile() as complaints:
            try:
                process = subprocess.Popen(
                    command,
                    stdin=subprocess.PIPE,
                    stdout=subprocess.PIPE,
                    stderr=complaints,
                    cwd=self._scratch,
                    env=environment(self._scratch),
                    start_new_session=True,
                )
            except OSError as error:
                self.close()
                why, where = f"cannot be run: {error.strerror}", str(self._python)
                raise UsageError(why, where=where, remedy=_INSTALL) from error
            self._process = process
            try:
                told = json.loads(exchange(process, b"", most.start))
            except (TimeoutError, EOFError):
                self.close()
                complaints.seek(0)
                lines = complaints.read().decode(errors="replace").strip().splitlines()
                said = lines[-1] if lines else "it does not answer"
                raise UsageError(f"Blender does not start: {said}", where=str(self._python), remedy=_INSTALL) from None
        self._fences = Fences(told["blender"], bool(namespaces), told["landlock"])
        return process
