"""The labels of a project; a person's label is never overwritten by a machine."""

from meshforge.common.exports import export_lazily

__getattr__, __all__ = export_lazily(
    __name__,
    {
        "classes": "complete_classes",
        "from_files.label_by_files": "FileLabeler LabelFileOptions label_file_beside",
        "label_family": "LabelChange LabelResult Proposal Proposals label_project",
        "label_by_inference": "AllLabeler",
        "label_by_like": "LikeLabeler LikeMismatchError",
        "labeler": "AssetLabels Labeler LabelFamily LabelProposal ignore_stage",
        "merge": "LabelOutcome NewHullLabels label_new_hulls set_labels set_labels_of",
        "names.label_by_names": "NameLabeler",
        "offers": "LabelOffers OfferCache propose_class_names",
        "reference_family": "ReferenceFamily pick_evenly read_reference_family",
        "registry": "LABELERS AssetLabeler make_labeler",
        "spans": "HullSpan SpanReport",
        "summary": "NameContradiction SourceTally Tally label_command tally_labels",
        "vlm.endpoint": "EndError Endpoint approve_host check_approved describe_sending",
        "vlm.label_by_vlm": "VlmForecast VlmLabeler VlmResult forecast_vlm",
        "vlm.cost": "Usage",
    },
)
