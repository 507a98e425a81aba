"""The language of programs: extractors, actions, orientation; parsing, printing, evaluating and running them."""

from __future__ import annotations

from meshforge.common.exports import export_lazily

__getattr__, __all__ = export_lazily(
    __name__,
    {
        "actions.base": (
            "AXES PRIMITIVES Action ActionIcon ArgumentType FactorArgument FileArgument FlagArgument LengthArgument "
            "OptionArgument PrimitiveOrFileArgument WordArgument"
        ),
        "actions.basic": "Add Delete Each Merge Replace Scale Shrink",
        "actions.edit": "GroupEdit HullGroup NewShape Template",
        "actions.registry": "ACTIONS make_action plugin_of",
        "apply": "apply_action",
        "labels": "check_declared show_label",
        "orient": "find_rotation orient_mesh",
        "parse": "parse_extractor",
        "print": "Comments Rule explain show",
        "program": "HeaderComments Program RunResult rename_in_program",
        "replay": "Replay RuleTrace from_canonical_frame make_anew to_canonical_frame",
        "syntax": (
            "EXTREMITY SLACK All Attach BaseExtractor Diff Extractor Geo Intersect Is LandmarkPair Orient Union "
            "attach_mask geo_mask labels_of reference_length rename_in_orient select select_mask size_of"
        ),
        "words": "DIRECTIONS OPERATORS Direction",
    },
)
