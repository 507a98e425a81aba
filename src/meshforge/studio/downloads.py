"""Files that were made for the browser to take away: kept until the studio is closed, and given out by tickets, each
of which is good once, since the address of a download cannot carry the token."""

from __future__ import annotations

import re
import shutil
from dataclasses import dataclass
from pathlib import Path
from secrets import token_urlsafe
from threading import Lock
from time import monotonic

from meshforge.studio.errors import NotHereError

TICKET_SECONDS = 60.0
MOST_FILES = 6
"""Files that are kept; the oldest goes."""
_ODD = re.compile(r"[^\w.-]+")


@dataclass(frozen=True, slots=True)
class _Ticket:
    path: Path
    until: float


class Downloads:
    """The files of one studio, by the job that made each."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._lock = Lock()
        self._files: dict[str, Path] = {}
        self._tickets: dict[str, _Ticket] = {}
        self.clear()

    def path_for(self, number: str, name: str) -> Path:
        """Where a file is to be written. number: of its making, which no other has; name: what the browser calls it."""
        return self._folder / number / name

    def add(self, job: str, path: Path) -> None:
        """A job has made a file."""
        with self._lock:
            self._files[job] = path
            while len(self._files) > MOST_FILES:
                oldest = self._files.pop(next(iter(self._files)))
                shutil.rmtree(oldest.parent, ignore_errors=True)

    def give_ticket(self, job: str) -> str:
        """A ticket for the file of a job. Raises NotHereError where there is none, or none any more."""
        with self._lock:
            path, now = self._files.get(job), monotonic()
            if path is None or not path.is_file():
                raise NotHereError("this file is not kept any more", remedy="Make it again.")
            self._tickets = {ticket: one for ticket, one in self._tickets.items() if one.until > now}
            ticket = token_urlsafe(24)
            self._tickets[ticket] = _Ticket(path, now + TICKET_SECONDS)
            return ticket

    def redeem(self, ticket: str) -> Path:
        """The file of a ticket, which is good no more. Raises NotHereError for one that is not good."""
        with self._lock:
            found = self._tickets.pop(ticket, None)
        if found is None or found.until <= monotonic() or not found.path.is_file():
            raise NotHereError("this address was good for one download", remedy="Save the file again in the studio.")
        return found.path

    def clear(self) -> None:
        """Remove all files."""
        with self._lock:
            self._files, self._tickets = {}, {}
        shutil.rmtree(self._folder, ignore_errors=True)


def to_file_name(*words: str) -> str:
    """Words as the name of a file on every system, joined by `-`."""
    return "-".join(plain for word in words if (plain := _ODD.sub("-", word).strip("-."))) or "meshforge"
