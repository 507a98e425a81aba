"""What a script may do, as the interpreter itself watches over it: a second fence, or the only one.

Of the standard library only, since it runs in Blender's Python.
"""

from __future__ import annotations

import os
import resource
import sys
from collections.abc import Sequence
from pathlib import Path

_REFUSED = {
    "the network": ("socket.", "urllib.", "http.", "ftplib.", "smtplib.", "imaplib.", "poplib.", "telnetlib."),
    "other processes": ("subprocess.", "os.system", "os.exec", "os.posix_spawn", "os.spawn", "os.fork", "os.kill",
                        "pty.", "signal.pthread_kill"),
    "calling into the system": ("ctypes.", "resource.", "sys.addaudithook", "syslog.", "fcntl.", "os.putenv"),
}  # fmt: skip
_ON_FILES = frozenset(
    {"os.remove", "os.rename", "os.mkdir", "os.rmdir", "os.symlink", "os.link", "os.chmod", "os.chown", "os.truncate",
     "os.utime", "os.setxattr", "os.removexattr", "os.mkfifo", "os.mknod"}
)  # fmt: skip
_WRITING = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_APPEND


def limit(memory: int, file: int, seconds: int) -> None:
    """Limit the address space [bytes], the largest file that is written [bytes], and the processor time [s]."""
    for what, most in (
        (resource.RLIMIT_AS, memory),
        (resource.RLIMIT_FSIZE, file),
        (resource.RLIMIT_CPU, seconds),
        (resource.RLIMIT_CORE, 0),
        (resource.RLIMIT_NOFILE, 256),
    ):
        resource.setrlimit(what, (most, most))


def watch(read: Sequence[str], write: Sequence[str]) -> None:
    """Refuse from now on what is not a script's business, with a PermissionError; cannot be taken back from Python."""
    readable, writable = _roots([*read, *write]), _roots(write)

    def hook(event: str, arguments: tuple[object, ...]) -> None:
        if event == "open":
            _check(arguments[0], writable if _writes(arguments) else readable)
        elif event in _ON_FILES:
            for path in arguments[:2]:
                _check(path, writable)
        elif event in ("os.listdir", "os.scandir"):
            _check(arguments[0], readable)
        else:
            for what, events in _REFUSED.items():
                if event.startswith(events):
                    raise PermissionError(f"{what} may not be used here ({event})")

    sys.addaudithook(hook)


def _writes(arguments: tuple[object, ...]) -> bool:
    flags = arguments[2] if len(arguments) > 2 else 0
    return isinstance(flags, int) and bool(flags & _WRITING)


def _check(path: object, allowed: tuple[str, ...]) -> None:
    if not isinstance(path, str | bytes | os.PathLike):
        return  # a descriptor that is open already, or a mode
    real = os.path.realpath(os.fsdecode(path))
    if real != os.devnull and not any(real == root or real.startswith(root + os.sep) for root in allowed):
        raise PermissionError(f"files outside of the working folder may not be used here ({Path(real).name})")


def _roots(paths: Sequence[str]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(os.path.realpath(path) for path in paths))
