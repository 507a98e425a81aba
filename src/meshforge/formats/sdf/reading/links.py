"""The links of an SDF with their collisions, placed in the root frame."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from meshforge.errors import AssetError
from meshforge.formats.sdf.files.values import pose_of
from meshforge.formats.sdf.files.version import RELATIVE
from meshforge.formats.sdf.reading.compose import Composed
from meshforge.formats.sdf.reading.frames import MODEL, Places, Scope
from meshforge.formats.xml import Element
from meshforge.geometry import Pose


@dataclass(frozen=True, eq=False, slots=True)
class Link:
    """A `<link>` as a body: its name in the asset, its scope and own name there, and root_T_link."""

    body: str
    scope: Scope
    name: str
    element: Element
    pose: Pose

    @property
    def where(self) -> str:
        return self.scope.where


@dataclass(frozen=True, eq=False, slots=True)
class Collision:
    """A `<collision>` of a link."""

    link: Link
    element: Element
    pose: Pose


@dataclass(frozen=True, eq=False, slots=True)
class Links:
    """The links by the names of their bodies, their collisions in order, and where frames are."""

    by_body: dict[str, Link]
    collisions: tuple[Collision, ...]
    places: Places


def links_of(composed: Composed) -> Links:
    """The links of all models, placed.

    Raises AssetError with `where:line`: no link at all, two of one name, a frame that is not there.
    """
    places = Places()
    found: dict[str, Link] = {}
    for link in _links(composed, places):
        if link.body in found:
            problem = f"link {link.body!r} is there twice, in two models that are merged or of one name"
            raise AssetError(problem, where=f"{link.where}:{link.element.line}", remedy="Rename one of them.")
        found[link.body] = link
    if not found:
        raise AssetError("there is no <link> in it", where=composed.root.where)
    collisions = tuple(
        Collision(link, element, place_in(places, link, element))
        for link in found.values()
        for element in link.element.each("collision")
    )
    return Links(found, collisions, places)


def place_in(places: Places, link: Link, element: Element) -> Pose:
    """root_T_element of something in a link, whose pose counts from the link or from a frame of its model."""
    at = pose_of(element, link.where)
    if not at.base or (link.scope.version < RELATIVE and not link.scope.has(at.base)):
        return link.pose @ at.pose
    scope = link.scope
    while at.base == MODEL and scope.merged and scope.frame is not None:  # as libsdformat has it
        scope = scope.frame.scope
    return places.pose_of(scope, at.base, f"{link.where}:{at.line}") @ at.pose


def _links(composed: Composed, places: Places) -> Iterator[Link]:
    for scope in composed.scopes():
        for name, element in scope.links.items():
            pose = places.pose_of(scope, name, f"{scope.where}:{element.line}")
            yield Link(f"{scope.prefix}{name}", scope, name, element, pose)
