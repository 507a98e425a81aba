"""A damaged input for a seed, and what is made of it."""

from __future__ import annotations

import io
import os
import random
import resource
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from meshforge.common import MeshForgeError
from meshforge.formats.segmentation import read_segmentation
from meshforge.language import Program
from meshforge.store.program import read_steps
from meshforge.store.settings import read_settings
from meshforge.symbolic import read_labels
from tests.corpus_case import ROOT
from tests.damage import damaged
from tests.laws.test_readers_never_crash import DAE, WHOLE, told_or_read
from tests.rearranging import rearranged

KINDS = {
    **WHOLE,
    "dae": DAE,
    "program": tuple(sorted(p.relative_to(ROOT).as_posix() for p in (ROOT / "program").glob("*.mf"))),
    "labels": ("labels/good.json",),
    "steps": ("demonstrations/good.json",),
    "settings": ("settings/good.toml",),
    "points": ("points/a.npz", "points/a.ply"),
}
"""Whole inputs of each kind: files of the corpus, and segmented points, which are made."""
_OF_PROJECTS: dict[str, Callable[[Path], object]] = {
    "labels": read_labels,
    "steps": read_steps,
    "settings": lambda path: read_settings(path.parent),
    "points": read_segmentation,
}


@dataclass(frozen=True)
class Tried:
    """wrong: of some seeds, what happened; slowest: processor time of an input [s], and its seed; peak: of the process
    [bytes].
    """

    count: int
    refused: int
    wrong: tuple[tuple[int, str], ...]
    slowest: tuple[float, int]
    peak: int


def changed(kind: str, seed: int) -> tuple[str, bytes]:
    """The name of a whole input, and its bytes after some damage, to its bytes or its structure or both."""
    rng = random.Random(f"{kind} {seed}")
    name = rng.choice(KINDS[kind])
    data = _points(Path(name).suffix) if kind == "points" else (ROOT / name).read_bytes()
    how = rng.randrange(5)
    if how < 3:
        data = rearranged(data, rng)
    return name, damaged(data, rng) if how > 1 else data


def tried(work: tuple[str, int, int]) -> Tried:
    """All inputs of a kind, from one seed to before another."""
    kind, first, last = work
    wrong, refused, slowest = [], 0, (0.0, first)
    for seed in range(first, last):
        began = time.process_time()
        try:
            refused += not one(kind, seed)
        except Exception as error:
            wrong.append((seed, f"{type(error).__name__}: {error}"[:300]))
        slowest = max(slowest, (time.process_time() - began, seed))
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
    return Tried(last - first, refused, tuple(wrong), slowest, peak)


def _points(suffix: str) -> bytes:
    """Five points of two classes."""
    points, classes, stream = np.arange(15.0).reshape(5, 3), np.array([0, 1, 0, 1, 1]), io.BytesIO()
    if suffix == ".npz":
        np.savez_compressed(stream, points=points, labels=classes)
    else:
        properties = "".join(f"property float {axis}\n" for axis in "xyz") + "property int label\n"
        rows = "".join(f"{x} {y} {z} {label}\n" for (x, y, z), label in zip(points, classes, strict=True))
        text = f"ply\nformat ascii 1.0\nelement vertex 5\n{properties}end_header\n{rows}"
        stream.write(text.encode())
    return stream.getvalue()


def one(kind: str, seed: int) -> bool:
    """Whether a damaged input is read; a refusal is one error of the family."""
    name, data = changed(kind, seed)
    if kind == "program":
        return _parses(data.decode("utf-8", "surrogateescape"))
    with tempfile.TemporaryDirectory(dir=os.environ.get("FUZZ_FOLDER")) as folder:
        path = Path(folder, "meshforge.toml" if kind == "settings" else Path(name).name)
        path.write_bytes(data)
        if kind in _OF_PROJECTS:
            return _reads(_OF_PROJECTS[kind], path)
        parts = (ROOT / name).parent / "parts"
        if parts.is_dir():
            Path(folder, "parts").symlink_to(parts)
        if kind == "dae":
            link = f'<link name="a"><collision><geometry><mesh filename="{path.name}"/></geometry></collision></link>'
            path = Path(folder, "a.urdf")
            path.write_text(f'<robot name="r">{link}</robot>')
        return told_or_read(path)


def _parses(text: str) -> bool:
    """Whether a text is a program; printed, it is the same one."""
    try:
        program = Program.parse(text)
    except MeshForgeError:
        return False
    assert Program.parse(str(program)) == program
    return True


def _reads(reader: Callable[[Path], object], path: Path) -> bool:
    """Whether a file is read; an error must name it."""
    try:
        reader(path)
    except MeshForgeError as error:
        assert str(path) in error.message
        return False
    return True
