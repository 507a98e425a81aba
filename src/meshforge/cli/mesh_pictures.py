"""Pictures of assets in a folder of the project, as questions show them: some hulls in colour, the asset upright."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from meshforge.language import Orient, Program, to_canonical_frame
from meshforge.project import Project, run_with_manual_edits
from meshforge.rendering import Up, draw_before_after, make_contact_sheet, render, write_png
from meshforge.symbolic import SymbolicMesh

if TYPE_CHECKING:
    from PIL.Image import Image

PICTURE_SIZE = (720, 560)
_SMALL_SIZE = (480, 374)


class MeshPictures:
    """Draws into a folder. meshes: gives the assets in memory, by id."""

    def __init__(self, project: Project, meshes: Callable[[], Mapping[str, SymbolicMesh]], folder: Path) -> None:
        self._project, self._meshes, self._folder = project, meshes, folder

    def clear(self) -> None:
        """Take all pictures away."""
        shutil.rmtree(self._folder, ignore_errors=True)

    def mesh_before_rule(self, asset: str, rule: int, program: Program) -> SymbolicMesh:
        """An asset as a rule of a program meets it. Raises MeshForgeError where the rules before it fail."""
        return self._project.mesh_before_rule(asset, rule, program, self._meshes())

    def draw(self, mesh: SymbolicMesh, chosen: frozenset[str], name: str, title: str) -> Path:
        """Draw an asset that stands upright, some hulls in colour; the path of the picture, as one types it here."""
        picture = render(mesh, highlight=chosen, size=PICTURE_SIZE, title=title, up=self._up(self._project.orientation))
        return self._write(name, picture)

    def draw_sheet(self, some: Mapping[str, frozenset[str]], name: str) -> Path:
        """Draw hulls of several assets, each asset as it lies, on one sheet."""
        meshes = self._meshes()
        pictures = [
            render(meshes[asset], highlight=chosen, size=_SMALL_SIZE, title=asset) for asset, chosen in some.items()
        ]
        return self._write(name, make_contact_sheet(pictures))

    def draw_labels(self, asset: str, name: str) -> Path:
        """Draw an asset in the colours of its labels."""
        mesh, words = self._meshes()[asset], self._project.vocabulary
        return self._write(name, render(mesh, color_by="label", size=PICTURE_SIZE, title=asset, vocabulary=words))

    def draw_result(self, asset: str, program: Program, name: str) -> Path:
        """Draw an asset before and after a program and its edits by hand. Raises MeshForgeError where that cannot
        run."""
        mesh = self._meshes()[asset]
        before, pose = to_canonical_frame(mesh, program.orient, program.contact)
        after = run_with_manual_edits(self._project, asset, mesh, program).mesh
        turned = after.with_hulls(hull.move(pose) for hull in after.hulls)
        words, up = self._project.vocabulary, self._up(program.orient)
        return self._write(name, draw_before_after(before, turned, size=_SMALL_SIZE, vocabulary=words, up=up))

    def draw_turned(self, asset: str, orient: Orient | None, name: str, title: str) -> Path:
        """Draw an asset as an orientation turns it, in the colours of its labels."""
        mesh = to_canonical_frame(self._meshes()[asset], orient, self._project.settings.thresholds.contact)[0]
        words, up = self._project.vocabulary, self._up(orient)
        picture = render(mesh, color_by="label", size=PICTURE_SIZE, title=title, vocabulary=words, up=up)
        return self._write(name, picture)

    def _write(self, name: str, picture: Image) -> Path:
        path, here = self._folder / f"{name}.png", Path.cwd()
        write_png(path, picture)
        return path.relative_to(here) if path.is_relative_to(here) else path

    @staticmethod
    def _up(orient: Orient | None) -> Up | None:
        """Z where the orientation names it; otherwise the file says which axis is up."""
        return "Z" if orient and orient.names_z else None
