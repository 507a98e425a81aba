"""The labels of a project: from people, names, files, a few labelled assets or a model; a person's label is never
overwritten by a machine."""

from __future__ import annotations

from meshforge.common.exports import export_lazily

__getattr__, __all__ = export_lazily(
    __name__,
    {
        "meshforge.formats": "PointAlignment",
        "by_hand": "label_command",
        "family_comparison": "ignore_stage",
        "from_files.read": "LabelFileOptions label_file_beside",
        "label_by_consensus": "LabelChange",
        "label_by_plugin": "LABELERS AssetLabeler check_labeler",
        "label_by_propagation": "PropagationResult",
        "label_store": "LabelStore",
        "merge": "LabelOutcome label_new_hulls",
        "offers": "LabelOffers OfferCache",
        "reference_family": "ReferenceFamily pick_evenly read_reference_family",
        "spans": "HullSpan SpanReport",
        "summary": "Proposal Proposals SourceTally Tally",
        "vlm.approval": "approve_host check_approved describe_sending is_approved",
        "vlm.endpoint": "Endpoint endpoint_of",
        "vlm.label_by_vlm": "VlmForecast VlmResult check_vlm_settings",
        "vlm.limits": "Usage",
    },
)
