"""Each fence around scripts by itself, in a plain Python: what it lets through, and what not."""

import os
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest

from benchmark.baselines.blender import landlock
from benchmark.baselines.blender.apart import alone, environment
from benchmark.baselines.blender.process import Blender, Limits
from meshforge.common import UsageError

needs_landlock = pytest.mark.skipif(not landlock.version(), reason="this kernel has no Landlock")


def ran(code: str, scratch: Path, *before: str) -> subprocess.CompletedProcess[str]:
    """Code in a Python of its own, with the benchmark at hand."""
    command = [*before, sys.executable, "-s", "-P", "-c", code]
    return subprocess.run(
        command, capture_output=True, text=True, timeout=60, check=False, cwd=scratch, env=environment(str(scratch))
    )


LOCKED = """
import os, sys
from benchmark.baselines.blender import landlock
assert landlock.restrict([sys.prefix, sys.base_prefix, "/usr", "/lib", "/lib64"], [{scratch!r}, os.devnull])
def tried(what):
    try:
        what()
    except OSError as error:
        print(type(error).__name__)
    else:
        print("done")
{rest}
"""


def locked(tmp_path: Path, rest: str) -> list[str]:
    scratch = tmp_path / "scratch"
    scratch.mkdir()
    done = ran(LOCKED.format(scratch=str(scratch), rest=rest), scratch)
    assert done.returncode == 0, done.stderr
    return done.stdout.split()


@needs_landlock
def test_landlock_keeps_reading_and_writing_to_what_is_allowed(tmp_path: Path) -> None:
    secret, outside = tmp_path / "secret", tmp_path / "written"
    secret.write_text("key", "utf-8")
    attempts = [
        "open('own', 'w').write('x')",
        "open('own').read()",
        "os.remove('own')",
        "open(os.devnull, 'w').write('x')",
        "open(os.__file__).read()",
        f"open({str(secret)!r}).read()",
        f"os.remove({str(secret)!r})",
        f"open({str(secret)!r}, 'a')",
        f"open({str(outside)!r}, 'w')",
        f"os.mkdir({str(outside)!r})",
        "os.symlink('/etc', 'etc')",
        f"os.listdir({str(tmp_path)!r})",
        "open('/proc/self/environ').read()",
        "os.execv('/bin/true', ['true'])",
    ]
    told = locked(tmp_path, "\n".join(f"tried(lambda: {what})" for what in attempts))
    assert told == ["done"] * 5 + ["PermissionError"] * 9
    assert secret.read_text("utf-8") == "key"
    assert not outside.exists()


def test_in_namespaces_of_its_own_a_process_reaches_nobody(tmp_path: Path) -> None:
    if not alone():
        pytest.skip("namespaces are not allowed here")
    with socket.create_server(("127.0.0.1", 0)) as server:
        code = f"import socket; socket.create_connection(('127.0.0.1', {server.getsockname()[1]}), 5)"
        assert ran(code, tmp_path).returncode == 0
        done = ran(code, tmp_path, *alone())
        assert done.returncode != 0
        assert "OSError" in done.stderr or "ConnectionRefusedError" in done.stderr
    mine = ran("import os; print(os.getpid())", tmp_path, *alone())
    assert mine.stdout.strip() == "1"
    assert ran(f"import os; os.kill({os.getpid()}, 0)", tmp_path, *alone()).returncode != 0


WATCHED = """
import os, sys
import ctypes, socket, subprocess, urllib.request
from benchmark.baselines.blender import guard
guard.watch([sys.prefix, sys.base_prefix], [{scratch!r}])
{rest}
"""


@pytest.mark.parametrize(
    ("code", "said"),
    [
        ("open('own', 'w').write('x'); print(open('own').read())", ""),
        ("open(os.__file__).read(); os.listdir('.'); open(os.devnull, 'w')", ""),
        ("import json, decimal, xml.dom.minidom", ""),
        ("open('/etc/passwd')", "files outside"),
        ("open(b'/etc/passwd')", "files outside"),
        ("os.open('/etc/passwd', os.O_RDONLY)", "files outside"),
        ("open('../x', 'w')", "files outside"),
        ("open(os.__file__, 'a')", "files outside"),
        ("os.rename('/etc/hostname', 'x')", "files outside"),
        ("os.listdir('/')", "files outside"),
        ("os.system('true')", "other processes"),
        ("subprocess.Popen(['true'])", "other processes"),
        ("os.posix_spawn('/bin/true', ['true'], {})", "other processes"),
        ("os.fork()", "other processes"),
        ("socket.socket()", "the network"),
        ("socket.getaddrinfo('localhost', 80)", "the network"),
        ("urllib.request.urlopen('http://localhost')", "the network"),
        ("ctypes.CDLL(None)", "calling into the system"),
        ("import resource; resource.setrlimit(resource.RLIMIT_AS, (-1, -1))", "calling into the system"),
    ],
)
def test_the_guard_refuses_what_is_not_a_scripts_business(tmp_path: Path, code: str, said: str) -> None:
    done = ran(WATCHED.format(scratch=str(tmp_path), rest=code), tmp_path)
    if said:
        assert "PermissionError" in done.stderr
        assert said in done.stderr
    else:
        assert done.returncode == 0, done.stderr


def test_a_program_that_never_answers_is_stopped_with_all_it_started(tmp_path: Path) -> None:
    silent, sign = tmp_path / "silent", tmp_path / "sign"
    silent.write_text(f"#!/bin/sh\n(while true; do echo >> {sign}; sleep 0.05; done) &\nsleep 600\n", "utf-8")
    silent.chmod(0o755)
    with pytest.raises(UsageError, match="it does not answer"):
        Blender(silent, Limits(start=1.0)).run("pass", {})
    size = sign.stat().st_size
    assert size
    time.sleep(0.3)
    assert sign.stat().st_size == size
