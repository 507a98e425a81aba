"""What is given to `script/bench` besides the parts: the model that is asked, and what else some parts need."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from pydantic import ValidationError

from meshforge.common import UsageError, first_validation_error

if TYPE_CHECKING:
    from meshforge.store.settings import VlmSettings


@dataclass(frozen=True, slots=True)
class RunOptions:
    """vlm: a TOML file with a table [vlm], as that of meshforge.toml, None where no model is asked.

    max_cost: the most that asking may cost [$], instead of the table's; blender: a Python that has the module bpy;
    sample: meshes on which labellers are tried; folders: labels files that something else made.
    """

    vlm: Path | None = None
    max_cost: float | None = None
    blender: Path | None = None
    sample: int = 200
    folders: tuple[Path, ...] = ()

    def settings(self) -> VlmSettings | None:
        """Whom to ask and how. Raises UsageError: no such file, no such table, or a field that does not fit."""
        from meshforge.labels import Endpoint
        from meshforge.store.settings import VlmSettings

        if self.vlm is None:
            return None
        where = str(self.vlm)
        try:
            table = tomllib.loads(self.vlm.read_text("utf-8")).get("vlm")
            if table is None:
                raise UsageError("there is no table [vlm]", where=where, remedy='Write one: [vlm] and model = "...".')
            settings = VlmSettings.model_validate(table)
        except OSError as error:
            raise UsageError(f"cannot be read: {error.strerror}", where=where) from error
        except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
            raise UsageError(f"this is no TOML: {error}", where=where) from error
        except ValidationError as error:
            raise UsageError(first_validation_error(error), where=where) from error
        Endpoint(settings).key()
        return settings if self.max_cost is None else settings.model_copy(update={"max_cost": self.max_cost})
