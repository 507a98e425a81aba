"""The language of programs: extractors, actions, orientation; parsing, printing, evaluating and running them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from meshforge.common.exports import export_lazily

if TYPE_CHECKING:
    from meshforge.language.actions.base import (
        AXES,
        PRIMITIVES,
        Action,
        ArgumentType,
        FactorArgument,
        FileArgument,
        FlagArgument,
        LengthArgument,
        OptionArgument,
        PrimitiveOrFileArgument,
        WordArgument,
    )
    from meshforge.language.actions.basic import Add, Delete, Each, Merge, Replace, Scale, Shrink
    from meshforge.language.actions.edit import GroupEdit, HullGroup, NewShape, Template
    from meshforge.language.actions.registry import ACTIONS, make_action, plugin_of
    from meshforge.language.apply import (
        ActionResult,
        RuleTrace,
        apply_action,
        apply_rule,
        apply_to_selection,
        from_canonical_frame,
        to_canonical_frame,
    )
    from meshforge.language.labels import check_declared, show_label
    from meshforge.language.orient import find_rotation, orient_mesh
    from meshforge.language.parse import parse_extractor
    from meshforge.language.print import Comments, Rule, explain, show
    from meshforge.language.program import HeaderComments, Program, RunResult, rename_in_program
    from meshforge.language.syntax import (
        EXTREMITY,
        SLACK,
        All,
        Attach,
        BaseExtractor,
        Diff,
        Extractor,
        Geo,
        Intersect,
        Is,
        LandmarkPair,
        Orient,
        Union,
        attach_mask,
        geo_mask,
        labels_of,
        reference_length,
        rename_in_orient,
        select,
        select_mask,
        size_of,
    )
    from meshforge.language.words import DIRECTIONS, OPERATORS, Direction
else:
    __getattr__ = export_lazily(__name__)

__all__ = [
    "ACTIONS",
    "AXES",
    "DIRECTIONS",
    "EXTREMITY",
    "OPERATORS",
    "PRIMITIVES",
    "SLACK",
    "Action",
    "ActionResult",
    "Add",
    "All",
    "ArgumentType",
    "Attach",
    "BaseExtractor",
    "Comments",
    "Delete",
    "Diff",
    "Direction",
    "Each",
    "Extractor",
    "FactorArgument",
    "FileArgument",
    "FlagArgument",
    "Geo",
    "GroupEdit",
    "HeaderComments",
    "HullGroup",
    "Intersect",
    "Is",
    "LandmarkPair",
    "LengthArgument",
    "Merge",
    "NewShape",
    "OptionArgument",
    "Orient",
    "PrimitiveOrFileArgument",
    "Program",
    "Replace",
    "Rule",
    "RuleTrace",
    "RunResult",
    "Scale",
    "Shrink",
    "Template",
    "Union",
    "WordArgument",
    "apply_action",
    "apply_rule",
    "apply_to_selection",
    "attach_mask",
    "check_declared",
    "explain",
    "find_rotation",
    "from_canonical_frame",
    "geo_mask",
    "labels_of",
    "make_action",
    "orient_mesh",
    "parse_extractor",
    "plugin_of",
    "reference_length",
    "rename_in_orient",
    "rename_in_program",
    "select",
    "select_mask",
    "show",
    "show_label",
    "size_of",
    "to_canonical_frame",
]
