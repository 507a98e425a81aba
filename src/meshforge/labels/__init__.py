"""The labels of a project: from people, names, files, a few labelled assets or a model; a person's label is never
overwritten by a machine."""

from __future__ import annotations

from typing import TYPE_CHECKING

from meshforge.common.exports import export_lazily

if TYPE_CHECKING:
    from meshforge.formats import PointAlignment
    from meshforge.labels.by_hand import label_command
    from meshforge.labels.family_comparison import ignore_stage
    from meshforge.labels.from_files.read import LabelFileOptions, label_file_beside
    from meshforge.labels.label_by_consensus import LabelChange
    from meshforge.labels.label_by_plugin import LABELERS, AssetLabeler, check_labeler
    from meshforge.labels.label_by_propagation import PropagationResult
    from meshforge.labels.label_store import LabelStore
    from meshforge.labels.merge import LabelOutcome, label_new_hulls
    from meshforge.labels.offers import LabelOffers, OfferCache
    from meshforge.labels.reference_family import NEW, ReferenceFamily, pick_evenly, read_reference_family
    from meshforge.labels.spans import HullSpan, LabelledPart, SpanReport, find_spans
    from meshforge.labels.summary import Proposal, Proposals, SourceTally, Tally
    from meshforge.labels.vlm.approval import approve_host, check_approved, describe_sending, is_approved
    from meshforge.labels.vlm.endpoint import Endpoint, endpoint_of
    from meshforge.labels.vlm.label_by_vlm import VlmForecast, VlmResult, check_vlm_settings
    from meshforge.labels.vlm.limits import Usage
else:
    __getattr__ = export_lazily(__name__)

__all__ = [
    "LABELERS",
    "NEW",
    "AssetLabeler",
    "Endpoint",
    "HullSpan",
    "LabelChange",
    "LabelFileOptions",
    "LabelOffers",
    "LabelOutcome",
    "LabelStore",
    "LabelledPart",
    "OfferCache",
    "PointAlignment",
    "PropagationResult",
    "Proposal",
    "Proposals",
    "ReferenceFamily",
    "SourceTally",
    "SpanReport",
    "Tally",
    "Usage",
    "VlmForecast",
    "VlmResult",
    "approve_host",
    "check_approved",
    "check_labeler",
    "check_vlm_settings",
    "describe_sending",
    "endpoint_of",
    "find_spans",
    "ignore_stage",
    "is_approved",
    "label_command",
    "label_file_beside",
    "label_new_hulls",
    "pick_evenly",
    "read_reference_family",
]
