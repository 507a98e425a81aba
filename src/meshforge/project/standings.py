"""How each asset stands: whether it is signed off, and how sure its edit is, by what the last review found."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from meshforge.batch import OutputInputs
from meshforge.project.status import AssetStatus, SignOffState
from meshforge.store import AssessmentFile, ConfidenceLine, Feedback, SignOff, find_changes


@dataclass(frozen=True, eq=False, slots=True)
class Standings:
    """What is kept of a review. inputs: of the edits as they are now, of assets that can be read; said: by
    people; signed: what is signed off, by asset; last: what the last review found, None where something changed since.
    """

    inputs: Mapping[str, OutputInputs]
    said: Feedback
    signed: Mapping[str, SignOff]
    last: AssessmentFile | None

    def add_to(self, asset: AssetStatus) -> AssetStatus:
        """An asset with how it stands."""
        line = self.last.assets.get(asset.id) if self.last else None
        sign_off, now = self.signed.get(asset.id), self.inputs.get(asset.id)
        void = _find_void(sign_off, now, bool(asset.spans))
        found = line.to_confidence(asset.id) if line else None
        state, accepted = self._find_state(asset, line, sign_off, void), asset.review == "accepted" and not asset.stale
        by = "person" if accepted or not sign_off else sign_off.by
        excluded = self.said.exclusions.get(asset.id)
        return replace(
            asset,
            sign_off=state,
            signed_by=by if state == "signed off" else None,
            void=void,
            excluded=excluded.reason if excluded else None,
            probability=found.probability if found else None,
            doubts=found.doubts if found else (),
        )

    def _find_state(
        self, asset: AssetStatus, line: ConfidenceLine | None, sign_off: SignOff | None, void: tuple[str, ...]
    ) -> SignOffState:
        if asset.id in self.said.exclusions:
            return "excluded"
        if asset.id in self.last.wrong if self.last else asset.review == "wrong" and not self._is_corrected(asset.id):
            return "held"
        if asset.review == "accepted" and not asset.stale:
            return "signed off"
        if sign_off:
            return "void" if void else "signed off"
        if not line or not self.last:
            return "unknown"
        return "sure" if line.passes(self.last.bar) else "held"

    def _is_corrected(self, asset: str) -> bool:
        verdict = self.said.verdict_on(asset)
        return bool(verdict and verdict.meant)


def _find_void(sign_off: SignOff | None, now: OutputInputs | None, spans: bool) -> tuple[str, ...]:
    """What changed of all that a sign-off rests on. spans: whether hulls of the asset likely span parts; the tool signs
    no such asset off, so that they were found since."""
    if not sign_off:
        return ()
    known = ("what is known of its hulls",) if spans and sign_off.by == "tool" else ()
    return (*find_changes(now, sign_off.rests_on), *known) if now else ("asset",)
