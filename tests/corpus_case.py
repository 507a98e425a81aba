"""The odd and broken inputs that `tests/corpus` keeps, and what the command line says about each.

`tests/corpus/KIND/NAME.suffix` lies beside `NAME.out`, what the command prints about it, or `NAME.err`, the message
with which it refuses it. KIND is the kind of file; `COMMANDS` has the words for those that are no assets.
"""

from __future__ import annotations

import io
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import chdir, redirect_stderr, redirect_stdout
from dataclasses import asdict, dataclass
from functools import cache
from pathlib import Path

from meshforge.cli import main

ROOT = Path(__file__).parent / "corpus"
BOMB = "bomb_"
"""Files of this prefix would take all memory or time of a careless reader."""
_PARTS = ("parts", "goldens.txt", "README.md")
_GOLDENS = (".out", ".err")
_MEMORY = 1 << 30  # bytes of addresses beyond those that the program has when it starts
_UNSTEADY = (
    (r"(?<=Opaque) \(.*\)(?=:)", ""),
    (r"\nBoxes and contacts are .*", ""),
    (r"(\.\./)+", "../"),
    (r"\b\d+\.\d\d s\b", "TIME"),
    (r"(?<=the process that read it died) \(\w+\)", ""),
)
"""Advice that stands under every output, ways up that depend on where folders are, times, and how processes died."""
_SECONDS = 120  # for all bombs together


@dataclass(frozen=True)
class Told:
    code: int
    out: str
    err: str

    @property
    def golden(self) -> tuple[str, str]:
        """The suffix and the text of the file that keeps it."""
        return (".err", self.err) if self.code else (".out", self.out + self.err)


@dataclass(frozen=True)
class Case:
    """One input: the file or folder, in a folder named after its kind."""

    path: Path

    @property
    def kind(self) -> str:
        return self.path.parent.name

    @property
    def name(self) -> str:
        return f"{self.kind}/{self.path.name}"

    @property
    def is_bomb(self) -> bool:
        return self.path.name.startswith(BOMB)

    def golden(self, suffix: str) -> Path:
        """Where its expectation is kept, which differs from file to file even where only the suffix of these does."""
        return self.path.with_name(self.path.name + suffix)

    @property
    def expected(self) -> tuple[str, str] | None:
        """The suffix and the text of its expectation, None where there is none yet."""
        found = [(s, self.golden(s).read_text(encoding="utf-8")) for s in _GOLDENS if self.golden(s).exists()]
        assert len(found) < 2, f"{self.name} has two expectations"
        return found[0] if found else None


def cases() -> list[Case]:
    """All inputs, in the order of their names; `parts` holds what several inputs refer to."""
    found = (path for kind in ROOT.iterdir() if kind.is_dir() for path in kind.iterdir())
    return [Case(path) for path in sorted(found) if path.name not in _PARTS and path.suffix not in _GOLDENS]


def words_for(case: Case, scratch: Path) -> list[str]:
    """The words of the command line that reads an input, in the folder of its kind."""
    name = case.path.name
    match case.kind:
        case "labels":
            return ["info", "parts/cube.obj", "--labels", name]
        case "program":
            return ["fmt", name]
        case "template":
            program = scratch / "program.mf"
            program.write_text(f'All => Replace("{case.path.as_posix()}")\n', encoding="utf-8")
            return ["apply", str(program), "parts/cube.obj", "--out", str(scratch / "out"), "--workers", "1"]
        case "settings" | "demonstrations":
            return ["synthesize", str(_project(case, scratch))]
        case _:
            return ["info", name]


def _project(case: Case, scratch: Path) -> Path:
    """A project with one cube, into which the input is put."""
    project = scratch / "project"
    shutil.copytree(case.path.parent / "parts", project)
    (project / "demonstrations").mkdir(exist_ok=True)
    place = "meshforge.toml" if case.kind == "settings" else "demonstrations/cube.obj.json"
    shutil.copy(case.path, project / place)
    return project


def told(case: Case) -> Told:
    """What `meshforge` says about an input, run as if from its folder: in this process, bombs in one of their own."""
    return _of_bombs()[case.name] if case.is_bomb else _told(case)


def _told(case: Case) -> Told:
    with tempfile.TemporaryDirectory() as scratch, chdir(case.path.parent):
        done = run_main(words_for(case, Path(scratch)))
        places = {scratch: "SCRATCH", str(case.path.parent): "HERE", str(ROOT): "CORPUS"}
    return Told(done.code, _without(done.out, places), _without(done.err, places))


@cache
def _of_bombs() -> dict[str, Told]:
    """What is said about all bombs, in a process that ends when it takes too much memory or time."""
    words = [sys.executable, "-m", "tests.corpus_case"]
    done = subprocess.run(words, cwd=ROOT.parents[1], capture_output=True, text=True, timeout=_SECONDS, check=True)
    return {name: Told(**fields) for name, fields in json.loads(done.stdout).items()}


def _tell_bombs() -> None:
    """Print what is said about all bombs as JSON, within bounds of memory."""
    import resource

    now = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (now + _MEMORY, now + _MEMORY))
    print(json.dumps({case.name: asdict(_told(case)) for case in cases() if case.is_bomb}))


def _without(text: str, places: dict[str, str]) -> str:
    """A text with names for this machine's folders, without ways up, times, and advice."""
    for place, word in places.items():
        text = text.replace(place, word)
    for pattern, word in _UNSTEADY:
        text = re.sub(pattern, word, text)
    lines = [line.rstrip() for line in text.splitlines()]
    return "\n".join(lines).strip("\n") + "\n" if any(lines) else ""


def run_main(words: list[str]) -> Told:
    """What the command prints in this process, in UTF-8 as a terminal has it."""
    out, err, before = _terminal(), _terminal(), sys.argv
    sys.argv = ["meshforge", *words]
    try:
        with redirect_stdout(out), redirect_stderr(err):
            main()
        code = 0
    except SystemExit as end:
        code = end.code if isinstance(end.code, int) else 0 if end.code is None else 1
    finally:
        sys.argv = before
    return Told(code, _shown(out), _shown(err))


def _terminal() -> io.TextIOWrapper:
    return io.TextIOWrapper(io.BytesIO(), encoding="utf-8", write_through=True)


def _shown(stream: io.TextIOWrapper) -> str:
    buffer = stream.buffer
    assert isinstance(buffer, io.BytesIO)
    return buffer.getvalue().decode()


def files_below(folder: Path) -> Iterator[tuple[str, int, int]]:
    """Every file below a folder with its size and time of change, so that a change of any is noticed."""
    for place, _, names in sorted(os.walk(folder)):
        for name in sorted(names):
            state = (Path(place) / name).lstat()
            yield str(Path(place, name)), state.st_size, state.st_mtime_ns


if __name__ == "__main__":
    _tell_bombs()
