"""MeshForge: teach one collision mesh, fix the whole family.

The names below are the Python interface; each is imported when it is first used, so that `import meshforge` is quick.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    __version__: str
    from meshforge.common import MeshForgeError
    from meshforge.formats import convert, decompose, from_trimesh, load, load_many, save
    from meshforge.geometry import CoacdSettings, HullSettings, VhacdSettings
    from meshforge.inspection import check, diff, render
    from meshforge.language import (
        Add,
        All,
        Attach,
        Delete,
        Diff,
        Each,
        Geo,
        Intersect,
        Is,
        Merge,
        Program,
        Replace,
        Rule,
        Scale,
        Shrink,
        Template,
        Union,
    )
    from meshforge.project import Project
    from meshforge.symbolic import Hull, Label, SymbolicMesh
    from meshforge.synthesis import Answer, Demonstration, Options, Step, synthesize

__all__ = [
    "Add",
    "All",
    "Answer",
    "Attach",
    "CoacdSettings",
    "Delete",
    "Demonstration",
    "Diff",
    "Each",
    "Geo",
    "Hull",
    "HullSettings",
    "Intersect",
    "Is",
    "Label",
    "Merge",
    "MeshForgeError",
    "Options",
    "Program",
    "Project",
    "Replace",
    "Rule",
    "Scale",
    "Shrink",
    "Step",
    "SymbolicMesh",
    "Template",
    "Union",
    "VhacdSettings",
    "check",
    "convert",
    "decompose",
    "diff",
    "from_trimesh",
    "load",
    "load_many",
    "render",
    "save",
    "synthesize",
]

_PACKAGES = {
    "common": ("MeshForgeError",),
    "formats": ("convert", "decompose", "from_trimesh", "load", "load_many", "save"),
    "geometry": ("CoacdSettings", "HullSettings", "VhacdSettings"),
    "inspection": ("check", "diff", "render"),
    "language": (
        *("All", "Attach", "Diff", "Geo", "Intersect", "Is", "Union"),
        *("Add", "Delete", "Each", "Merge", "Program", "Replace", "Rule", "Scale", "Shrink", "Template"),
    ),
    "project": ("Project",),
    "symbolic": ("Hull", "Label", "SymbolicMesh"),
    "synthesis": ("Answer", "Demonstration", "Options", "Step", "synthesize"),
}
_HOMES = {name: package for package, names in _PACKAGES.items() for name in names}


if not TYPE_CHECKING:  # a type checker that saw it would take every name for one of the interface

    def __getattr__(name):
        if name == "__version__":
            from importlib.metadata import version  # lazy: reads files

            return version("meshforge")
        if name not in _HOMES:
            raise AttributeError(f"module 'meshforge' has no attribute {name!r}")
        value = getattr(import_module(f"meshforge.{_HOMES[name]}"), name)
        globals()[name] = value
        return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
