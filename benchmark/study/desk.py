"""A task with its meshes under some labels: what programs select there, and how that compares with the reference."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from hashlib import blake2b

from benchmark.assets import SEPARATE, Sample, family
from benchmark.study.condition import Labels
from benchmark.study.labels import mislabel, noisy
from benchmark.study.lookalikes import LookAlikes
from benchmark.tasks import EditResult, Task, task
from meshforge.language import EXTREMITY, Extractor, Program, Replay, select_mask
from meshforge.signoff import EditMeasures, measure_edit
from meshforge.symbolic import Label, SymbolicMesh, name_class
from meshforge.synthesis import choose_first_demonstration, memoize

Selections = tuple[frozenset[str], ...]
"""What each rule selects on a mesh, by hull names."""


@dataclass(frozen=True)
class Start:
    """What there is of labels before a person labels anything.

    by_hand: the meshes that a person labels before all others, in order; none for those that are advised; parts: the
    labels of parts of hulls that were split, by mesh and hull.
    """

    by_hand: tuple[str, ...] = ()
    parts: Mapping[str, Mapping[str, Label]] = field(default_factory=dict)


class Bench:
    """What all desks of a task share: the true meshes of a family, their contacts known, and what was judged before.

    samples: of different assets; start: of sessions with propagated labels.
    """

    def __init__(self, task: Task, samples: Iterable[Sample], start: Start | None = None) -> None:
        self.task, self.start = task, start or Start()
        self.samples: dict[str, Sample] = {sample.name: sample for sample in samples}
        assert all(sample.mesh.contacts is not None for sample in self.samples.values())
        self._judged: dict[tuple[str, str | None, bytes], str | None] = {}
        self._measured: dict[tuple[str, bytes], EditMeasures] = {}
        self._alike: dict[str, LookAlikes] = {}

    def find_alike(self, name: str) -> Callable[[str], frozenset[str]]:
        """What gives the look-alikes of a hull of a mesh."""
        if name not in self._alike:
            self._alike[name] = LookAlikes(self.samples[name].mesh)
        return self._alike[name].find

    @cached_property
    def pure(self) -> frozenset[str]:
        """The meshes on which no hull that matters is of several parts."""
        return frozenset(name for name, sample in self.samples.items() if not self.task.impure(sample))

    @cached_property
    def truth(self) -> Desk:
        """The desk with true labels."""
        return Desk(self, {name: sample.mesh for name, sample in self.samples.items()})

    def desk(self, labels: Labels, seed: int) -> Desk:
        """The meshes as a demonstrator gets them who labels nothing."""
        if labels == "true":
            return self.truth
        if labels == "systematic":
            meshes = {name: sample.mesh for name, sample in self.samples.items()}
            return Desk(self, mislabel(meshes, (seed, *self.task.category.encode())))
        if labels == "propagated":
            return Desk(self, {name: self._unlabel(name) for name in self.samples})
        rows = enumerate(self.samples.items())
        seeds = {name: (seed, *self.task.category.encode(), k) for k, (name, _) in rows}
        told = labels == "telling"
        return Desk(self, {name: noisy(row.mesh, seeds[name], telling=told) for name, row in self.samples.items()})

    @cached_property
    def classes(self) -> dict[str, dict[str, str]]:
        """The class of each hull of each mesh that the reference edits: by the rules that take it, or what is made of
        it as long as that has no label."""
        program = self.task.program
        return {name: self._class_hulls(name, self.truth.edit(program, name)) for name in self.samples}

    def _class_hulls(self, name: str, edited: EditResult) -> dict[str, str]:
        origins = {hull: {hull} for hull in self.samples[name].mesh.index}
        taken: dict[str, set[int]] = {hull: set() for hull in origins}
        for rule, line in zip(self.task.program.rules, edited.trace, strict=False):
            for hull in {old for one in line.selected for old in origins[one]}:
                taken[hull].add(line.rule)
            for made, sources in zip(line.made, line.sources, strict=True):
                origins[made] = set() if rule.label else {old for one in sources for old in origins[one]}
        return {hull: name_class(rules) for hull, rules in taken.items()}

    def _unlabel(self, name: str) -> SymbolicMesh:
        """A mesh before anybody labels it."""
        mesh = self.samples[name].mesh
        return mesh.with_labels({**dict.fromkeys(mesh.index), **self.start.parts.get(name, {})})

    def failure(self, name: str, edited: EditResult) -> str | None:
        """Why an edit of a mesh does not do; the same edit is judged once.

        The same selections need not make the same edit: labels decide how a mesh is oriented, too.
        """
        key = (name, edited.error, _fingerprint(edited))
        if key not in self._judged:
            self._judged[key] = self.task.failure(self.samples[name], edited)
        return self._judged[key]

    def measure(self, name: str, edited: EditResult) -> EditMeasures | None:
        """What an edit of a mesh did, None where it fails; the same edit is measured once."""
        if edited.mesh is None:
            return None
        key = (name, _fingerprint(edited))
        if key not in self._measured:
            self._measured[key] = measure_edit(self.samples[name].mesh, edited.mesh)
        return self._measured[key]


@dataclass(eq=False)
class Desk:
    """Meshes by name, labelled somehow; edits by programs are remembered."""

    bench: Bench
    meshes: Mapping[str, SymbolicMesh]
    _edits: dict[tuple[str, str], EditResult] = field(default_factory=dict, repr=False)
    _met: dict[tuple[str, int], Replay] = field(default_factory=dict, repr=False)

    def edit(self, program: Program, name: str) -> EditResult:
        """What a program makes of a mesh."""
        key = (str(program), name)
        if key not in self._edits:
            self._edits[key] = self.bench.task.run(program, self.meshes[name])
        return self._edits[key]

    def select(self, program: Program, name: str) -> Selections | None:
        """What each rule of a program selects on a mesh, None where it fails."""
        edited = self.edit(program, name)
        return None if edited.mesh is None else tuple(frozenset(line.selected) for line in edited.trace)

    @cached_property
    def reference(self) -> dict[str, Selections | None]:
        """What the reference selects under these labels."""
        return {name: self.select(self.bench.task.program, name) for name in self.meshes}

    def mesh_before(self, name: str, place: int) -> SymbolicMesh:
        """A mesh as a rule of the reference meets it, after the rules before it; place: from 0."""
        key = (name, place)
        if key not in self._met:
            task = self.bench.task
            frame = task.program
            if not place:
                replay = Replay.begin(self.meshes[name], frame.orient, frame.contact, name=name, memo=memoize)
            else:
                self.mesh_before(name, place - 1)
                before, rule = self._met[name, place - 1], frame.rules[place - 1]
                replay = before.advance(rule, task.templates, frame.extremity)
            self._met[key] = replay
        return self._met[key].mesh

    def propose(self, names: Iterable[str]) -> str | None:
        """The mesh that the tool proposes to demonstrate first."""
        one, some = self.bench.task.program, frozenset(names)
        return choose_first_demonstration(self.meshes, one.labels, one.orient, one.contact, one.extremity, some)

    def behaves(self, extractor: Extractor, place: int, names: Iterable[str]) -> bool:
        """Whether an extractor selects what the reference's rule at a place selects, on all these meshes."""
        right, delta = self.bench.task.program.rules[place].extractor, self.bench.task.program.extremity or EXTREMITY
        meshes = (self.mesh_before(name, place) for name in names)
        return all(select_mask(extractor, mesh, delta) == select_mask(right, mesh, delta) for mesh in meshes)

    def find_differences(self, program: Program | None, names: Iterable[str]) -> list[str]:
        """The meshes on which a program selects something else than the reference."""
        if program is None:
            return list(names)
        return [name for name in names if self.select(program, name) != self.reference[name]]

    def measure_f1(self, program: Program | None, names: Iterable[str]) -> float:
        """F1 of what the rules select, hull by hull, against the reference under true labels, where that runs."""
        hit = chosen = meant = 0
        for name in names:
            wanted = self.bench.truth.reference[name]
            if wanted is None:
                continue
            done = (self.select(program, name) if program else None) or ((frozenset(),) * len(wanted))
            hit += sum(len(a & b) for a, b in zip(done, wanted, strict=True))
            chosen, meant = chosen + sum(map(len, done)), meant + sum(map(len, wanted))
        return 2 * hit / (chosen + meant) if chosen + meant else 1.0

    def share_labels_right(self, names: Iterable[str]) -> float:
        """The share of the labels of some meshes that are right."""
        truth = self.bench.truth
        pairs = [
            (true.label, hull.label)
            for name in names
            for true, hull in zip(truth.meshes[name].hulls, self.meshes[name].hulls, strict=True)
        ]
        return sum(a == b for a, b in pairs) / max(len(pairs), 1)

    def with_labels_of(self, meshes: Mapping[str, SymbolicMesh]) -> Desk:
        """The same with the labels of meshes that have the same hulls; where they stay, the edits are not forgotten."""
        found = {
            name: mesh
            if mesh.labels == (now := meshes[name].labels)
            else mesh.with_labels({**dict.fromkeys(mesh.index), **now})
            for name, mesh in self.meshes.items()
        }
        return self.with_meshes(found)

    def with_meshes(self, meshes: Mapping[str, SymbolicMesh]) -> Desk:
        """The same with some meshes labelled otherwise; edits of the others are not forgotten."""
        kept = {key: done for key, done in self._edits.items() if meshes[key[1]] is self.meshes[key[1]]}
        return Desk(self.bench, meshes, kept)


@lru_cache(maxsize=2 * len(SEPARATE))
def open_bench(name: str, setting: str, calibration: bool = False) -> Bench:
    """A task with the family at one decomposition."""
    one = task(name)
    return Bench(one, family(one.category, setting, calibration))


def _fingerprint(edited: EditResult) -> bytes:
    """Equal where two edits have the same hulls, bit for bit, and called the same the ones that they made."""
    found = blake2b(digest_size=16)
    for hull in edited.mesh.hulls if edited.mesh else ():
        said = hull.label if hull.name in edited.named else None
        found.update(f"{hull.name} {said} {hull.shape.kind} {len(hull.vertices)} ".encode() + hull.vertices.tobytes())
    return found.digest()
