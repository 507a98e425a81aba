"""What results that people judged say about labels (abduction, as in repair): where a result is as it was meant, labels
that would change it are less probable; where it is not, those that would make it so are more."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import log

import numpy as np

from meshforge.geometry import Floats
from meshforge.label_model import FamilyPosterior
from meshforge.signoff.state import ReviewState
from meshforge.signoff.trial import Flip, Trial
from meshforge.symbolic import mask_of

_WRONG_BY_RIGHT, _WRONG_BY_CORRECTED = 0.08, 0.24
"""Of labels that follow from results that are as meant, and from corrected ones, so many are wrong (measured)."""


def weigh_labels(state: ReviewState, trials: Sequence[Trial], posterior: FamilyPosterior) -> Floats | None:
    """The evidence (hulls of all meshes, labels) [nats] of results on labels, None where there is none.

    trials: of all assets, with their flips; posterior: by all other evidence.
    """
    codes = {label: code for code, label in enumerate(posterior.seen.labels)}
    found, said = np.zeros(posterior.chances.shape), False
    for place, trial in enumerate(trials):
        if trial.asset not in state.meant or trial.error:
            continue
        start, index = posterior.table.spans[place].start, state.meshes[trial.asset].index
        for flip, nats in _weigh_flips(state, trial):
            found[start + index[flip.hull], codes[flip.to]] += nats
            said = True
    return found if said else None


def _weigh_flips(state: ReviewState, trial: Trial) -> Iterator[tuple[Flip, float]]:
    """How much more probable each other label is by what rules are to select on an asset."""
    meant = [
        mask_of(mesh.index[hull] for hull in select if hull in mesh.index)
        for mesh, select in zip(trial.meshes, state.meant[trial.asset], strict=False)
    ]
    for flip in trial.flips:
        pairs = [(meant[rule - 1], now) for rule, now in zip(flip.rules, flip.selections, strict=True) if rule > 0]
        before = sum((trial.selections[rule - 1] ^ meant[rule - 1]).bit_count() for rule in flip.rules if rule > 0)
        after = sum((wanted ^ now).bit_count() for wanted, now in pairs)
        if after < before:
            yield flip, log((1 - _WRONG_BY_CORRECTED) / _WRONG_BY_CORRECTED)
        elif after > before:
            yield flip, -log((1 - _WRONG_BY_RIGHT) / _WRONG_BY_RIGHT)
