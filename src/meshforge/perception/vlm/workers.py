"""Threads that wait for answers; they do not keep a program from ending that was told twice to stop."""

from __future__ import annotations

import threading
from collections.abc import Callable
from concurrent.futures import Future
from contextlib import suppress
from queue import Empty, Queue
from typing import TypeVar

Result = TypeVar("Result")
_WAITING = 3  # tasks for each thread that wait in line; handing in more takes until there is room


class Workers:
    """So many threads, which work on tasks in the order they are handed in."""

    def __init__(self, count: int) -> None:
        self._line: Queue[Callable[[], None] | None] = Queue(_WAITING * count)
        self._threads = [threading.Thread(target=self._work, name=f"asking-{k}", daemon=True) for k in range(count)]
        for thread in self._threads:
            thread.start()

    def submit(self, task: Callable[[], Result]) -> Future[Result]:
        """Hand in a task, as soon as there is room in the line."""
        future: Future[Result] = Future()

        def run() -> None:
            try:
                future.set_result(task())
            except BaseException as error:  # it is raised where the result is asked for
                future.set_exception(error)

        self._line.put(run)
        return future

    def close(self) -> None:
        """End each thread after the task that it is at; tasks that wait in line are dropped, and never done."""
        with suppress(Empty):
            while True:
                self._line.get_nowait()
        for _ in self._threads:
            self._line.put(None)

    def _work(self) -> None:
        while (task := self._line.get()) is not None:
            task()
