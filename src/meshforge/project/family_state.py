"""What a project knows of its family, as a review sees it: meshes, demonstrations, answers, and what a person said of
results, as far as that counts under the program as it is now; and measures of the results, by which some stand out:
what is not written yet is made in memory for that."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from meshforge.batch import (
    ApplyTask,
    OutputInputs,
    RuleSelection,
    program_digest,
    read_stamp,
    replay_manual_edits,
    selections_of,
    template_digests,
)
from meshforge.common import MeshForgeError
from meshforge.language import Program, Template
from meshforge.project import run
from meshforge.project.demonstrations import actions_of, shows
from meshforge.project.hull_mapping import describe_replaced
from meshforge.project.run import output_digest
from meshforge.project.sign_offs import is_written
from meshforge.signoff import EditMeasures, ReviewState, measure_edit
from meshforge.signoff.question import Selections
from meshforge.store import ConfidenceLine, Feedback, Store, VerdictEvent
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Demonstration, memoize


@dataclass(frozen=True, eq=False, slots=True)
class FamilyStateReader:
    """Reads it from a store.

    meshes: all assets that can be read, by id; lost: why others cannot be; program: the one that is reviewed, None
    where there is none; by_hand: whether a person wrote it, so that demonstrations say nothing about it; inputs: of the
    edits that it makes.
    """

    store: Store
    meshes: Mapping[str, SymbolicMesh]
    lost: Mapping[str, str]
    program: Program | None
    by_hand: bool
    inputs: Mapping[str, OutputInputs]

    def read(self) -> ReviewState:
        """Return all that is known. Raises MeshForgeError for files of the project that cannot be read."""
        store, feedback = self.store, self.store.feedback()
        demos = {
            asset: replace(demo, mesh=self.meshes[asset])
            for asset, demo in store.demonstrations().items()
            if asset in self.meshes
        }
        every = {asset: some for asset, some in feedback.verdicts.items() if asset in self.meshes}
        found = _Verdicts(
            {
                asset: some
                for asset, some in every.items()
                if asset not in demos or _is_wrong_as_shown(demos[asset], some)
            }
        )
        shown = _Verdicts({asset: some for asset, some in every.items() if asset in demos})
        actions = actions_of([demo.steps for demo in demos.values()])
        program = self.program or store.program()
        return ReviewState(
            self.meshes,
            self._read_frame(),
            self._read_templates(self.program),
            demos,
            self.by_hand,
            tuple(line.answer for line in feedback.answers.values() if line.fits(actions)),
            meant=found.list_meant(program),
            failed=found.list_failed(program),
            accepted=frozenset(
                asset for asset, one in _Verdicts(every).list_accepted() if self._stands(asset, one, program)
            ),
            corrected=found.list_corrected(program) | shown.list_corrected(program),
            wrong=found.list_wrong(program),
            edited=frozenset(self.meshes.keys() & store.layout.manual_edits.ids),
            excluded={asset: why for asset, why in store.exclusions().items() if asset in store.every.ids},
            snoozed=frozenset(feedback.snoozed),
            lost=self.lost,
            unconfirmed={} if self.by_hand else {a: tuple(describe_replaced(store, a)) for a in self._shown_ids},
        )

    @property
    def _shown_ids(self) -> Iterator[str]:
        known = self.meshes.keys() | self.lost.keys()
        return (asset for asset in self.store.demonstration_ids() if asset in known)

    def _read_frame(self) -> Program:
        settings, limits = self.store.settings, self.store.settings.thresholds
        seen = {hull.label for mesh in self.meshes.values() for hull in mesh.hulls if hull.label}
        words = settings.vocabulary or tuple(sorted(seen))
        orient = self.program.orient if self.program else self.store.orientation
        return Program(words, orient, (), limits.contact, limits.extremity)

    def _read_templates(self, program: Program | None) -> dict[str, Template]:
        return self.store.templates(program.templates if program else ())

    def _stands(self, asset: str, verdict: VerdictEvent, program: Program | None) -> bool:
        """Whether the output that a person accepted is there, and the program does what it did: selects the same, or
        made that very output."""
        stamp = read_stamp(self.store.layout.edited, asset)
        if verdict.output != output_digest(stamp):
            return False
        if verdict.seen and not verdict.meant:
            if program is None or asset not in self.meshes:
                return False
            return run.run_for_selections(self.store, program, self.meshes[asset]) == verdict.seen
        now = self.inputs.get(asset)
        return now is not None and is_written(stamp, now)


@dataclass(frozen=True, eq=False, slots=True)
class _Verdicts:
    """What people said of results, by asset, in order."""

    by_asset: Mapping[str, Sequence[VerdictEvent]]

    def list_accepted(self) -> Iterator[tuple[str, VerdictEvent]]:
        yield from ((asset, some[-1]) for asset, some in self.by_asset.items() if some[-1].verdict == "accepted")

    def list_meant(self, program: Program | None) -> dict[str, Selections]:
        """What each rule is to select by the last word of a person, where its rules are those of the program."""
        rows = ((asset, some[-1]) for asset, some in self.by_asset.items())
        known = ((asset, one.meant or (one.seen if one.verdict == "accepted" else ())) for asset, one in rows)
        return _fit(known, program)

    def list_failed(self, program: Program | None) -> dict[str, Selections]:
        """What the rules selected on results that were called wrong last."""
        last = ((asset, [one for one in some if one.verdict == "wrong"]) for asset, some in self.by_asset.items())
        return _fit(((asset, some[-1].seen) for asset, some in last if some), program)

    def list_corrected(self, program: Program | None) -> frozenset[str]:
        """The assets of which a person said what rules are to select, and these are rules of the program."""
        return frozenset(_fit(((asset, some[-1].meant) for asset, some in self.by_asset.items()), program))

    def list_wrong(self, program: Program | None) -> frozenset[str]:
        wrong = (asset for asset, some in self.by_asset.items() if some[-1].verdict == "wrong")
        return frozenset(wrong) - self.list_corrected(program)


def _is_wrong_as_shown(demo: Demonstration, verdicts: Sequence[VerdictEvent]) -> bool:
    last = verdicts[-1]
    return last.verdict == "wrong" and not last.meant and shows(demo.steps, last.seen)


def _fit(rows: Iterable[tuple[str, Sequence[RuleSelection]]], program: Program | None) -> dict[str, Selections]:
    if program is None:
        return {}
    fitting = ((asset, selections_of(some, program)) for asset, some in rows)
    return {asset: tuple(found[rule] for rule in sorted(found)) for asset, found in fitting if found}


def measure_results(
    store: Store,
    program: Program,
    meshes: Mapping[str, SymbolicMesh],
    inputs: Mapping[str, OutputInputs],
    stop: Callable[[], bool] | None = None,
) -> dict[str, EditMeasures]:
    """Return the measures of the results of a program, by asset; of some only once `stop` says so.

    meshes: of the family, by id; inputs: of the edits as they are now. What is known of an output, or of the last
    review, is not measured again while it is up to date; an asset on which the program cannot run has no result.
    """
    plan = _Plan.of(store, program)
    found = dict[str, EditMeasures]()
    for asset, mesh in meshes.items():
        if stop and stop():
            break
        try:
            found[asset] = plan.recall(asset, inputs.get(asset)) or plan.measure(asset, mesh)
        except MeshForgeError:
            continue
    return found


@dataclass(frozen=True, eq=False, slots=True)
class _Plan:
    """What `apply` would do to each asset. last: what the last review found, by asset; digest: of the program; key: two
    with the same do the same."""

    store: Store
    task: ApplyTask
    last: Mapping[str, ConfidenceLine]
    digest: str
    key: str
    feedback: Feedback

    @staticmethod
    def of(store: Store, program: Program) -> _Plan:
        task, last = run.build_task(store, program), store.assessment()
        digest = program_digest(program)
        key = f"{digest} {template_digests(task.templates)}"
        return _Plan(store, task, last.assets if last else {}, digest, key, store.feedback())

    def recall(self, asset: str, now: OutputInputs | None) -> EditMeasures | None:
        """The measures of an output or of the last review, None where neither is as this program would make it now."""
        if now is None or now.program != self.digest:
            return None
        stamp, line = read_stamp(self.store.layout.edited, asset), self.last.get(asset)
        if stamp and stamp.measures and is_written(stamp, now):
            return stamp.measures
        return line.measures if line and line.rests_on == now else None

    def measure(self, asset: str, mesh: SymbolicMesh) -> EditMeasures:
        """The measures of an edit with what was done by hand after it; cached with the mesh."""
        manual_edits, meant = self.store.manual_edits(asset), run.find_selections(self.feedback, asset)
        program, templates = self.task.program, self.task.templates

        def make() -> EditMeasures:
            after = program.run(mesh, templates, selections=selections_of(meant, program), memo=memoize).mesh
            return measure_edit(mesh, replay_manual_edits(manual_edits, mesh, after, program, templates)[0])

        return memoize(mesh, ("measures", self.key, *map(str, (*manual_edits, *meant))), EditMeasures, make)
