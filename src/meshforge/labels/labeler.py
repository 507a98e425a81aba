"""A source of labels: it sees a family of assets and proposes labels for their hulls."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Generator, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass, field

from meshforge.batch import ExecutionOptions
from meshforge.common import ProjectError, quote_path
from meshforge.labels.merge import can_replace_less_certain
from meshforge.store import AssetFacts, Store, iterate_asset_index
from meshforge.symbolic import Label

LabelReason = tuple[str, str]
"""Why a hull gets its label, or none: the kind of what says so (`hull`, `body by pattern`, `points`), and its name."""
NO_REASON = "nothing said"
"""The kind of reason where nothing says what a hull is."""


Stage = Callable[[int, str], AbstractContextManager[Callable[[], None]]]
"""Given how many assets a part of the work is about and what it is called, what is entered meanwhile: that gives the
function that counts one more."""

WriteBlock = Callable[[str | None], AbstractContextManager[object]]
"""The block in which labels are written, when all is known; given the asset that would help most."""


@contextmanager
def ignore_stage(total: int, what: str) -> Iterator[Callable[[], None]]:
    """Give a stage that reports nothing."""
    yield lambda: None


@dataclass(frozen=True, slots=True)
class AssetLabels:
    """The labels that are proposed for the hulls of one asset.

    hulls: digests by name, in order; given: the label by hull, None to remove the one it has; reasons: by hull;
    problems: a sentence for each label that was left out; error: why there are no labels for this asset; open: why
    hulls have none, by hull, where that is known.
    """

    asset: str
    hulls: Mapping[str, str] = field(default_factory=dict)
    given: Mapping[str, Label | None] = field(default_factory=dict)
    reasons: Mapping[str, LabelReason] = field(default_factory=dict)
    problems: Sequence[str] = ()
    error: str | None = None
    open: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class LabelProposal:
    """The labels that a labeler proposes.

    assets: computed while they are iterated; next: the asset that would help most if it were labelled; alike: pairs of
    labels that may be two names of one part; vocabulary: that of the labels, for a project that has none; notes:
    what else the user is to know, a sentence each.
    """

    assets: Generator[AssetLabels, None, None]
    next: str | None = None
    alike: tuple[tuple[str, str], ...] = ()
    vocabulary: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class LabelFamily:
    """What a labeler sees: the project's files, the vocabulary that counts, and how the work is done."""

    store: Store
    vocabulary: tuple[str, ...]
    execution: ExecutionOptions
    stage: Stage

    def require_vocabulary(self) -> tuple[str, ...]:
        """Return the vocabulary. Raises ProjectError where it is empty."""
        if not self.vocabulary:
            remedy = "Say first what hulls can be: --vocabulary a,b,c."
            word = quote_path(self.store.folder)
            if classes := self.store.words:
                remedy += f" Or name the hulls that a step takes: meshforge label {word} --rename {classes[0]}=NAME"
            elif self.store.demonstration_ids():
                remedy += f" Or learn without names from what was shown: meshforge synthesize {word}"
            raise ProjectError("the vocabulary is empty", where=str(self.store.folder), remedy=remedy)
        return self.vocabulary

    def iterate_facts(self) -> Iterator[tuple[str, AssetFacts]]:
        """Return names and digests of the hulls of each asset, in the order of the project."""
        return iterate_asset_index(self.store.found, self.store.layout, execution=self.execution)


class Labeler(ABC):
    """A source of labels, built in or of a plug-in.

    A plug-in's class takes no arguments. name: what `label --with` takes, set for plug-ins by the registry; about: a
    phrase for `--help`; work: what progress lines call its work; replaces: whether it gives other labels to
    hulls that have one, so that one wants to know which.
    """

    name = ""
    about = ""
    work = "labelling"
    replaces = False

    @abstractmethod
    def propose(self, family: LabelFamily) -> LabelProposal:
        """Return the labels for the hulls of a family. Nothing is written here.

        Raises MeshForgeError where there can be none at all; what is wrong with one asset is an error of that asset.
        """

    def can_replace(self, current: Label | None, given: Label | None) -> bool:
        """Return whether a label, None for none, may be replaced by a given one; a person's label stays in any case."""
        return given is not None and can_replace_less_certain(current, given)
