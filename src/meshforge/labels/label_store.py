"""A store with the use cases that label hulls."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from pathlib import Path

from meshforge.batch import IN_PROCESS, ExecutionOptions
from meshforge.labels.from_files.label_by_files import label_from_files, propose_from_files
from meshforge.labels.from_files.read import LabelFileOptions
from meshforge.labels.merge import LabelOutcome, OutcomeCallback, ignore_report, set_labels
from meshforge.labels.names.label_by_names import PatternPairs, label_from_names, propose_from_names
from meshforge.labels.offers import LabelOffers, OfferCache
from meshforge.labels.progress import Tally, describe_label_plan, tally, write_contact_sheets
from meshforge.labels.propagation.label_by_propagation import (
    PropagationResult,
    Stage,
    WriteBlock,
    ignore_stage,
    propagate_labels,
    propose_propagated,
)
from meshforge.labels.propose import Proposals
from meshforge.labels.vlm.label_by_vlm import VlmForecast, VlmResult, forecast_vlm, label_with_vlm
from meshforge.labels.vlm.limits import Usage
from meshforge.store import Store, VlmSettings
from meshforge.symbolic import LabelSource


@dataclass(frozen=True)
class LabelStore(Store):
    """A `Store` whose further methods label hulls, one statement each."""

    def set_labels(
        self, asset: str, labels: Mapping[str, str | None], *, source: LabelSource = "user", confidence: float = 1.0
    ) -> LabelOutcome:
        """Label some hulls of an asset, or take labels away by None. A machine's source never overwrites a person's."""
        return set_labels(self, asset, labels, source, confidence)

    def label_from_files(
        self,
        source: Path | None = None,
        options: LabelFileOptions | None = None,
        *,
        execution: ExecutionOptions = IN_PROCESS,
        report: OutcomeCallback = ignore_report,
    ) -> tuple[LabelOutcome, ...]:
        """Take over what files say: labels files, segmented points and meshes, and PartNet's semantics of links.

        source: a file for a single asset, a folder that mirrors the assets, or None for those beside them; how: the way
        they are read. A project without a vocabulary takes that of the files. execution: over worker processes, where one
        asset that crashes or hangs costs no more than itself; unless said, the work is done in this process. report:
        called with what became of each asset, as soon as its labels are written, in the order of the assets.
        """
        return label_from_files(self, source, options or LabelFileOptions(), execution, report)

    def propose_from_files(
        self,
        source: Path | None = None,
        options: LabelFileOptions | None = None,
        vocabulary: Sequence[str] | None = None,
        *,
        execution: ExecutionOptions = IN_PROCESS,
    ) -> Proposals:
        """What `label_from_files` would take, with nothing written; vocabulary: one to be tried."""
        return propose_from_files(self, source, options or LabelFileOptions(), vocabulary, execution)

    def label_offers(self) -> LabelOffers:
        """What `label_from_files` and `label_from_names` would give; see `OfferCache` for asking often."""
        return OfferCache().of(self)

    def label_from_names(
        self,
        meanings: PatternPairs = (),
        *,
        execution: ExecutionOptions = IN_PROCESS,
        report: OutcomeCallback = ignore_report,
    ) -> tuple[LabelOutcome, ...]:
        """Label hulls without a label by their own names, those of their bodies, and what else their files call them.

        By patterns first: `meanings`, then those of the project's settings; then by the words of the vocabulary, and
        words that are nearly those. execution, report: as of `label_from_files`.
        Raises ProjectError: no vocabulary; UsageError: a pattern that makes no sense.
        """
        return label_from_names(self, meanings, execution, report)

    def propose_from_names(
        self,
        meanings: PatternPairs = (),
        vocabulary: Sequence[str] | None = None,
        *,
        execution: ExecutionOptions = IN_PROCESS,
    ) -> Proposals:
        """What `label_from_names` would take, with nothing written; vocabulary: one to be tried."""
        return propose_from_names(self, meanings, vocabulary, execution)

    def plan_labels(self) -> str:
        """What there is to be labelled, in words: how many assets of what, and how many have labels by now."""
        return describe_label_plan(self)

    def tally_labels(self, progress: Callable[[], None] | None = None) -> Tally:
        """How many hulls have which labels: from where, and how sure."""
        return tally(self, progress)

    def draw_labels(
        self, folder: Path, assets: Sequence[str], progress: Callable[[], None] | None = None
    ) -> tuple[Path, ...]:
        """Write contact sheets of some assets, `labels-001.png` and so on, in which hulls have their labels' colours.

        Sheets of an earlier time are replaced. Raises UsageError where one cannot be written.
        """
        return write_contact_sheets(self, folder, assets, progress)

    def propagate_labels(
        self,
        *,
        execution: ExecutionOptions = IN_PROCESS,
        stage: Stage = ignore_stage,
        report: OutcomeCallback = ignore_report,
        write_block: WriteBlock = nullcontext,
    ) -> PropagationResult:
        """Carry the labels of a few assets to all others; what a person or a file says stays.

        How the hulls of an asset look is kept in the project, so that another time is quick. execution, report: as of
        `label_from_files`; stage: gives what is entered for each part of the work; keeping: the block in which all is
        written, given the asset that would help most.
        Raises ProjectError: no vocabulary, no label to begin with; StoppedError when it was told to stop, with nothing
        written.
        """
        return propagate_labels(self, execution, stage, report, write_block)

    def propose_propagated(
        self,
        vocabulary: Sequence[str] | None = None,
        *,
        execution: ExecutionOptions = IN_PROCESS,
        stage: Stage = ignore_stage,
    ) -> Proposals:
        """What `propagate_labels` would give, with nothing written; vocabulary: one to be tried."""
        return propose_propagated(self, vocabulary, execution, stage)

    def label_with_vlm(
        self,
        settings: VlmSettings | None = None,
        *,
        progress: Callable[[Usage], None] | None = None,
        stop: Callable[[], bool] | None = None,
        write_block: Callable[[], AbstractContextManager[object]] | None = None,
        execution: ExecutionOptions = IN_PROCESS,
    ) -> VlmResult:
        """Ask a vision-language model for labels; what a person or a file says stays.

        settings: those of the project when None. progress: called for each asset, with what was spent so far; stop:
        says when to ask no more; keeping: the block in which all labels are written, in the end; None writes those of
        an asset as soon as all is said of it; execution: how pictures are drawn. Answers are kept, so that none is paid
        for twice. Raises MeshForgeError where nothing could be asked at all.
        """
        return label_with_vlm(self, settings or self.settings.vlm, progress, stop, write_block, execution)

    def forecast_vlm(
        self,
        settings: VlmSettings | None = None,
        *,
        progress: Callable[[], None] | None = None,
        stop: Callable[[], bool] | None = None,
        vocabulary: Sequence[str] | None = None,
        execution: ExecutionOptions = IN_PROCESS,
    ) -> VlmForecast:
        """What `label_with_vlm` would send and cost, with nothing sent; the same options; vocabulary: another one."""
        return forecast_vlm(self, settings or self.settings.vlm, progress, stop, vocabulary, execution)
