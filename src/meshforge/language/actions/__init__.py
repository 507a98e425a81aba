"""The editing actions: one base, one file an action, one line each in the registry."""

from meshforge.language.actions.add import Add
from meshforge.language.actions.arguments import AXES, PRIMITIVES, Argument
from meshforge.language.actions.base import Action
from meshforge.language.actions.delete import Delete
from meshforge.language.actions.each import Each
from meshforge.language.actions.edit import Edit, Group, Made
from meshforge.language.actions.merge import Merge
from meshforge.language.actions.registry import ACTIONS
from meshforge.language.actions.replace import Replace
from meshforge.language.actions.scale import Scale

__all__ = [
    "ACTIONS",
    "AXES",
    "PRIMITIVES",
    "Action",
    "Add",
    "Argument",
    "Delete",
    "Each",
    "Edit",
    "Group",
    "Made",
    "Merge",
    "Replace",
    "Scale",
]
