"""What a project knows of its family, as a review sees it: meshes, demonstrations, answers, and what a person said of
results, as far as that counts under the program as it is now.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from meshforge.batch import OutputInputs, Stamp, read_stamp
from meshforge.common import MeshForgeError
from meshforge.language import Program, Template
from meshforge.project.demonstrations import actions_of
from meshforge.project.run import number_selections, output_digest
from meshforge.project.sign_offs import is_written
from meshforge.signoff import ReviewState
from meshforge.signoff.question import Selections
from meshforge.store import Review, Store
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import memoize


@dataclass(frozen=True, eq=False, slots=True)
class FamilyStateReader:
    """Reads it from a store.

    meshes: all assets that can be read, by id; program: the one that is reviewed, None where there is none; by_hand:
    whether a person wrote it, so that demonstrations say nothing about it; inputs: of the edits that it makes.
    """

    store: Store
    meshes: Mapping[str, SymbolicMesh]
    program: Program | None
    by_hand: bool
    inputs: Mapping[str, OutputInputs]

    def read(self) -> ReviewState:
        """All that is known. Raises MeshForgeError for files of the project that cannot be read."""
        store, signed = self.store, self.store.sign_offs()
        demos = {
            asset: replace(demo, mesh=self.meshes[asset])
            for asset, demo in store.demonstrations().items()
            if asset in self.meshes
        }
        accepted, flagged = self._sort_verdicts()
        actions = actions_of(demo.steps for demo in demos.values())
        return ReviewState(
            self.meshes,
            self._read_frame(),
            self._read_templates(self.program),
            {} if self.by_hand else demos,
            tuple(line.answer for line in store.answers().answers if line.fits(actions)),
            {asset: done for asset, done in accepted.items() if asset in self.meshes},
            aside=flagged.union(asset for asset in signed.aside if asset not in demos),
            later=frozenset(store.put_off_ids()),
        )

    def _read_frame(self) -> Program:
        settings, limits = self.store.settings, self.store.settings.thresholds
        seen = {hull.label for mesh in self.meshes.values() for hull in mesh.hulls if hull.label}
        words = settings.vocabulary or tuple(sorted(seen))
        orient = self.program.orient if self.program else self.store.orientation
        return Program(words, orient, (), limits.contact, limits.extremity)

    def _read_templates(self, program: Program | None) -> dict[str, Template]:
        return self.store.templates(program.templates if program else ())

    def _sort_verdicts(self) -> tuple[dict[str, Selections], frozenset[str]]:
        """What the rules select on the results that a person accepted, and the assets that they flagged. Where nothing
        fits what was shown by now, the last program is still the one whose results a person looked at."""
        program = self.program or self.store.program()
        accepted, flagged = dict[str, Selections](), set[str]()
        for asset, review in self.store.reviews().items():
            stamp = read_stamp(self.store.layout.edited, asset)
            if review.output != output_digest(stamp) or not self._counts(asset, review, stamp, program):
                continue
            if review.verdict == "flagged":
                flagged.add(asset)
            else:
                accepted[asset] = tuple(frozenset(one.select) for one in review.seen)
        return accepted, frozenset(flagged)

    def _counts(self, asset: str, review: Review, stamp: Stamp | None, program: Program | None) -> bool:
        """Whether the program does what it did when a person looked: selects the same, or made that very output."""
        if review.seen:
            return self._select(asset, program) == tuple((one.action, one.select) for one in review.seen)
        now = self.inputs.get(asset)
        return now is not None and is_written(stamp, now)

    def _select(self, asset: str, program: Program | None) -> tuple[tuple[str, tuple[str, ...]], ...] | None:
        """What the rules of a program do to which hulls of an asset; None where they cannot."""
        mesh = self.meshes.get(asset)
        if program is None or mesh is None:
            return None
        try:
            trace = program.run(mesh, self._read_templates(program), memo=memoize).trace
        except MeshForgeError:
            return None
        found = number_selections(program, {r.rule: r.selected for r in trace})
        return tuple((one.action, one.select) for one in found)
