"""What became of the labels of an asset between two states of its labels file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from meshforge.studio.wire.labelling import RelabelledAsset
from meshforge.symbolic import GIVEN_SOURCES, Label
from meshforge.views import UNSURE

Labels = Mapping[str, Label]
"""Labels by the names of hulls."""


def relabelled_asset(asset: str, names: Sequence[str], before: Labels, after: Labels) -> RelabelledAsset | None:
    """Which hulls got another label, None where none did; names: of all hulls, in order."""
    pairs = [(k, before.get(name), after.get(name)) for k, name in enumerate(names)]
    new = tuple(k for k, was, now in pairs if now and not was)
    changed = {k: was.name for k, was, now in pairs if was and now and was.name != now.name}
    if not new and not changed:
        return None
    return RelabelledAsset(asset=asset, new=new, changed=tuple(changed), was=tuple(changed.values()))


def settled(before: Labels, after: Labels) -> int:
    """How many labels are sure now and were not."""
    pairs = ((was, after.get(name)) for name, was in before.items())
    return sum(was.confidence < UNSURE <= now.confidence for was, now in pairs if now)


def given_since(before: Labels, now: Labels) -> int:
    """How many labels people and files gave that are not those of before."""
    old, new = _given(before), _given(now)
    return sum(old.get(name) != label for name, label in new.items())


def _given(labels: Labels) -> dict[str, str]:
    return {name: label.name for name, label in labels.items() if label.source in GIVEN_SOURCES}
