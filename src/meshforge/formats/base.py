"""What a format is: a reader and a writer of assets, the output it makes, and what that output loses."""

import os
from abc import ABC, abstractmethod
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, ClassVar, Literal, Protocol, Self, runtime_checkable

from meshforge.common import AssetError, CollisionLossError, join_names, pluralize
from meshforge.symbolic import Asset, Feature, FeatureKind, Surface

_PATHS = (
    "ROS_PACKAGE_PATH",
    "GZ_SIM_RESOURCE_PATH",
    "IGN_GAZEBO_RESOURCE_PATH",
    "SDF_PATH",
    "GAZEBO_MODEL_PATH",
    "GAZEBO_RESOURCE_PATH",
)
BODY_FEATURES = frozenset(
    {
        *(FeatureKind.NAMES, FeatureKind.BODIES, FeatureKind.BOXES, FeatureKind.SPHERES, FeatureKind.CYLINDERS),
        *(FeatureKind.MASSES, FeatureKind.VISUALS, FeatureKind.COLORS),
    }
)
"""What every format with bodies holds."""
Mass = Literal["keep", "recompute"]
"""Whether an edited body keeps the mass and inertia it had, or has those of its hulls, where a format derives them."""
Collision = Literal["beside", "replace"]
"""Where the hulls of a scene go in which nothing is marked as collision: beside what is seen, or in its place."""


@dataclass(frozen=True, slots=True)
class Loss:
    """Things of one kind that are not in the output as they were.

    why: the reason, a clause; instead: how they are there all the same (`written as triangles`), None where they are
    not; unnamed: how many there are that have no name.
    """

    kind: FeatureKind
    names: tuple[str, ...]
    why: str
    instead: str | None = None
    unnamed: int = 0

    @property
    def count(self) -> int:
        return len(self.names) + self.unnamed

    def __str__(self) -> str:
        shown = 3 if self.kind is not FeatureKind.OTHERS else len(self.names)
        named = f" ({join_names(self.names, shown)})" if self.names else ""
        verb = "is" if self.count == 1 else "are"
        head = f"{pluralize(self.count, self.kind.one, self.kind.many)}{named}"
        return f"{head} {verb} {self.instead or 'left out'}: {self.why}"


@dataclass(frozen=True, slots=True)
class ReadOptions:
    """How to read: roots in which `package://` and `model://` are searched, besides upwards from the file."""

    package_roots: tuple[Path, ...] = ()

    @classmethod
    def from_environment(cls) -> Self:
        """Return the roots that the variables of ROS and Gazebo list: folders, colons between them."""
        listed = [folder for name in _PATHS for folder in os.environ.get(name, "").split(os.pathsep)]
        return cls(tuple(Path(folder) for folder in dict.fromkeys(listed) if folder))


@dataclass(frozen=True, slots=True)
class Output:
    """The files that make up a written asset, before anything is on disk.

    text or bytes of each new file by its path relative to the folder of the main file; copies: files of the
    input, by the same kind of path. `save` puts them on disk atomically.
    notes: what the format could not hold, or holds in another form (a capsule written as a hull mesh).
    names: of geoms that the written file reads back under another name, that name (formats without names).
    lost: by a created output, what it does not hold of an asset beyond what its format never holds.
    hulled: the names by which the file reads non-convex pieces back as the hulls that its engine makes of them.
    """

    main: bytes
    made: dict[str, bytes] = field(default_factory=dict)
    copies: dict[str, Path] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    names: dict[str, str] = field(default_factory=dict)
    lost: tuple[Loss, ...] = ()
    hulled: tuple[str, ...] = ()


@runtime_checkable
class SpecObject(Protocol):
    """A `mujoco.MjSpec`."""

    assets: Any
    modelfiledir: Any
    modelname: Any

    def to_xml(self) -> str:
        """Return its XML."""


@runtime_checkable
class StageObject(Protocol):
    """A `Usd.Stage`."""

    GetRootLayer: Any
    GetUsedLayers: Any
    GetSessionLayer: Any
    Flatten: Any


