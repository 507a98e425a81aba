from __future__ import annotations

import threading
from functools import partial

import pytest

from meshforge.labels.vlm.labeller import RequestThreads


def test_results_come_back_to_who_asked_and_so_do_errors() -> None:
    workers = RequestThreads(3)
    futures = [workers.submit(partial(divmod, 100, k)) for k in range(20)]
    with pytest.raises(ZeroDivisionError):
        futures[0].result(timeout=10)
    assert [future.result(timeout=10) for future in futures[1:]] == [divmod(100, k) for k in range(1, 20)]
    workers.close()


def test_what_waits_in_line_is_dropped_at_the_end_and_nothing_hangs() -> None:
    workers, gate, begun = RequestThreads(1), threading.Event(), threading.Event()

    def slow() -> str:
        begun.set()
        gate.wait(10)
        return "done"

    first = workers.submit(slow)
    begun.wait(10)
    second = workers.submit(lambda: "never")
    workers.close()
    gate.set()
    assert first.result(timeout=10) == "done"
    for thread in workers._threads:
        thread.join(10)
        assert not thread.is_alive()
    assert not second.done()
