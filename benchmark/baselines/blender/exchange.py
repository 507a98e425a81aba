"""A line to a process and a line back, by the clock, whatever the process does meanwhile."""

from __future__ import annotations

import os
import selectors
import subprocess
import time

_LONGEST = 64 << 20  # bytes of an answer
_BLOCK = 1 << 16


def exchange(process: subprocess.Popen[bytes], request: bytes, seconds: float) -> bytes:
    """The line that comes back for a line. Raises TimeoutError, and EOFError where none comes, or one far too long."""
    assert process.stdin
    assert process.stdout
    deadline, answer, rest = time.monotonic() + seconds, bytearray(), memoryview(request)
    source, sink = process.stdout.fileno(), process.stdin.fileno()
    os.set_blocking(sink, False)
    with selectors.DefaultSelector() as ready:
        ready.register(source, selectors.EVENT_READ)
        if rest:
            ready.register(sink, selectors.EVENT_WRITE)
        while (left := deadline - time.monotonic()) > 0:
            for key, _ in ready.select(left):
                if key.fd == sink:
                    rest = rest[_write(sink, rest[:_BLOCK]) :]
                    if not rest:
                        ready.unregister(sink)
                    continue
                block = os.read(source, _BLOCK)
                answer += block
                if answer.endswith(b"\n"):
                    return bytes(answer)
                if not block or len(answer) > _LONGEST:
                    raise EOFError
    raise TimeoutError


def _write(sink: int, block: memoryview) -> int:
    """How much of a block went through."""
    try:
        return os.write(sink, block)
    except BlockingIOError:
        return 0
    except BrokenPipeError:
        raise EOFError from None
