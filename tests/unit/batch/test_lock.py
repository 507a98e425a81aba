import os
import threading
from pathlib import Path

import pytest

from meshforge.batch import hold_lock
from meshforge.common import MeshForgeError
from tests.unit.deaths import needs_fork


def is_free(path: Path, *, again: bool = True) -> bool:
    """Whether the present thread gets a lock at once."""
    try:
        with hold_lock(path, "it", wait=0, again=again):
            return True
    except MeshForgeError:
        return False


def is_free_elsewhere(path: Path) -> bool:
    """Whether another thread gets a lock at once."""
    found: list[bool] = []
    thread = threading.Thread(target=lambda: found.append(is_free(path)))
    thread.start()
    thread.join()
    return found == [True]


def test_a_thread_takes_a_lock_again_and_holds_it_until_the_first_time_ends(tmp_path: Path) -> None:
    path = tmp_path / "lock"
    with hold_lock(path, "it", again=True):
        assert is_free(path)
        assert not is_free_elsewhere(path)
    assert is_free_elsewhere(path)


def test_a_lock_that_is_not_to_be_taken_again_is_not(tmp_path: Path) -> None:
    path = tmp_path / "lock"
    with hold_lock(path, "it"):
        assert not is_free(path) and not is_free(path, again=False)
    with hold_lock(path, "it", again=True):
        assert not is_free(path, again=False)


def test_an_error_inside_lets_go_of_the_lock(tmp_path: Path) -> None:
    path = tmp_path / "lock"
    with pytest.raises(ValueError, match="inside"), hold_lock(path, "it", again=True):
        raise ValueError("inside")
    assert is_free_elsewhere(path)
    with hold_lock(path, "it", again=True):
        assert not is_free_elsewhere(path)


@needs_fork
def test_a_forked_process_does_not_hold_what_its_parent_holds(tmp_path: Path) -> None:
    path = tmp_path / "lock"
    with hold_lock(path, "it", again=True):
        child = os.fork()
        if child == 0:
            os._exit(1 if is_free(path) else 0)
        assert os.waitpid(child, 0)[1] == 0
