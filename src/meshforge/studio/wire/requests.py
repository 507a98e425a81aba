"""Requests of the page besides edits and jobs, and the short responses."""

from meshforge.store.history import HistoryAct
from meshforge.studio.wire import Wire
from meshforge.studio.wire.program import ActionCall


class PreviewRequest(Wire):
    """What would an action do? steps: how many of the asset's own steps come before it; result: apply it to what the
    program makes of the asset instead, as an edit by hand."""

    asset: str
    steps: int = 0
    select: tuple[str, ...]
    action: ActionCall
    result: bool = False


class SelectRequest(Wire):
    """What does an extractor select on an asset, after some of its steps, or before a rule of the program?"""

    asset: str
    steps: int = 0
    rule: int | None = None
    extractor: str


class HullOfAsset(Wire):
    """A hull of an asset, both by name."""

    asset: str
    hull: str


class SimilarRequest(Wire):
    """Which hulls look like some? assets: where to look besides the hulls' own assets; null: in these alone; step: from
    0 on, how much they may differ."""

    hulls: tuple[HullOfAsset, ...]
    assets: tuple[str, ...] | None = None
    step: int = 0


class HullsOfAsset(Wire):
    """Some hulls of an asset, by name, and their positions in it."""

    asset: str
    hulls: tuple[str, ...]
    positions: tuple[int, ...]


class SimilarView(Wire):
    """Hulls that look like those of the request, these included. step: the one that was taken; more: whether another
    step may take more; unread: assets that could not be looked in; passed_over: how many more there are."""

    found: tuple[HullsOfAsset, ...]
    step: int
    more: bool
    unread: tuple[str, ...]
    passed_over: int


class UploadReceipt(Wire):
    """An upload is stored. names: the paths of asset files; problems: why other assets were left out."""

    names: tuple[str, ...]
    problems: tuple[str, ...] = ()


class EditReceipt(Wire):
    """An edit is on disk. message: what was done, in words; nothing: whether there was nothing to do."""

    message: str
    nothing: bool = False


class HistoryView(Wire):
    """What was done last and can be undone, and what was undone and can be redone, the first one first."""

    acts: tuple[HistoryAct, ...]


class LabelSources(Wire):
    """Where labels could come from. files: how many assets have a labels file with new labels; names: how many hulls
    without a label have one in their name."""

    files: int
    names: int
