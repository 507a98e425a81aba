"""Physics engines: what each takes of hulls, and what it makes of the rest."""

from meshforge.common.exports import export_lazily

__getattr__, __all__ = export_lazily(
    __name__,
    {
        "limits": (
            "CODES CODES_BY_RULE ENGINES MESH_FILES Engine Finding Limit RuleCode Severity check_limits find_engine "
            "make_limit"
        ),
        "shapes": "EngineShape ShapeComparison",
    },
)
