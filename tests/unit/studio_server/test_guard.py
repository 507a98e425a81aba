from __future__ import annotations

from collections.abc import Iterator

import pytest
from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import PlainTextResponse
from starlette.routing import Route, WebSocketRoute
from starlette.testclient import TestClient
from starlette.websockets import WebSocket, WebSocketDisconnect

from meshforge.studio.api.connection import PROTOCOL, Guard

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
