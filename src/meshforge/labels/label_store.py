"""A store with the use cases that label hulls."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from pathlib import Path

from meshforge.batch import IN_PROCESS, ExecutionOptions
from meshforge.labels import from_files, label_by_consensus, label_by_propagation, names, vlm
from meshforge.labels.family_comparison import Stage, WriteBlock, ignore_stage
from meshforge.labels.label_by_consensus import ConsensusResult, SourceRestoration
from meshforge.labels.label_by_plugin import label_by_plugin, propose_by_plugin
from meshforge.labels.label_by_propagation import PropagationResult
from meshforge.labels.label_sources import keep_label_source
from meshforge.labels.merge import LabelOutcome, OutcomeCallback, ignore_report, set_labels, set_labels_of
from meshforge.labels.summary import Proposals, Tally, describe_label_plan, tally, write_contact_sheets
from meshforge.store import Store, VlmSettings
from meshforge.symbolic import LabelSource


@dataclass(frozen=True)
class LabelStore(Store):
    """A `Store` whose further methods label hulls, one statement each."""

    def set_labels(
        self, asset: str, labels: Mapping[str, str | None], *, source: LabelSource = "user", confidence: float = 1.0
    ) -> LabelOutcome:
        """Label some hulls of an asset, or remove their labels by None. A machine never overwrites a person's label.

        Raises ProjectError, with nothing written, for an unknown hull or a label that is not in the vocabulary.
        """
        return set_labels(self, asset, labels, source, confidence)

    def set_labels_of(
        self, labels: Mapping[str, Mapping[str, str | None]], *, source: LabelSource = "user", confidence: float = 1.0
    ) -> tuple[LabelOutcome, ...]:
        """Label hulls of several assets as `set_labels` does, all or none. labels: by asset and hull."""
        return set_labels_of(self, labels, source, confidence)

    def label_from_files(
        self,
        source: Path | None = None,
        options: from_files.LabelFileOptions | None = None,
        *,
        execution: ExecutionOptions = IN_PROCESS,
        report: OutcomeCallback = ignore_report,
    ) -> tuple[LabelOutcome, ...]:
        """Take labels from files: labels files, segmented points, and PartNet's semantics of links.

        source: a file for a single asset, a folder that mirrors the assets, or None for the files beside them. A
        project without a vocabulary takes that of the files. report: called with the outcome of each asset, as soon as
        its labels are written, in the order of the assets.
        Raises ProjectError: no file at all; UsageError: a wrong pattern, or one file for several assets; AssetError: a
        file that cannot be read while a vocabulary is looked for.
        """
        how = options or from_files.LabelFileOptions()
        outcomes = from_files.label_from_files(self, source, how, execution, report)
        keep_label_source(self, outcomes, "file", how, source)
        return outcomes

    def propose_from_files(
        self,
        source: Path | None = None,
        options: from_files.LabelFileOptions | None = None,
        vocabulary: Sequence[str] | None = None,
        *,
        execution: ExecutionOptions = IN_PROCESS,
    ) -> Proposals:
        """What `label_from_files` would take, with nothing written; vocabulary: one to try instead."""
        return from_files.propose_from_files(
            self, source, options or from_files.LabelFileOptions(), vocabulary, execution
        )

    def label_from_names(
        self,
        meanings: names.PatternPairs = (),
        *,
        execution: ExecutionOptions = IN_PROCESS,
        report: OutcomeCallback = ignore_report,
    ) -> tuple[LabelOutcome, ...]:
        """Label hulls without a label by their own names, those of their bodies, and what else their files call them.

        Patterns count first: `meanings`, then those of the project's settings; then the words of the vocabulary, and
        words that are nearly those. report: called with the outcome of each asset, in their order.
        Raises ProjectError: no vocabulary; UsageError: a wrong pattern.
        """
        outcomes = names.label_from_names(self, meanings, execution, report)
        keep_label_source(self, outcomes, "names", from_files.LabelFileOptions(meanings))
        return outcomes

    def propose_from_names(
        self,
        meanings: names.PatternPairs = (),
        vocabulary: Sequence[str] | None = None,
        *,
        execution: ExecutionOptions = IN_PROCESS,
    ) -> Proposals:
        """What `label_from_names` would take, with nothing written; vocabulary: one to try instead."""
        return names.propose_from_names(self, meanings, vocabulary, execution)

    def plan_labels(self) -> str:
        """A sentence on how many assets there are of what, and how many have labels."""
        return describe_label_plan(self)

    def tally_labels(self, progress: Callable[[], None] | None = None) -> Tally:
        """How many hulls have labels of which source and confidence."""
        return tally(self, progress)

    def draw_labels(
        self, folder: Path, assets: Sequence[str], progress: Callable[[], None] | None = None
    ) -> tuple[Path, ...]:
        """Write contact sheets of some assets, `labels-001.png` and so on, in which hulls have their labels' colours.

        Earlier sheets are replaced. Raises UsageError where one cannot be written.
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
        """Propagate the labels of a few assets to all others; labels of people and files stay.

        Descriptions of the hulls are kept in the project, so that the next time is quick. stage: entered for each part
        of the work; report: called with the outcome of each asset, in their order; write_block: the block in which all
        labels are written, given the asset that would help most.
        Raises ProjectError: no vocabulary, no label to begin with; StoppedError on a stop, with nothing written.
        """
        return label_by_propagation.propagate_labels(self, execution, stage, report, write_block)

    def propose_propagated(
        self,
        vocabulary: Sequence[str] | None = None,
        *,
        execution: ExecutionOptions = IN_PROCESS,
        stage: Stage = ignore_stage,
    ) -> Proposals:
        """What `propagate_labels` would give, with nothing written; vocabulary: one to try instead."""
        return label_by_propagation.propose_propagated(self, vocabulary, execution, stage)

    def label_by_consensus(
        self,
        *,
        execution: ExecutionOptions = IN_PROCESS,
        stage: Stage = ignore_stage,
        report: OutcomeCallback = ignore_report,
        write_block: WriteBlock = nullcontext,
    ) -> ConsensusResult:
        """Give each hull the label that all sources together speak for; labels of people stay.

        Each source counts as far as it is right in this family, beside the labels of hulls that look alike. A label
        that it is right about stays as that source gave it; one that was replaced is kept beside the new one, see
        `restore_sources`. Doing it again changes nothing. stage, report, write_block: see `propagate_labels`.
        Raises ProjectError: no vocabulary, no label at all; StoppedError on a stop, with nothing written.
        """
        return label_by_consensus.label_by_consensus(self, execution, stage, report, write_block)

    def propose_consensus(
        self,
        vocabulary: Sequence[str] | None = None,
        *,
        execution: ExecutionOptions = IN_PROCESS,
        stage: Stage = ignore_stage,
    ) -> Proposals:
        """What `label_by_consensus` would give, with nothing written; vocabulary: one to try instead."""
        return label_by_consensus.propose_consensus(self, vocabulary, execution, stage)

    def restore_sources(
        self, *, execution: ExecutionOptions = IN_PROCESS, report: OutcomeCallback = ignore_report
    ) -> SourceRestoration:
        """Put back what sources said where a label was inferred: a hull of which nothing was said has none then.

        It undoes `label_by_consensus` and `propagate_labels`. report: called with the outcome of each asset, in their
        order.
        """
        return label_by_consensus.restore_sources(self, execution, report)

    def propose_sources(self, *, execution: ExecutionOptions = IN_PROCESS) -> Proposals:
        """What `restore_sources` would put back, with nothing written."""
        return label_by_consensus.propose_sources(self, execution)

    def label_by_plugin(
        self, name: str, *, execution: ExecutionOptions = IN_PROCESS, report: OutcomeCallback = ignore_report
    ) -> tuple[LabelOutcome, ...]:
        """Take the labels of a plug-in's labeller; labels of people and files stay, and of machines the surer ones.

        report: called with the outcome of each asset, in their order; what the plug-in does wrong is a problem in it.
        Raises ProjectError: no vocabulary; UsageError: no such labeller; PluginError: it cannot be loaded.
        """
        outcomes = label_by_plugin(self, name, execution, report)
        keep_label_source(self, outcomes, name, from_files.LabelFileOptions())
        return outcomes

    def propose_by_plugin(
        self, name: str, vocabulary: Sequence[str] | None = None, *, execution: ExecutionOptions = IN_PROCESS
    ) -> Proposals:
        """What `label_by_plugin` would take, with nothing written; vocabulary: one to try instead."""
        return propose_by_plugin(self, name, vocabulary, execution)

    def label_with_vlm(
        self,
        settings: VlmSettings | None = None,
        *,
        progress: Callable[[vlm.Usage], None] | None = None,
        stop: Callable[[], bool] | None = None,
        write_block: Callable[[], AbstractContextManager[object]] | None = None,
        execution: ExecutionOptions = IN_PROCESS,
        typed: Collection[str] = (),
    ) -> vlm.VlmResult:
        """Ask a vision-language model for labels; labels of people and files stay.

        settings: those of the project when None. progress: called for each asset, with what was spent so far; stop:
        whether to ask no more; write_block: the block in which all labels are written in the end; None writes those of
        an asset as soon as its answers are there; execution: how pictures are drawn. Answers are kept, so that none is
        paid for twice. typed: addresses that the user typed, who thereby approves them; elsewhere but to this machine
        nothing is sent before `approve_host`. Raises MeshForgeError where nothing could be asked at all.
        """
        return vlm.label_with_vlm(self, settings or self.settings.vlm, progress, stop, write_block, execution, typed)

    def forecast_vlm(
        self,
        settings: VlmSettings | None = None,
        *,
        progress: Callable[[], None] | None = None,
        stop: Callable[[], bool] | None = None,
        vocabulary: Sequence[str] | None = None,
        execution: ExecutionOptions = IN_PROCESS,
    ) -> vlm.VlmForecast:
        """What `label_with_vlm` would send and what that costs, with nothing sent; vocabulary: one to try instead."""
        return vlm.forecast_vlm(self, settings or self.settings.vlm, progress, stop, vocabulary, execution)
