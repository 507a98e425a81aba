"""Landlock: from a moment on this process reads and writes files only where it may, and starts no program.

For Linux 5.13 and later, without privileges; of the standard library only, since it runs in Blender's Python.
"""

from __future__ import annotations

import ctypes
import os
import stat
import struct
from collections.abc import Iterable

_CREATE, _ADD, _RESTRICT = 444, 445, 446  # system calls, the same on all processors
_VERSION, _PATH, _NO_NEW_PRIVILEGES = 1, 1, 38
_WRITE_FILE, _READ_FILE, _READ_DIR = 1 << 1, 1 << 2, 1 << 3
_MAKE_SYMLINK = 1 << 12
_OF_A_FILE = (1 << 0) | _WRITE_FILE | _READ_FILE | (1 << 14) | (1 << 15)
_RIGHTS = {1: 13, 2: 14, 3: 15, 4: 15}
"""How many rights on files each version of the interface knows; later ones 16."""


def version() -> int:
    """The version of the interface, 0 where the kernel has none."""
    return max(0, int(_calls().syscall(_CREATE, None, 0, _VERSION)))


def restrict(read: Iterable[str], write: Iterable[str]) -> bool:
    """Allow reading of `read` and all below, and reading and writing of `write`; nothing else, for good.

    No program is started any more, and from version 4 on no TCP connection made or taken. To be called while there is
    one thread: those that are there already stay free. False where the kernel cannot.
    """
    known = version()
    if not known:
        return False
    every = (1 << _RIGHTS.get(known, 16)) - 1
    rules = struct.pack("=QQQ", every, 3, 3)[: 8 if known < 4 else 16 if known < 6 else 24]
    calls = _calls()
    ruleset = calls.syscall(_CREATE, rules, len(rules), 0)
    if ruleset < 0:
        return False
    try:
        for paths, rights in ((read, _READ_FILE | _READ_DIR), (write, every & ~1 & ~_MAKE_SYMLINK)):
            for path in paths:
                _allow(ruleset, path, rights & every)
        calls.prctl(_NO_NEW_PRIVILEGES, 1, 0, 0, 0)
        return bool(calls.syscall(_RESTRICT, ruleset, 0) == 0)
    finally:
        os.close(ruleset)


def _allow(ruleset: int, path: str, rights: int) -> None:
    try:
        place = os.open(path, os.O_PATH | os.O_CLOEXEC)
    except OSError:
        return  # what is not there need not be allowed
    try:
        is_folder = stat.S_ISDIR(os.fstat(place).st_mode)
        rule = struct.pack("=Qi", rights if is_folder else rights & _OF_A_FILE, place)
        _calls().syscall(_ADD, ruleset, _PATH, rule, 0)
    finally:
        os.close(place)


def _calls() -> ctypes.CDLL:
    return ctypes.CDLL(None, use_errno=True)
