"""The goal that an asset stands."""

from dataclasses import dataclass

from meshforge.checks.goals.base import Goal, GoalSubject
from meshforge.checks.trials.place import Failure
from meshforge.common import require_mujoco


@dataclass(frozen=True, slots=True)
class Stands(Goal):
    """Dropped from 1 cm as one rigid body, leaning a little, it ends upright and at rest."""

    def find_failure(self, subject: GoalSubject) -> Failure | None:
        require_mujoco("a goal")
        from meshforge.checks.trials.stands import try_stand  # lazy: MuJoCo takes 0.3 s

        return try_stand(subject.hulls, subject.end.diagonal)
