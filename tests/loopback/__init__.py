"""A server on loopback that speaks `chat/completions`: right, or slow, broken, rate-limited, truncated or lying.

    with serving(lambda asked: labels_as_json({0: "leg"})) as server:
        endpoint = Endpoint(VlmSettings(base_url=server.base_url, model=server.model))

An answer is the text that the function makes of what was asked. `server.asked` lists every request with what became of
it, `server.usage` what was charged.
"""

from tests.loopback.asked import Asked
from tests.loopback.faults import CUT, DROP, FAULTS, GARBAGE, SLOW, Fault, sometimes, status
from tests.loopback.server import KEY, MODEL, Server, labels_as_json, serving

__all__ = [
    "CUT",
    "DROP",
    "FAULTS",
    "GARBAGE",
    "KEY",
    "MODEL",
    "SLOW",
    "Asked",
    "Fault",
    "Server",
    "labels_as_json",
    "serving",
    "sometimes",
    "status",
]
