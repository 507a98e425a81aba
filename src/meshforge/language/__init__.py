"""The language of programs: extractors, actions, orientation; parsing, printing, evaluating and running them."""

from meshforge.common.exports import export_lazily

__getattr__, __all__ = export_lazily(
    __name__,
    {
        "actions.base": "AXES Action ActionIcon",
        "actions.basic": "Add Delete Each Merge Scale Shrink",
        "actions.edit": "GroupEdit HullGroup NewShape Template",
        "actions.misfit": "Misfit MisfitKind",
        "actions.replace": "Replace",
        "apply": "apply_action",
        "arguments": (
            "PRIMITIVES ArgumentType DirectionArgument FactorArgument FileArgument FlagArgument LabelArgument "
            "LengthArgument Operation OptionArgument PrimitiveOrFileArgument QuantityArgument Share ShareArgument "
            "TextArgument WordArgument"
        ),
        "extractors.attach": "Attach",
        "extractors.base": (
            "SET_OPERATORS BaseArgument BaseExtractor Candidates Diff Extractor ExtractorArgument Intersect Leaf Union "
            "labels_of leaves_of select select_hulls select_mask size_of to_bits"
        ),
        "extractors.geo": "SLACK UPRIGHT Geo",
        "extractors.bases": "All Is",
        "hull_table": "EXTREMITY Bools HullTable reference_length",
        "orient": "LandmarkPair Orient find_rotation orient_mesh rename_in_orient",
        "parse": "parse_extractor parse_operation",
        "print": "Comments Rule explain show",
        "program": "HeaderComments Program RunResult rename_in_program",
        "replay": "Replay RuleTrace from_canonical_frame make_anew to_canonical_frame",
        "registry": "ACTIONS EXTRACTORS OperationRegistry make_operation",
        "text": "list_operators",
        "words": "DIRECTIONS OPERATORS Direction check_declared show_label",
    },
)
