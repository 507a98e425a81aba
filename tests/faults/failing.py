"""A disk that is full or read-only, and an input that goes away while a batch runs."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from pathlib import Path
from random import Random

from tests.faults.runs import begun, ended, is_part_of, outputs, stool_family, wait_for

_STOOLS = 60
_ALONE = ("unshare", "--user", "--map-root-user", "--mount")
_PAGE = 4096


class _Disk:
    """A batch onto a small disk of its own, in a namespace in which an ordinary user may mount one."""

    def __init__(self, folder: Path) -> None:
        stool_family(folder, _STOOLS)
        self._folder = folder
        assert ended(begun(["apply", "p.mf", "assets", "--out", "whole"], folder))[0] == 0
        (folder / "out").mkdir()

    def _run(self, options: str) -> str:
        command = [*_ALONE, sys.executable, "-m", "tests.faults.failing", str(self._folder), options]
        done = subprocess.run(command, capture_output=True, text=True, timeout=300, check=False)
        assert done.returncode == 0, done.stdout + done.stderr
        return str(json.loads(done.stdout.splitlines()[-1]))


class Full(_Disk):
    """Outputs that are there are whole, the message names the file, and with more room the same command completes."""

    title = "`apply` onto a disk that fills up"

    def trial(self, draw: Random) -> str:
        return self._run(f"size={draw.randrange(8, 90) * _PAGE}")


class ReadOnly(_Disk):
    """One message; when the disk can be written to, the same command completes."""

    title = "`apply` onto a disk that turns read-only"

    def trial(self, draw: Random) -> str:
        return self._run(f"size={64 << 20},outputs={draw.randrange(_STOOLS)}")


class Vanishing:
    """The assets that are gone fail, each by name, all others are done; back again, the same command completes."""

    title = "`apply` while inputs go away"

    def __init__(self, folder: Path) -> None:
        stool_family(folder, _STOOLS)
        self._folder = folder
        assert ended(begun(["apply", "p.mf", "assets", "--out", "whole"], folder))[0] == 0
        self._whole = outputs(folder / "whole")

    def trial(self, draw: Random) -> str:
        out = self._folder / "out"
        shutil.rmtree(out, ignore_errors=True)
        words = ["apply", "p.mf", "assets", "--out", "out", "--json"]
        process = begun(words, self._folder)
        wait_for(process, out, draw.randrange(_STOOLS))
        gone = draw.sample(sorted((self._folder / "assets").rglob("*.obj")), 5)
        kept = {path: path.read_bytes() for path in gone}
        for path in gone:
            path.unlink()
        code, said = ended(process)
        rows = [json.loads(line) for line in said.splitlines() if line.startswith("{")]
        failed = {row["asset"] for row in rows if row["status"] == "failed"}
        names = {path.relative_to(self._folder / "assets").as_posix() for path in gone}
        assert failed <= {name.removeprefix("0000/") for name in names} | names, failed
        assert code in (0, 1) and (code == 1) == bool(failed)
        assert is_part_of(outputs(out), self._whole), "a file is neither whole nor missing"
        for path, data in kept.items():
            path.write_bytes(data)
        assert ended(begun(words, self._folder))[0] == 0
        assert outputs(out) == self._whole, "the second run leaves something else"
        return f"{len(failed)} failed"


def _within(folder: Path, options: dict[str, str]) -> str:
    """One trial, in the namespace. Gives what happened."""
    out, whole = folder / "out", outputs(folder / "whole")
    words = ["apply", "p.mf", "assets", "--out", "out"]
    mount = ["mount", "-t", "tmpfs", "-o", f"size={options['size']}", "tmpfs", str(out)]
    subprocess.run(mount, check=True)
    process = begun(words, folder)
    if "outputs" in options:
        wait_for(process, out, int(options["outputs"]))
        # a second view of the disk: files that are open do not mind, but for those that were opened in it meanwhile
        subprocess.run(["mount", "-o", "bind", str(out), str(out)], check=True)
        turned = ["mount", "-o", "remount,bind,ro", str(out), str(out)]
        while subprocess.run(turned, capture_output=True, check=False).returncode:
            assert process.poll() is None, "it cannot be turned read-only"
    code, said = ended(process)
    left = outputs(out)
    assert is_part_of(left, whole), "a file is neither whole nor missing"
    assert code == 0 or "No space left" in said or "Read-only" in said, said
    if "outputs" in options:
        subprocess.run(["umount", str(out)], check=True)
    subprocess.run(["mount", "-o", f"remount,size={64 << 20}", str(out)], check=True)
    code_then, said_then = ended(begun(words, folder))
    assert code_then == 0, said_then
    assert outputs(out) == whole, "the second run leaves something else"
    return "it was done" if code == 0 else "in the midst" if left else "before the first output"


FAILING = (Full, ReadOnly, Vanishing)

if __name__ == "__main__":
    print(json.dumps(_within(Path(sys.argv[1]), dict(o.split("=") for o in sys.argv[2].split(",")))))
