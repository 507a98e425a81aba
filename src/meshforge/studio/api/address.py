"""The port and the token that a studio had last, so that pages which are still open connect again by themselves.

They lie in the user's state folder, one file a project that only the user can read: never in the project, which may be
shared or committed. A token is used again on its own port alone.
"""

import socket
from contextlib import suppress
from pathlib import Path
from secrets import token_urlsafe

from pydantic import ValidationError

from meshforge.batch import text_digest
from meshforge.common import UsageError, write_atomically
from meshforge.store import JsonFile

ADDRESS = "127.0.0.1"
_PRIVATE = 0o600


class _LastFile(JsonFile):
    port: int
    token: str


class LastAddress:
    """What is kept of the studio of a project, or of the start page, in the user's state folder."""

    def __init__(self, state: Path, folder: Path | None) -> None:
        name = text_digest(str(folder.resolve()))[:32] if folder else "start"
        self._path = state / "addresses" / f"{name}.json"

    def listen(self, port: int | None) -> tuple[socket.socket, str]:
        """Return a socket on a port, and the token of the studio there, which are kept. port: None takes the last one
        where it is free, else a free one, as 0 does. Raises UsageError where the port is taken."""
        last = self._read()
        if port is None and last:
            with suppress(UsageError):
                return _listen(last.port), last.token
        listening = _listen(port or 0)
        taken: int = listening.getsockname()[1]
        token = last.token if last and last.port == taken else token_urlsafe(24)
        with suppress(OSError):  # a home that cannot be written to: pages have to be opened again
            self._path.parent.mkdir(parents=True, exist_ok=True)
            self._path.touch(_PRIVATE)  # before anything is in it
            write_atomically(self._path, _LastFile(port=taken, token=token).model_dump_json())
        return listening, token

    def _read(self) -> _LastFile | None:
        try:
            is_private = self._path.stat().st_mode & 0o777 == _PRIVATE
            return _LastFile.model_validate_json(self._path.read_bytes()) if is_private else None
        except (OSError, ValidationError):
            return None


def _listen(port: int) -> socket.socket:
    try:
        return socket.create_server((ADDRESS, port))
    except (OSError, OverflowError) as error:
        remedy = "Choose another: --port N; 0 takes a free one."
        raise UsageError(f"port {port} cannot be taken: {error}", remedy=remedy) from None
