"""The server, in threads of its own."""

from __future__ import annotations

import json
import threading
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any, Literal
from unittest.mock import patch

from tests.loopback.asked import Asked
from tests.loopback.faults import Fault, status

Answering = Callable[[Asked], str]
MODEL, KEY = "loopback-vl", "sk-loopback-secret"
_TOKEN = 4  # characters
_PICTURE = 800  # tokens


def labels_as_json(labels: Mapping[int, str]) -> str:
    """An answer of the form that is asked for."""
    return json.dumps({"object": "a thing", "parts": sorted({*labels.values()}), "hulls": labels})


@dataclass
class Server:
    """What it answers and how, and what it was asked.

    fault: what goes wrong with a request, None where nothing does. schema: honoured, silently ignored, or refused;
    thinks: a model that takes neither max_tokens nor temperature;
    sees: a model that takes pictures; tells: whether usage is told. slow [s]: how long a slow request takes.
    """

    answer: Answering
    fault: Callable[[Asked], Fault | None] = lambda asked: None
    schema: Literal["honoured", "ignored", "refused"] = "honoured"
    thinks: bool = False
    sees: bool = True
    tells: bool = True
    slow: float = 0.5
    delay: float = 0.0
    model: str = MODEL
    key: str = KEY
    base_url: str = ""
    asked: list[tuple[Asked, int, bool]] = field(default_factory=list)
    """Each request, the status it was answered with (0: not at all), and whether with a whole answer."""
    usage: Counter[str] = field(default_factory=Counter)
    """Tokens of all answers that were sent."""
    closing: threading.Event = field(default_factory=threading.Event)
    _lock: threading.Lock = field(default_factory=threading.Lock)
    _seen: Counter[str] = field(default_factory=Counter)

    @property
    def answered(self) -> list[Asked]:
        """The requests that got an answer, the question about a red picture aside."""
        return [asked for asked, _, whole in self.asked if whole and not asked.is_probe]

    def handle(self, body: Mapping[str, Any], key: str) -> tuple[int, Mapping[str, str], str] | None:
        """Status, headers and text of the response; None for none."""
        raw = json.dumps(body, sort_keys=True)
        with self._lock:
            asked = Asked(body, key, self._seen[raw])
            self._seen[raw] += 1
        response, whole = self._response(asked)
        with self._lock:
            self.asked.append((asked, response[0] if response else 0, whole))
        return response

    def _response(self, asked: Asked) -> tuple[tuple[int, Mapping[str, str], str] | None, bool]:
        if self.delay:
            self.closing.wait(self.delay)
        fault = self._refusal(asked) or self.fault(asked)
        match fault:
            case Fault("status", code, headers, error):
                return (code, headers, json.dumps(error)), False
            case Fault("garbage"):
                return (200, fault.headers, "<html>All our servers are busy</html>"), False
            case Fault("slow"):
                self.closing.wait(self.slow)
                return None, False
            case Fault("drop"):
                return None, False
        return (200, {}, json.dumps(self._completion(asked, cut=fault is not None))), True

    def _refusal(self, asked: Asked) -> Fault | None:
        body = asked.body
        if self.key and asked.key != self.key:
            return status(401, f"Incorrect API key provided: {asked.key}", type="invalid_api_key")
        if body["model"] != self.model:
            return status(404, f"The model `{body['model']}` does not exist", type="model_not_found")
        if not self.sees and asked.pictures:
            return status(400, "image input is not supported")
        if self.thinks and "max_tokens" in body:
            return status(400, "Unsupported parameter: 'max_tokens'. Use 'max_completion_tokens' instead.")
        if self.thinks and "temperature" in body:
            return status(400, "Unsupported value: 'temperature' does not support 0 with this model.")
        if self.schema == "refused" and "response_format" in body:
            return status(400, "unknown field response_format")
        return None

    def _completion(self, asked: Asked, *, cut: bool) -> dict[str, Any]:
        text = self._probed(asked) if asked.is_probe else self.answer(asked)
        if cut:
            text = text[: len(text) * 2 // 3]
        message = {"role": "assistant", "content": text}
        choice = {"index": 0, "message": message, "finish_reason": "length" if cut else "stop"}
        given = len(asked.text) // _TOKEN + _PICTURE * len(asked.pictures)
        made = len(text) // _TOKEN + 1
        with self._lock:
            self.usage.update(input=given, output=made)
        usage = {"prompt_tokens": given, "completion_tokens": made, "total_tokens": given + made}
        return {"object": "chat.completion", "choices": [choice]} | ({"usage": usage} if self.tells else {})

    def _probed(self, asked: Asked) -> str:
        return '{"colour": "red"}' if self.schema == "honoured" and asked.schema else "Red."


@contextmanager
def serving(answer: Answering, **how: Any) -> Iterator[Server]:
    """A server on a free port for the time of a `with` block, in which the SDK hardly waits before it tries again; how:
    fields of `Server`."""
    server = Server(answer, **how)

    class Handler(BaseHTTPRequestHandler):
        protocol_version = "HTTP/1.1"

        def do_POST(self) -> None:
            body = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
            key = self.headers.get("Authorization", "").removeprefix("Bearer ")
            response = server.handle(body, key) if self.path == "/v1/chat/completions" else (404, {}, "no such page")
            if response is None:
                self.close_connection = True
                return
            code, headers, text = response
            self.send_response(code)
            for name, value in {"Content-Type": "application/json", **headers}.items():
                self.send_header(name, value)
            self.send_header("Content-Length", str(len(text.encode())))
            self.end_headers()
            self.wfile.write(text.encode())

        def log_message(self, format: str, *args: object) -> None:
            """Quiet."""

    class Quiet(ThreadingHTTPServer):
        daemon_threads = True
        request_queue_size = 128

        def handle_error(self, request: object, client_address: object) -> None:
            """A client that has gone is no error."""

    with Quiet(("127.0.0.1", 0), Handler) as http, patch("openai._base_client.INITIAL_RETRY_DELAY", 0.001):
        server.base_url = f"http://127.0.0.1:{http.server_address[1]}/v1"
        thread = threading.Thread(target=lambda: http.serve_forever(poll_interval=0.02), daemon=True)
        thread.start()
        try:
            yield server
        finally:
            server.closing.set()
            http.shutdown()
            thread.join()
