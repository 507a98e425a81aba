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
        PrimitiveOrFileArgument,
        WordArgument,
    )
    from meshforge.language.actions.basic import ACTIONS, Add, Delete, Each, Merge, Replace, Scale
    from meshforge.language.actions.edit import Template
    from meshforge.language.apply import (
        ActionResult,
        RuleTrace,
        apply_action,
        apply_rule,
        from_canonical_frame,
        to_canonical_frame,
    )
    from meshforge.language.orient import find_rotation, orient_mesh
    from meshforge.language.parse import parse_action, parse_extractor, parse_orient
    from meshforge.language.print import Comments, Rule, explain, show, show_label
    from meshforge.language.program import HeaderComments, Program, RunResult, rename_in_program
    from meshforge.language.syntax import (
        DIRECTIONS,
        EXTREMITY,
        OPERATORS,
        SLACK,
        All,
        Attach,
        BaseExtractor,
        Diff,
        Direction,
        Extractor,
        Geo,
        Intersect,
        Is,
        LandmarkPair,
        Orient,
        Union,
        attach_mask,
        check_declared,
        geo_mask,
        labels_of,
        reference_length,
        rename_in_orient,
        select,
        select_mask,
        size_of,
    )
else:
    __getattr__ = export_lazily(__name__, __file__)

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
    "HeaderComments",
    "Intersect",
    "Is",
    "LandmarkPair",
    "Merge",
    "Orient",
    "PrimitiveOrFileArgument",
    "Program",
    "Replace",
    "Rule",
    "RuleTrace",
    "RunResult",
    "Scale",
    "Template",
    "Union",
    "WordArgument",
    "apply_action",
    "apply_rule",
    "attach_mask",
    "check_declared",
    "explain",
    "find_rotation",
    "from_canonical_frame",
    "geo_mask",
    "labels_of",
    "orient_mesh",
    "parse_action",
    "parse_extractor",
    "parse_orient",
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
