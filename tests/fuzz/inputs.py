"""A damaged input for a seed, and what is made of it."""

from __future__ import annotations

import os
import random
import resource
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

from meshforge.errors import MeshForgeError
from meshforge.language import Program
from tests.corpus_case import ROOT
from tests.damage import damaged
from tests.laws.test_readers_never_crash import DAE, WHOLE, told_or_read
from tests.rearranging import rearranged

PROGRAMS = tuple(sorted(p.relative_to(ROOT).as_posix() for p in (ROOT / "program").glob("*.mf")))
KINDS = {**WHOLE, "dae": DAE, "program": PROGRAMS}


@dataclass(frozen=True)
class Tried:
    """wrong: of some seeds, what happened; slowest: seconds of an input, and its seed; peak: of the process [bytes]."""

    count: int
    refused: int
    wrong: tuple[tuple[int, str], ...]
    slowest: tuple[float, int]
    peak: int


def changed(kind: str, seed: int) -> tuple[str, bytes]:
    """The name of a whole input, and its bytes after some damage, to its bytes or its structure or both."""
    rng = random.Random(f"{kind} {seed}")
    name = rng.choice(KINDS[kind])
    data = (ROOT / name).read_bytes()
    how = rng.randrange(5)
    if how < 3:
        data = rearranged(data, rng)
    return name, damaged(data, rng) if how > 1 else data


def tried(work: tuple[str, int, int]) -> Tried:
    """All inputs of a kind, from one seed to before another."""
    kind, first, last = work
    wrong, refused, slowest = [], 0, (0.0, first)
    for seed in range(first, last):
        began = time.perf_counter()
        try:
            refused += not one(kind, seed)
        except Exception as error:
            wrong.append((seed, f"{type(error).__name__}: {error}"[:300]))
        slowest = max(slowest, (time.perf_counter() - began, seed))
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
    return Tried(last - first, refused, tuple(wrong), slowest, peak)


def one(kind: str, seed: int) -> bool:
    """Whether a damaged input is read; a refusal is one error of the family."""
    name, data = changed(kind, seed)
    if kind == "program":
        try:
            program = Program.parse(data.decode("utf-8", "surrogateescape"))
        except MeshForgeError:
            return False
        assert Program.parse(str(program)) == program
        return True
    with tempfile.TemporaryDirectory(dir=os.environ.get("FUZZ_FOLDER")) as folder:
        path = Path(folder, Path(name).name)
        path.write_bytes(data)
        parts = (ROOT / name).parent / "parts"
        if parts.is_dir():
            Path(folder, "parts").symlink_to(parts)
        if kind == "dae":
            link = f'<link name="a"><collision><geometry><mesh filename="{path.name}"/></geometry></collision></link>'
            path = Path(folder, "a.urdf")
            path.write_text(f'<robot name="r">{link}</robot>')
        return told_or_read(path)
