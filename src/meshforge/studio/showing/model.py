"""The model that a project can ask for labels, as its settings name it."""

from __future__ import annotations

from importlib.util import find_spec
from typing import TYPE_CHECKING

from meshforge.errors import MeshForgeError
from meshforge.studio.wire.labelling import Model

if TYPE_CHECKING:
    from meshforge.project import Project


def model_of(project: Project) -> Model | None:
    """None where the settings name no model, or cannot be read."""
    try:
        settings = project.settings.vlm
    except MeshForgeError:
        return None
    if not settings.model:
        return None
    host, why = "", None
    try:
        host = settings.endpoint().host
        settings.check(project.vocabulary)
    except MeshForgeError as error:
        why = error.message
    if find_spec("openai") is None:
        why = "This needs the extra: pip install 'meshforge[vlm]'"
    return Model(name=settings.model, host=host, mode=settings.mode, max_cost=settings.max_cost, why=why)
