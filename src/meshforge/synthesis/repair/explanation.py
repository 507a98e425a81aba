"""What explaining a rule by wrong labels comes to."""

from __future__ import annotations

from dataclasses import dataclass

from meshforge.language import Extractor
from meshforge.synthesis.correction import Correction


@dataclass(frozen=True, slots=True)
class Explanation:
    """An extractor that selects what was shown once labels are corrected.

    corrections: sorted, at least one; beliefs: of each, the probability that it is right; whys: of each, one sentence
    for the user; cost: of extractor and corrections together [nats].
    """

    extractor: Extractor
    corrections: tuple[Correction, ...]
    beliefs: tuple[float, ...]
    whys: tuple[str, ...]
    cost: float
