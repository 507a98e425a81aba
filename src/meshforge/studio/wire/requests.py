"""What the page asks for, besides edits and jobs, and the short answers."""

from __future__ import annotations

from meshforge.studio.wire import Wire
from meshforge.studio.wire.jobs import Model


class PreviewRequest(Wire):
    """What would an action do? steps: how many of the asset's own steps go before it; result: of the program's output
    in place of steps, for edits by hand."""

    asset: str
    steps: int = 0
    select: tuple[str, ...]
    action: str
    result: bool = False


class SelectRequest(Wire):
    """What does an extractor select on an asset, after so many of its steps, or as a rule of the program meets it?"""

    asset: str
    steps: int = 0
    rule: int | None = None
    extractor: str


class GeneraliseRequest(Wire):
    """What does an extractor select on all assets, as a rule of that number meets them?"""

    extractor: str
    rule: int = 1


class CheckRequest(Wire):
    """Is this text a program?"""

    text: str


class JobCancel(Wire):
    """Stop a job."""

    id: str


class Uploaded(Wire):
    """A template that was taken: the name that actions write; or the paths of asset files that were taken."""

    names: tuple[str, ...]


class Done(Wire):
    """An edit that is on disk; said: what was done, in words. nothing: there was nothing to do."""

    said: str
    nothing: bool = False


class LabelSources(Wire):
    """Where labels could come from. files: assets whose labels file says something that is not taken yet; names: hulls
    without a label whose names say one; model: what can be asked, null where none is named."""

    files: int
    names: int
    model: Model | None
