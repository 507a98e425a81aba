"""What is done with a project folder: demonstrate, learn, ask, review, apply, and how far everything is."""

from meshforge.project.learn import FamilyMeshes, ProgramState, select_assets, suggest_first_demonstration
from meshforge.project.prepare import PreparationResult
from meshforge.project.project import Project
from meshforge.project.run import output_digest
from meshforge.project.status import AssetStatus, Status

__all__ = [
    "AssetStatus",
    "FamilyMeshes",
    "PreparationResult",
    "ProgramState",
    "Project",
    "Status",
    "output_digest",
    "select_assets",
    "suggest_first_demonstration",
]
