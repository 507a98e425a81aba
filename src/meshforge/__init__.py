"""MeshForge: teach one collision mesh, fix the whole family.

The names below are the Python interface; each is imported when it is first used, so that `import meshforge` is quick.
"""

from typing import Any

from meshforge.common.exports import export_lazily

_get_name, __all__ = export_lazily(
    __name__,
    {
        "meshforge.common": "MeshForgeError",
        "meshforge.formats": "convert decompose from_trimesh load load_many save",
        "meshforge.geometry": "CoacdSettings HullSettings VhacdSettings",
        "meshforge.inspection": "check diff render",
        "meshforge.language": (
            "Add All Attach Delete Diff Each Geo Intersect Is Merge Program Replace Rule Scale Shrink Template Union"
        ),
        "meshforge.project": "Project",
        "meshforge.symbolic": "Hull Label SymbolicMesh",
        "meshforge.synthesis": "Answer Demonstration Options Step synthesize",
    },
)


def __getattr__(name: str) -> Any:
    if name == "__version__":
        from importlib.metadata import version  # lazy: reads files

        return version("meshforge")
    return _get_name(name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
