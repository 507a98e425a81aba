from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import pytest
from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import PlainTextResponse
from starlette.routing import Route, WebSocketRoute
from starlette.testclient import TestClient
from starlette.websockets import WebSocket, WebSocketDisconnect

from meshforge.common import UsageError
from meshforge.studio.api.connection import PROTOCOL, Guard
from meshforge.studio.api.server import LastAddress

TOKEN = "a-token_1"
NONE: list[str] = []


async def _answer(request: Request) -> PlainTextResponse:
    return PlainTextResponse("inside")


async def _talk(socket: WebSocket) -> None:
    await socket.accept(subprotocol=PROTOCOL)
    await socket.send_text("inside")
    await socket.close()


@pytest.fixture
def client() -> Iterator[TestClient]:
    routes = [Route("/", _answer), Route("/api/asset", _answer), WebSocketRoute("/ws", _talk)]
    with TestClient(Guard(Starlette(routes=routes), TOKEN), base_url="http://127.0.0.1") as found:
        yield found


def test_a_request_has_its_token_in_a_header_and_never_in_its_address(client: TestClient) -> None:
    assert client.get("/api/asset", headers={"Authorization": f"Bearer {TOKEN}"}).text == "inside"
    assert client.get(f"/api/asset?token={TOKEN}").status_code == 401
    assert client.get("/api/asset", headers={"Authorization": f"Basic {TOKEN}"}).status_code == 401
    assert client.get("/api/asset").status_code == 401
    assert client.get(f"/?token={TOKEN}").text == "inside", "the first page takes it out of its own address"


def test_a_socket_offers_its_token_beside_the_protocol(client: TestClient) -> None:
    with client.websocket_connect("ws://127.0.0.1/ws", subprotocols=[PROTOCOL, TOKEN]) as socket:
        assert socket.accepted_subprotocol == PROTOCOL, "the token is not sent back"
        assert socket.receive_text() == "inside"


@pytest.mark.parametrize(
    ("address", "offered"),
    [
        (f"/ws?token={TOKEN}", NONE),
        (f"/ws?token={TOKEN}", [PROTOCOL]),
        ("/ws", [PROTOCOL, "wrong"]),
        ("/ws", [TOKEN]),
        ("/ws", [TOKEN, PROTOCOL]),
        ("/ws", [PROTOCOL, "wrong", TOKEN]),
    ],
)
def test_a_socket_without_its_token_is_refused(client: TestClient, address: str, offered: list[str]) -> None:
    with pytest.raises(WebSocketDisconnect), client.websocket_connect(f"ws://127.0.0.1{address}", subprotocols=offered):
        pass


def _listen(address: LastAddress, port: int | None = None) -> tuple[int, str]:
    listening, token = address.listen(port)
    with closing(listening):
        return listening.getsockname()[1], token


def test_a_studio_takes_its_last_port_and_token_unless_another_has_it(tmp_path: Path) -> None:
    project, other = (LastAddress(tmp_path, tmp_path / name) for name in ("project", "other"))
    first = _listen(project)
    assert _listen(project) == first
    assert _listen(other)[1] != first[1]
    with closing(project.listen(None)[0]):
        with pytest.raises(UsageError, match=f"port {first[0]} cannot be taken"):
            project.listen(first[0])
        second = _listen(project)
    assert second[0] != first[0]
    assert second[1] != first[1], "the port is another"
    assert _listen(project, second[0]) == second
    for file in tmp_path.rglob("*.json"):
        assert file.stat().st_mode & 0o777 == 0o600
        file.chmod(0o644)
    assert _listen(project, second[0])[1] != second[1], "others could read it"
