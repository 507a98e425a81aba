"""How each asset stands: whether it is signed off, and how sure its edit is, by what the last review found."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from meshforge.common import format_share
from meshforge.project.status import AssetStatus, SignOffState
from meshforge.signoff import ExclusionReason
from meshforge.store import AssessmentFile, ConfidenceLine, Feedback, SignOff, SignOffBasis


@dataclass(frozen=True, eq=False, slots=True)
class Standings:
    """What is kept of a review. bases: what sign-offs would rest on now, of assets that can be edited; lacks: what is
    not there of the others; feedback: of people; exclusions: why assets are excluded; signed: what is signed off;
    last: what the last review found, None where something changed since.
    """

    bases: Mapping[str, SignOffBasis]
    lacks: str
    feedback: Feedback
    exclusions: Mapping[str, ExclusionReason]
    signed: Mapping[str, SignOff]
    last: AssessmentFile | None

    def add_to(self, asset: AssetStatus) -> AssetStatus:
        """An asset with how it stands."""
        line = self.last.assets.get(asset.id) if self.last else None
        sign_off = self.signed.get(asset.id)
        void = self._find_void(asset, sign_off)
        state = self._find_state(asset, line, bool(sign_off), bool(void))
        by = sign_off.by if sign_off and not _is_accepted(asset) else "person"
        found = line.to_confidence(asset.id) if line else None
        return replace(
            asset,
            sign_off=state,
            signed_by=by if state == "signed off" else None,
            void=void if state == "void" else (),
            found_since=self._find_news(line) if state == "signed off" else (),
            excluded=self.exclusions.get(asset.id),
            probability=found.probability if found else None,
            doubts=found.doubts if found else (),
        )

    def _find_void(self, asset: AssetStatus, sign_off: SignOff | None) -> tuple[str, ...]:
        """What changed of all that a sign-off rests on, or, where there is none, since a person accepted the result."""
        if _is_accepted(asset) or (not sign_off and asset.review == "accepted"):
            return _list_changes(asset)
        now = self.bases.get(asset.id)
        return () if not sign_off else now.changes(sign_off.rests_on) if now else (self.lacks,)

    def _find_state(
        self, asset: AssetStatus, line: ConfidenceLine | None, is_signed: bool, is_void: bool
    ) -> SignOffState:
        if asset.id in self.exclusions:
            return "excluded"
        verdict = self.feedback.verdict_on(asset.id)
        is_wrong = asset.review == "wrong" and not (verdict and verdict.meant)
        if asset.id in self.last.wrong if self.last else is_wrong:
            return "held"
        if is_signed or asset.review == "accepted":
            return "void" if is_void else "signed off"
        if not line or not self.last:
            return "unknown"
        return "sure" if line.passes(self.last.bar) else "held"

    def _find_news(self, line: ConfidenceLine | None) -> tuple[str, ...]:
        """What was found after an asset was signed off, and no person has answered."""
        if not line or not self.last or line.passes(self.last.bar):
            return ()
        sure = f"it is {format_share(line.probability)} sure now"
        weighty = (one.text for one in line.doubts if one.kind == "alarm" or one.share > 1 - self.last.bar)
        return tuple(weighty) or (line.doubts[0].text if line.doubts else sure,)


def _is_accepted(asset: AssetStatus) -> bool:
    return asset.review == "accepted" and not _list_changes(asset)


def _list_changes(asset: AssetStatus) -> tuple[str, ...]:
    """What changed since the output was made, but for the version of this software."""
    return tuple(one for one in asset.stale if one != "software")
