"""Hull templates: the shapes that programs insert, given to a run by whoever read them from files."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property

from meshforge.errors import ProgramError
from meshforge.geometry import Aabb, Shape


@dataclass(frozen=True, eq=False)
class Template:
    """The convex shapes of one template file, in the file's own frame; name: the path as programs write it."""

    shapes: tuple[Shape, ...]
    name: str

    def __post_init__(self) -> None:
        if not self.shapes:
            raise ProgramError("a template needs at least one convex hull, it has none", where=self.name)

    @cached_property
    def digest(self) -> str:
        """Thirty-two hexadecimal digits of its shapes, to the last bit: what is made of it follows from them."""
        data = hashlib.blake2b(digest_size=16)
        for shape in self.shapes:
            for part in (shape.kind.encode(), shape.vertices.tobytes(), shape.faces.tobytes()):
                data.update(len(part).to_bytes(8, "little") + part)
        return data.hexdigest()

    @property
    def aabb(self) -> Aabb:
        """The box around all its shapes."""
        return Aabb.union(shape.aabb for shape in self.shapes)


def check_templates(wanted: Iterable[str], templates: Mapping[str, Template]) -> None:
    """Raises ProgramError naming the first wanted template that is not among those given."""
    for name in wanted:
        if name not in templates:
            given = ", ".join(sorted(templates)) or "none"
            raise ProgramError(
                f'there is no template "{name}" (templates given: {given})',
                remedy="Templates are looked for beside the program, then in the folder templates/ beside it.",
            )