class Format(ABC):
    """One file format: reads an asset with its source document, writes it back with edited geoms.

    is_description: its files name mesh files, which are parts of it then and no assets of their own.
    is_folder: its assets are folders; then an output has no main file, and its paths are relative to the folder.
    writable: whether it can hold an edit, or what another format held.
    title: its name for people; up: the axis that points up in its files, None where the format does not say.
    holds: what `create` takes over from other formats, besides hulls; instead: how it writes what it does not take over
    (`written as triangles`).
    shown_files: suffixes of mesh files of visuals that go along as they are, and are shown with their materials.
    has_pictures: whether visuals are written with the pictures that are their base colours.
    """

    name: ClassVar[str]
    suffixes: ClassVar[tuple[str, ...]]
    is_description: ClassVar[bool] = False
    is_folder: ClassVar[bool] = False
    writable: ClassVar[bool] = True
    title: ClassVar[str]
    up: ClassVar[Literal["y", "z"] | None] = None
    holds: ClassVar[frozenset[FeatureKind]] = frozenset()
    instead: ClassVar[Mapping[FeatureKind, str]] = {}
    shown_files: ClassVar[tuple[str, ...]] = ()
    has_pictures: ClassVar[bool] = False

    @abstractmethod
    def read(self, path: Path, options: ReadOptions) -> Asset:
        """Return the asset in a file. Raises AssetError naming the file, what is wrong, and the remedy."""

    @abstractmethod
    def write(self, asset: Asset, name: str, mass: Mass = "keep") -> Output:
        """Return the files of an asset that was read by this format, main file named `name`.

        Geoms without a parent are written as authored; geoms of the source that are gone are removed; the others
        are new elements, which inherit the contact attributes of their parent.
        mass: for formats that derive the masses of bodies from their geoms.
        Raises AssetError where the file cannot hold the edit.
        """

    def can_write_back(self, asset: Asset) -> bool:
        """Return whether an asset was read from a file of this kind, so that `write` writes it back."""
        return asset.format == self.name

    def create(self, asset: Asset, name: str) -> Output:
        """Return the files of an asset that came from another format, as far as this one holds it."""
        raise self._creation_error(asset)

    def _creation_error(self, asset: Asset) -> Exception:
        return AssetError(f"{self.name} files cannot be made from {asset.format} files", where=str(asset.path))

    def output_name(self, name: str) -> str:
        """Return the name of the file that an edited asset is written to, by that of the file it was read from."""
        return name

    def features(self, asset: Asset) -> Iterable[Feature]:
        """Return what the document of an asset of this format holds that the asset itself does not tell."""
        return ()

    def top(self, asset: Asset) -> Path:
        """Return the highest folder that the references of an asset pass, from that of its file upwards."""
        return asset.path.parent

    def is_main(self, path: Path) -> bool:
        """Return whether a file of this format is an asset of its own, not a stand-in for one in older programs."""
        return True

    def matches_head(self, head: bytes) -> bool:
        """Return whether a file of one of the suffixes may be an asset of this format; head: its first kilobytes."""
        return True


class SceneFormat(Format):
    """A format of scenes, in which collision is marked or not: in an unmarked scene, all that is seen is taken for it.

    marks: how a written file says what collides, for notes.
    """

    marks: ClassVar[str]

    @abstractmethod
    def is_unmarked(self, asset: Asset) -> bool:
        """Return whether an asset of this format was read from a scene in which nothing is marked as collision."""

    @abstractmethod
    def is_edited(self, asset: Asset) -> bool:
        """Return whether the hulls of an asset of this format are not those of its file."""

    @abstractmethod
    def surfaces_of(self, asset: Asset) -> Sequence[Surface]:
        """Return what an unmarked scene shows, as it was read."""

    @abstractmethod
    def add_colliders(self, asset: Asset, name: str) -> Output:
        """Return the files of an unmarked scene, all of it as it is, with the hulls of the asset beside it, marked.

        They read back as the hulls of the asset, and what was taken for them is only seen. Raises AssetError where a
        file of the scene has changed, or there is no hull.
        """


def feature_of_others(kinds: Iterable[str]) -> Feature:
    """Return the feature of elements that no conversion takes: each kind is named once."""
    return Feature.of(FeatureKind.OTHERS, kinds)


def list_others(top: Any, taken: Collection[str], leaves: Collection[str]) -> Iterator[str]:
    """Yield the tags below an XML element that a conversion does not take; `leaves` are taken with all inside."""
    waiting = [top]
    while waiting:
        for child in waiting.pop().children:
            if child.tag in taken:
                waiting.append(child)
            elif child.tag not in leaves:
                yield child.tag


def note_renames(names: Mapping[str, str]) -> tuple[str, ...]:
    """Return a note on hulls that the file holds under other names."""
    if not names:
        return ()
    shown = join_names([f"{old} is now {new}" for old, new in names.items()], 3)
    return (f"hulls are called otherwise in what is written: {shown}",)


def note_shapes_as_hulls(kinds: Iterable[str], why: str) -> list[str]:
    """Return notes on shapes of some kinds, named once each, that are written as hulls; why: `{}` in it is the kind."""
    counts = sorted(Counter(kinds).items())
    return [f"{pluralize(number, kind)} written as hull meshes: {why.format(kind)}" for kind, number in counts]


def nothing_collides_error(asset: Asset) -> AssetError:
    """Return the error on an asset of which nothing that collides can be written."""
    problem, where = "there is no hull to write", str(asset.path)
    if not asset.non_convex:
        return AssetError(problem, where=where)
    remedy = "Make hulls of each: convert --concave decompose, or hull for one; or prepare PROJECT --decompose."
    names = join_names([piece.name for piece in asset.non_convex], 3)
    problem = f"{problem}: {names} cannot collide there without being convex"
    return CollisionLossError(problem, where=where, remedy=remedy if any(p.surface for p in asset.non_convex) else None)
