"""Cards of the gallery, from how far each asset is."""

from __future__ import annotations

from collections.abc import Sequence

from meshforge.project import AssetStatus
from meshforge.studio.showing.pictures import edited_digest, picture_digest
from meshforge.studio.wire.checks import Fault
from meshforge.studio.wire.family import Card
from meshforge.symbolic import GIVEN_SOURCES
from meshforge.views import UNSURE


def card(
    status: AssetStatus,
    vocabulary: Sequence[str],
    orient: str,
    check: str | None = None,
    faults: tuple[Fault, ...] | None = None,
) -> Card:
    """The card of an asset; orient: the orientation's text, in whose frame it is drawn; the others as of `Card`."""
    places = {label: k for k, label in enumerate(vocabulary)}
    labels = tuple(places.get(label.name, -1) if label else -1 for label in status.labels)
    picture = None if status.hulls is None else picture_digest(status.geometry, status.labels, orient)
    return Card(
        asset=status.id,
        hulls=status.hulls,
        labels=labels,
        unsure=_unsure(status),
        given=sum(label is not None and label.source in GIVEN_SOURCES for label in status.labels),
        demonstrated=status.demonstrated,
        output=status.output,
        after=status.after,
        after_labels=tuple(places.get(label, -1) if label else -1 for label in status.after_labels),
        stale=status.stale,
        error=status.error,
        flags=status.flags,
        review=status.review,
        note=status.review_note,
        corrections=status.corrections,
        sources=status.sources,
        prepared=status.prepared,
        picture=picture,
        edited_picture=edited_digest(picture, status.output_digest) if status.output_digest and picture else None,
        check=check,
        faults=faults,
    )


def _unsure(status: AssetStatus) -> tuple[int, ...]:
    """Positions of hulls with a label that is not sure, or that was given to another geometry."""
    doubtful = set(status.doubtful)
    rows = enumerate(zip(status.names, status.labels, strict=True))
    return tuple(k for k, (name, label) in rows if label and (label.confidence < UNSURE or name in doubtful))
