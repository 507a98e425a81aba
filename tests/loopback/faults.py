"""What goes wrong on the way, and how often."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal

from tests.loopback.asked import Asked


@dataclass(frozen=True)
class Fault:
    """kind: `status` answers with code, headers and error; `drop` closes the connection, `slow` does so after a while;
    `garbage` sends text that is no JSON; `cut` ends the answer in its midst, as `finish_reason` length says.
    """

    kind: Literal["status", "drop", "slow", "garbage", "cut"]
    code: int = 200
    headers: Mapping[str, str] = field(default_factory=dict)
    error: Any = None


def status(
    code: int, message: str = "something is wrong", *, headers: Mapping[str, str] | None = None, **more: Any
) -> Fault:
    """An HTTP error in the usual form; more: fields beside the message."""
    return Fault("status", code, headers or {}, {"error": {"message": message, **more}})


DROP, SLOW, GARBAGE, CUT = Fault("drop"), Fault("slow"), Fault("garbage"), Fault("cut")
FAULTS: tuple[Fault, ...] = (
    status(500),
    status(429, "too fast", headers={"Retry-After": "0.02"}),
    DROP,
    GARBAGE,
    status(503, headers={"Retry-After": "0"}),
    CUT,
    SLOW,
)


PASSING = tuple(fault for fault in FAULTS if fault is not GARBAGE)
"""Those that are worth another attempt."""


def sometimes(share: float, faults: Sequence[Fault] = PASSING, seed: int = 0) -> Callable[[Asked], Fault | None]:
    """One of the faults for a share of requests, always the same for the same request made as often before."""

    def fault(asked: Asked) -> Fault | None:
        mixed = json.dumps([asked.raw, asked.time, seed]).encode()
        number = int.from_bytes(hashlib.blake2b(mixed, digest_size=8).digest(), "big") / 2**64
        return faults[int(number / share * len(faults))] if number < share else None

    return fault
