"""USD's library runs in a process of its own: a layer that crashes or hangs it is one error; nothing else is lost."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from meshforge.batch import ExecutionOptions, WorkerFailure, run_isolated
from meshforge.common import AssetError, UsageError, processes
from meshforge.common.processes import call_isolated
from meshforge.formats import read, save
from tests.corpus_case import ROOT
from tests.usd_stages import CUP, written

HOSTILE = ROOT / "usd/bomb_dictionaries_twenty_thousand.usdc"


def process_of() -> int:
    return call_isolated(os.getpid, where="here")


@pytest.mark.slow
def test_a_layer_that_crashes_the_library_is_an_error_that_names_it_and_later_files_are_read(tmp_path: Path) -> None:
    cup, path = written(tmp_path, CUP), HOSTILE
    before, worker = read(cup), process_of()
    with pytest.raises(AssetError) as caught:
        read(path)
    assert caught.value.where == str(path)
    assert caught.value.problem.startswith("the process that read it died (SIG")
    assert caught.value.remedy == "The file is damaged, or made to do harm: repair it, or export it anew."
    again = read(cup)
    assert [geom.name for geom in again.geoms] == [geom.name for geom in before.geoms]
    assert process_of() not in (worker, os.getpid())
    saved = save(before.with_geoms(before.geoms[1:]), tmp_path / "out" / "a.usda")
    assert len(read(saved.path).geoms) == len(before.geoms) - 1, "what was read before the crash can be written"


@pytest.mark.slow
def test_a_layer_that_hangs_the_library_is_stopped(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It refers to itself so often that it has ten to the eighth prims."""
    read(written(tmp_path, CUP))
    monkeypatch.setattr(processes, "PATIENCE", 1.5)
    path = ROOT / "usd/bomb_references_ten_to_the_eight.usda"
    with pytest.raises(AssetError, match=r"came no further for 1\.5 seconds, and was stopped") as caught:
        read(path)
    assert caught.value.where == str(path)
    monkeypatch.undo()
    assert read(written(tmp_path, CUP)).geoms


def test_work_that_reports_progress_may_take_longer(monkeypatch: pytest.MonkeyPatch) -> None:
    call_isolated(work_slowly, 0, where="here")  # that process loads this module
    monkeypatch.setattr(processes, "PATIENCE", 2.5)
    assert call_isolated(work_slowly, 4, where="here") == 4


def work_slowly(seconds: int) -> int:
    import time

    for _ in range(seconds):
        time.sleep(1.05)
        processes.report_progress()
    return seconds


def test_one_process_serves_all_files_and_gives_what_it_read_write_protected(tmp_path: Path) -> None:
    worker = process_of()
    first = read(written(tmp_path, CUP))
    assert process_of() == worker != os.getpid()
    assert not any(geom.shape.vertices.flags.writeable for geom in first.geoms)
    assert "pxr" not in {name.partition(".")[0] for name in modules_after_reading(tmp_path / "a.usda")}


def modules_after_reading(path: Path) -> list[str]:
    """What a script without a main guard has loaded after it read a file, which it does once."""
    script = path.with_name("script.py")
    script.write_text(
        f"import sys\nfrom meshforge.formats import read\nprint('begins')\nread({str(path)!r})\nprint(*sys.modules)\n"
    )
    done = subprocess.run([sys.executable, script], capture_output=True, text=True, check=True, timeout=120)
    begins, modules = done.stdout.splitlines()
    assert begins == "begins" and not done.stderr
    return modules.split()


def refuse(word: str) -> None:
    raise UsageError(word, where="there", remedy="Say another.")


def test_errors_come_back_whole_and_the_process_stays() -> None:
    worker = process_of()
    with pytest.raises(UsageError) as caught:
        call_isolated(refuse, "no", where="here")
    assert (caught.value.problem, caught.value.where, caught.value.remedy) == ("no", "there", "Say another.")
    assert process_of() == worker


def read_hulls(path: Path) -> tuple[int, bool]:
    """How many hulls a file has, and whether this process reads it."""
    return len(read(path).geoms), process_of() == os.getpid()


def test_a_worker_of_a_batch_reads_by_itself_and_loses_one_asset(tmp_path: Path) -> None:
    cup, path = written(tmp_path, CUP), HOSTILE
    first, lost, last = run_isolated(read_hulls, [cup, path, cup], ExecutionOptions(1))
    assert first == last == (4, True)
    assert isinstance(lost, WorkerFailure) and lost.why.startswith("its worker process died (SIG")


def test_relative_paths_are_those_of_the_folder_of_the_call(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("one", "two"):
        (tmp_path / name).mkdir()
        written(tmp_path / name, CUP if name == "two" else (ROOT / "usd/cube.usda").read_text())
        monkeypatch.chdir(tmp_path / name)
        assert len(read("a.usda").geoms) == (4 if name == "two" else 1)


def test_without_the_library_the_message_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    from meshforge.formats.usd.stage import usd

    for name in [name for name in sys.modules if name == "pxr" or name.startswith("pxr.")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "pxr", None)
    with pytest.raises(AssetError, match=r"pip install 'meshforge\[usd\]'"), usd("a.usda"):
        pass
