"""The format MJCF as the registry has it; MJCF in memory: text, and `mujoco.MjSpec`, read like files of a folder."""

import os
import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from meshforge.common import AssetError, is_file, plain_path, require_mujoco
from meshforge.formats import base
from meshforge.formats.libraries import make_folder, mujoco
from meshforge.formats.mjcf.document import MjcfDocument, read_tree
from meshforge.symbolic import Asset, Feature, FeatureKind

_ROOT = re.compile(r"(?>[^<]*(?:<(?>\?.*?\?>|!--.*?-->|![^-][^>]*>)[^<]*)*)<([\w:.-]+)", re.S)
"""An XML text up to the tag of its first element. Atomic groups: possessive ones fail in Python 3.11.2."""

_TAKEN = ("worldbody", "asset", "body", "frame", "replicate", "contact")
_LEAVES = (
    *("compiler", "default", "geom", "joint", "freejoint", "inertial", "mesh", "model", "attach", "include", "exclude"),
    "equality",  # of which couplings of joints are taken, see below
)
_CONTACT = ("contype", "conaffinity", "condim", "friction", "solref", "solimp", "solmix", "margin", "gap", "priority")
_DYNAMICS = ("stiffness", "springref", "springdamper", "springlength", "armature")


class MjcfFormat(base.Format):
    """MuJoCo's own format for models."""

    name = "mjcf"
    suffixes = (".xml", ".mjcf")
    is_description = True
    title = "MJCF"
    up = "z"
    holds = base.BODY_FEATURES | {
        *(FeatureKind.CAPSULES, FeatureKind.ELLIPSOIDS, FeatureKind.PLANES, FeatureKind.NON_CONVEX),
        *(FeatureKind.JOINTS, FeatureKind.BALL_JOINTS, FeatureKind.MIMICS, FeatureKind.PAIRS),
    }

    def matches_head(self, head: bytes) -> bool:
        root = _ROOT.match(head.decode("utf-8", "replace").replace("\0", ""))
        return root is None or root[1].lower() == "mujoco"

    def read(self, path: Path, options: base.ReadOptions) -> Asset:
        require_mujoco("an MJCF", str(path))
        from meshforge.formats.mjcf import read  # lazy: only MJCF needs it

        return read.read_mjcf(path)

    def write(self, asset: Asset, name: str, mass: base.Mass = "keep") -> base.Output:
        if not isinstance(asset.document, MjcfDocument):
            raise AssetError("this asset was not read from an MJCF", where=str(asset.path))
        require_mujoco("an MJCF", str(asset.path))
        from meshforge.formats.mjcf import edit  # lazy: only MJCF needs it

        return edit.write_mjcf(asset, asset.document, name, mass)

    def create(self, asset: Asset, name: str) -> base.Output:
        from meshforge.formats.mjcf import create  # lazy: only MJCF needs it

        return create.MjcfCreator(asset, Path(name).stem).build_output()

    def top(self, asset: Asset) -> Path:
        if not isinstance(asset.document, MjcfDocument):
            return super().top(asset)
        from meshforge.formats.mjcf import references  # lazy: only MJCF needs it

        return references.top_folder(asset.document)

    def features(self, asset: Asset) -> Iterable[Feature]:
        return _features_of(asset.document) if isinstance(asset.document, MjcfDocument) else ()


def _features_of(document: MjcfDocument) -> Iterator[Feature]:
    """The features of an MJCF that its asset does not have; those that classes set count once."""
    root = document.tree.root
    others = [*base.list_others(root, _TAKEN, _LEAVES)]
    constraints = [child for node in root.each("equality") for child in node.children]
    coupled = [c.attributes.get("joint1") for c in constraints if c.is_coupling]
    others += [f"equality {c.tag}" for c in constraints if not c.is_coupling]
    others += ["second coupling of a joint"] * (len(coupled) - len(set(coupled)))
    for kind, tag, keys in (("contact setting", "geom", _CONTACT), ("spring or armature", "joint", _DYNAMICS)):
        others += [kind for node in root.walk() if node.tag == tag and any(key in node.attributes for key in keys)]
    others += ["comment"] * sum(source.raw.count(b"<!--") for source in document.sources)
    yield base.feature_of_others(others)


def read_text(text: str) -> Asset:
    """Return the asset in the text of an MJCF; its references count from the current folder. Raises AssetError."""
    from meshforge.formats.mjcf.read import read_mjcf  # lazy: only MJCF needs it

    path = Path.cwd() / "text.xml"
    return read_mjcf(path, {path: text.encode()})


def read_spec(spec: base.SpecObject) -> Asset:
    """Return the asset in a spec, as its XML says it.

    References count from the folder that the spec was read from. Files that it holds in memory are put into a folder
    that lasts as long as this process, together with those on disk. Raises AssetError.
    """
    from meshforge.formats.mjcf.read import read_mjcf  # lazy: only MJCF needs it

    name = f"{Path(str(spec.modelname or 'spec')).name}.xml"
    folder = plain_path(Path(str(spec.modelfiledir or "")).absolute())
    try:
        text = spec.to_xml().encode()
    except (ValueError, RuntimeError, mujoco.FatalError, mujoco.UnexpectedError) as error:
        raise AssetError(f"MuJoCo cannot write this spec: {error}", where=name) from error
    files_of_spec = {str(key): bytes(data) for key, data in dict(spec.assets or {}).items()}
    if not files_of_spec:
        return read_mjcf(folder / name, {folder / name: text})
    home = make_folder()
    (home / name).write_bytes(text)
    for path, data in _gather_files(folder / name, text, files_of_spec):
        target = home / (path.relative_to(folder) if path.is_relative_to(folder) else path.name)
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(data)
    return read_mjcf(home / name)


def _gather_files(main: Path, text: bytes, files_of_spec: dict[str, bytes]) -> Iterator[tuple[Path, bytes]]:
    """The files that a text refers to: those that the spec holds, under its names for them, before those on disk."""
    from meshforge.formats.mjcf.references import list_references  # lazy: only MJCF needs it

    for reference in list_references(read_tree(main, {main: text})):
        path = reference.path
        below = path.relative_to(main.parent).as_posix() if path.is_relative_to(main.parent) else path.name
        names = (key for key in (reference.text, below, path.name, str(path)) if key in files_of_spec)
        if (key := next(names, None)) is not None or is_file(path):
            yield path, files_of_spec[key] if key is not None else path.read_bytes()


def build_spec(output: base.Output) -> Any:
    """Return the spec of an output, which holds all of its files. Raises AssetError where MuJoCo refuses it."""
    files = {name: path.read_bytes() for name, path in output.copies.items()} | output.made
    files = {os.path.normpath(name): data for name, data in files.items()}
    included = {name: data for name, data in files.items() if name.endswith((".xml", ".mjcf"))}
    assets = {name: data for name, data in files.items() if name not in included}
    try:
        return mujoco.MjSpec.from_string(output.main.decode(), include=included, assets=assets)
    except (ValueError, RuntimeError, mujoco.FatalError, mujoco.UnexpectedError) as error:
        raise AssetError(f"MuJoCo refuses it: {' '.join(str(error).split())}") from error
