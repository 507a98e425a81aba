"""A task as its folder tells it."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache, cached_property, lru_cache
from pathlib import Path
from typing import Any

from benchmark.assets import CATEGORIES, SEPARATE, Sample, samples
from benchmark.assets.pictures import upright
from benchmark.criteria import Case, judge
from meshforge.common import MeshForgeError
from meshforge.formats import read
from meshforge.language import Program, RuleTrace, Template, labels_of
from meshforge.symbolic import Label, SymbolicMesh

TASKS = Path(__file__).resolve().parent
DIFFICULTIES = ("easy", "medium", "hard")
PURE = 0.9
"""From this purity on a hull counts as being of one part."""
_TOUCHED = 0.02  # share of a hull in parts of a label from which on the hull is the label's business


@dataclass(frozen=True, eq=False)
class EditResult:
    """What a program makes of a mesh; mesh: None where it fails, error: why; named: made hulls that it labelled."""

    mesh: SymbolicMesh | None
    trace: tuple[RuleTrace, ...] = ()
    named: frozenset[str] = frozenset()
    error: str | None = None


@dataclass(frozen=True, eq=False)
class Task:
    """One task.

    says: what a person wants, in a sentence; motifs: of the design page; rare: the kind on which a simpler reading
    goes wrong, None where there is none; wrong: a deliberately wrong program, which the criterion must refuse;
    criterion: its checks, all of which must hold; equivalents: mutants of the program that do the same job, and why.
    """

    name: str
    category: str
    difficulty: str
    says: str
    motifs: tuple[str, ...]
    rare: str | None
    program: Program
    wrong: Program
    criterion: tuple[Mapping[str, Any], ...]
    templates: Mapping[str, Template] = field(repr=False)
    equivalents: Mapping[str, str] = field(default_factory=dict)

    def samples(self, calibration: bool = False, settings: Sequence[str] = SEPARATE) -> tuple[Sample, ...]:
        """The meshes that the task is about, asset by asset."""
        return samples(self.category, calibration, settings)

    @cached_property
    def labels(self) -> frozenset[str]:
        """The labels that the rules name."""
        return frozenset(label for rule in self.program.rules for label in labels_of(rule.extractor))

    def impure(self, sample: Sample) -> list[str]:
        """The hulls that the decomposition made of several parts, where one of these is the rules' business."""
        mixed = zip(sample.mesh.hulls, sample.shares, strict=True)
        return [
            hull.name
            for hull, share in mixed
            if max(share.values()) < PURE and sum(share.get(label, 0.0) for label in self.labels) > _TOUCHED
        ]

    def run(self, program: Program, mesh: SymbolicMesh) -> EditResult:
        """A program's edit of a mesh."""
        try:
            result = program.run(mesh, self.templates)
        except MeshForgeError as error:
            return EditResult(None, error=str(error))
        rules = zip(program.rules, result.trace, strict=True)
        named = frozenset(name for rule, line in rules if rule.label for name in line.made)
        return EditResult(result.mesh, result.trace, named)

    def select(self, program: Program, mesh: SymbolicMesh) -> tuple[frozenset[str], ...] | None:
        """What each rule selects on a mesh, None where the program fails."""
        edited = self.run(program, mesh)
        return None if edited.mesh is None else tuple(frozenset(line.selected) for line in edited.trace)

    def failure(self, sample: Sample, edited: EditResult) -> str | None:
        """Why an edit of a sample does not do, judged by the criterion; None where it does."""
        return self.judge(sample, edited, self.criterion)

    def judge(self, sample: Sample, edited: EditResult, checks: Sequence[Mapping[str, Any]]) -> str | None:
        """Why an edit of a sample does not do, by some checks; None where it does."""
        if edited.mesh is None:
            return edited.error or "the program fails"
        truth = {hull.name: hull.annotation for hull in sample.mesh.hulls}
        mesh = upright(sample, _truly_labelled(edited, truth))
        return judge(Case(mesh, sample.asset, _before(sample)), checks)


@lru_cache(maxsize=128)
def _before(sample: Sample) -> SymbolicMesh:
    """The unedited mesh, upright; the same one each time, so that what is found out about it is kept."""
    return upright(sample)


def _truly_labelled(edited: EditResult, truth: Mapping[str, Label | None]) -> SymbolicMesh:
    """Hulls with their true labels; made ones with that of the hull they are named after, or what the program says."""
    assert edited.mesh
    names = [hull.name for hull in edited.mesh.hulls if hull.name not in edited.named]
    return edited.mesh.with_labels({name: truth.get(name.split("~")[0]) for name in names})


@cache
def task(name: str) -> Task:
    """The task of that name: its folder's."""
    return read_task(TASKS / name, name)


def read_task(folder: Path, name: str) -> Task:
    """The task of a folder."""
    data = tomllib.loads((folder / "task.toml").read_text("utf-8"))
    files = sorted((folder / "templates").glob("*.obj"))
    templates = {file.name: Template(tuple(geom.shape for geom in read(file).geoms), file.name) for file in files}
    return Task(
        name,
        data["category"],
        data["difficulty"],
        data["says"],
        tuple(data["motifs"]),
        data.get("rare"),
        Program.parse(data["program"]),
        Program.parse(data["wrong"]),
        tuple(data["criterion"]),
        templates,
        data.get("equivalents", {}),
    )


def tasks() -> list[Task]:
    """All tasks, category by category, the easy ones first."""
    names = [f"{category}-{difficulty}" for category in CATEGORIES for difficulty in DIFFICULTIES]
    return [task(name) for name in names if (TASKS / name / "task.toml").is_file()]
