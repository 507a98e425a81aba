"""What all routes share: the desk, and answers in bytes."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import Depends, Header
from fastapi.requests import HTTPConnection
from fastapi.responses import Response

from meshforge.studio.state import Desk


def _desk(connection: HTTPConnection) -> Desk:
    desk: Any = connection.app.state.desk
    assert isinstance(desk, Desk)
    return desk


AtDesk = Annotated[Desk, Depends(_desk)]
"""The desk of the studio."""
FromPage = Annotated[str | None, Header(alias="X-Page")]
"""The page that asks, as it calls itself."""


def packet(data: bytes) -> Response:
    """A packet of shapes, which pages ask for anew each time."""
    return Response(data, media_type="application/octet-stream", headers={"Cache-Control": "no-store"})
