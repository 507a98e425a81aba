"""Pictures in which each hull of a mesh is seen and numbered at least once."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping

from meshforge.errors import UsageError, nearest
from meshforge.symbolic import SymbolicMesh
from meshforge.views.camera import Up
from meshforge.views.labelling.arrangement import COARSE, Arrangement
from meshforge.views.labelling.choosing import chosen
from meshforge.views.labelling.further import alone, arrangements, best
from meshforge.views.labelling.picture import Easel
from meshforge.views.labelling.placing import LEAST
from meshforge.views.labelling.shot import Shot
from meshforge.views.labelling.sights import LIKED
from meshforge.views.labelling.sitter import Sitter
from meshforge.views.subject import up_axis

SIZES = range(256, 4097)
_GLIMPSED = 2.5  # pixels of a glimpse: fewer tell little
_POOR = 10 * LEAST  # pixels: hulls that show fewer of them everywhere are drawn from close up, if pictures are left


def numbers(mesh: SymbolicMesh) -> Mapping[str, int]:
    """The number that stands on each hull, by name: its index in the mesh."""
    return {hull.name: k for k, hull in enumerate(mesh.hulls)}


def shots(
    mesh: SymbolicMesh,
    *,
    hulls: Collection[str] | None = None,
    most: int = 6,
    size: int = 1024,
    up: Up | None = None,
) -> tuple[Shot, ...]:
    """Views chosen so that each of `hulls`, by default all, is seen and numbered in at least one.

    At most `most` of them show the mesh as it is, the most telling first. Hulls that none of these shows are shown
    from close up, alone among faint others, or with all hulls drawn apart, in further ones. Hulls beside `hulls` are
    pale and have no number. All are orthographic.

    size: pixels along each side; up: as of `render`. Same input, same pictures. Raises UsageError for hulls that are
    not there, and for an impossible number or size of pictures.
    """
    names = numbers(mesh)
    picked = set(names if hulls is None else hulls)
    _check(names, picked, most, size)
    sitter = Sitter(mesh, tuple(k for name, k in names.items() if name in picked), up_axis(mesh, up))
    return tuple(_Session(Easel(sitter, size)).run(most)) if picked else ()


def _check(names: Mapping[str, int], picked: Collection[str], most: int, size: int) -> None:
    unknown = sorted(set(picked) - set(names))
    if unknown:
        alike = nearest(unknown[0], names)
        raise UsageError(f"there is no hull {unknown[0]!r}", remedy=f"Is it {alike!r}?" if alike else None)
    if most < 1:
        raise UsageError(f"{most} pictures show nothing", remedy="Ask for one at least.")
    if size not in SIZES:
        raise UsageError(
            f"pictures for labelling cannot be {size} pixels wide",
            remedy=f"Sides go from {SIZES.start} to {SIZES.stop - 1}.",
        )


class _Session:
    """Pictures of one sitter, taken one by one until every hull is numbered."""

    def __init__(self, easel: Easel) -> None:
        self._easel, self._sitter = easel, easel.sitter
        self._pictures: list[Shot] = []
        self._clear: dict[int, int] = {}
        """How many pixels show each hull that is numbered, at best."""

    def run(self, most: int) -> list[Shot]:
        whole = Arrangement.in_place(self._sitter)
        wanted = list(self._sitter.wanted)
        quality = {view: whole.preview(view, self._aspect).quality(self._least_share)[wanted] for view in LIKED}
        for view in chosen(quality, most):
            self._keep(self._easel.draw(whole, view))
        self._show_poor(most)
        self._show_left()
        return self._pictures

    def _show_poor(self, most: int) -> None:
        """Takes pictures, `most` in all, that show hulls well of which little is seen so far, while that helps."""
        while len(self._pictures) < most and (poor := self._below(_POOR)):
            shot = self._draw_close_up(poor)
            if not any(pixels >= _POOR for pixels in self._pixels_of_numbered(shot, poor)):
                break
            self._keep(shot)

    def _show_left(self) -> None:
        """Takes pictures until each hull has its number."""
        lost: set[int] = set()
        while left := [k for k in self._sitter.wanted if k not in self._clear and k not in lost]:
            shot = self._draw_close_up(left)
            if not self._pixels_of_numbered(shot, left):
                choice = [(alone(self._sitter, left[0]), 1.0)]
                shot = self._easel.draw(*best(choice, left[:1], self._least_share, self._aspect))
                lost.add(left[0])
            self._keep(shot)

    def _draw_close_up(self, left: list[int]) -> Shot:
        """A picture that shows many of the hulls that are left."""
        return self._easel.draw(*best(list(arrangements(self._sitter, left)), left, self._least_share, self._aspect))

    def _below(self, enough: int) -> list[int]:
        return [k for k in self._sitter.wanted if self._clear.get(k, 0) < enough]

    def _pixels_of_numbered(self, shot: Shot, hulls: Iterable[int]) -> list[int]:
        """How many pixels show each of these hulls that has its number in a picture."""
        names = (self._sitter.mesh.hulls[k].name for k in hulls)
        return [shot.visible_pixels[name] for name in names if name in shot.numbered]

    def _keep(self, shot: Shot) -> None:
        self._pictures.append(shot)
        for name in shot.numbered:
            k = self._sitter.mesh.index[name]
            self._clear[k] = max(self._clear.get(k, 0), shot.visible_pixels[name])

    @property
    def _aspect(self) -> float:
        width, height = self._easel.drawing_size
        return height / width

    @property
    def _least_share(self) -> float:
        """The share of a picture from which on a hull is likely to be numbered, as far as a glimpse can tell."""
        width, height = self._easel.drawing_size
        return max(2 * LEAST / (width * height), _GLIMPSED / (COARSE**2 * self._aspect))
