"""Goals by the word that begins them, those of plug-ins among them."""

from meshforge.checks.goals.base import Goal, MissingGoal
from meshforge.checks.goals.distances import Clear, Fits
from meshforge.checks.goals.graspable import Graspable
from meshforge.checks.goals.motion import Stands, Swings
from meshforge.checks.goals.objects import Contains, Passes, Supports
from meshforge.language import OperationRegistry, parse_operation

GOALS: OperationRegistry[Goal] = OperationRegistry(
    "goals",
    Goal,  # type: ignore[type-abstract]  # it is the base, and never made
    (Stands, Supports, Contains, Graspable, Passes, Swings, Clear, Fits),
    MissingGoal,
)


def parse_goal(text: str, name: str = "goal", labels: tuple[str, ...] = ()) -> Goal:
    """Return the goal in a text. labels: those that it may use, any where there are none. Raises ProgramError at
    `name:line:column`, PluginError for a goal of a plug-in that cannot be loaded."""
    return parse_operation(text, GOALS, "only_goal", name, labels)
