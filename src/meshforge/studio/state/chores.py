"""What is done in the background after every change: cards of what changed, then the project as a whole."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from threading import Condition, Thread

Refresh = Callable[[tuple[str, ...]], None]


class Chores:
    """A thread that refreshes assets by their ids: urgent ones first, then the rest, some at a time.

    refresh: called with some ids, or none where only the project as a whole is to be looked at; size: of one portion.
    """

    def __init__(self, refresh: Refresh, size: Callable[[], int]) -> None:
        self._refresh, self._size = refresh, size
        self._wake = Condition()
        self._urgent: dict[str, None] = {}
        self._rest: dict[str, None] = {}
        self._whole = False
        self._closed = False
        self._thread = Thread(target=self._run, name="chores", daemon=True)

    def start(self) -> None:
        """Begin."""
        self._thread.start()

    def add(self, assets: Iterable[str] = (), *, later: bool = False) -> None:
        """Have some assets refreshed, and the project; later: after those that are urgent."""
        with self._wake:
            (self._rest if later else self._urgent).update(dict.fromkeys(assets))
            self._whole = True
            self._wake.notify()

    @property
    def remaining(self) -> int:
        """How many assets are still to be refreshed."""
        with self._wake:
            return len(self._urgent | self._rest)

    def is_closed(self) -> bool:
        """Whether what is being done is to stop."""
        return self._closed

    def close(self) -> None:
        """Stop, and wait for the end of what is being done."""
        with self._wake:
            self._closed = True
            self._wake.notify()
        if self._thread.is_alive():
            self._thread.join()

    def _run(self) -> None:
        while True:
            with self._wake:
                self._wake.wait_for(lambda: self._urgent or self._rest or self._whole or self._closed)
                if self._closed:
                    return
                assets = self._take_portion()
                self._whole = False
            self._refresh(assets)

    def _take_portion(self) -> tuple[str, ...]:
        source = self._urgent or self._rest
        assets = tuple(source)[: self._size()]
        for asset in assets:
            self._urgent.pop(asset, None)
            self._rest.pop(asset, None)
        return assets
