"""The next sensible step in a project, as a sentence and a command that can be typed as it is."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from meshforge import labels
from meshforge.common import pluralize, quote_path
from meshforge.project.learn import ProgramState
from meshforge.project.status import Advice, AssetStatus
from meshforge.store import Layout


@dataclass(frozen=True, slots=True)
class Adviser:
    """Finds what to do next in a project. paths: of the assets by id; rules: of the program, None where there is none.

    asks_labels: whether it selects by labels; problem: why the program cannot be applied; first: which of some assets,
    by id, is to be demonstrated first; count_names: how many hulls without a label have names that say one.
    """

    folder: Path
    paths: Mapping[str, Path]
    assets: Sequence[AssetStatus]
    vocabulary: Sequence[str]
    rules: int | None
    asks_labels: bool
    state: ProgramState
    problem: str | None
    first: Callable[[Sequence[str]], str | None]
    count_names: Callable[[], int]

    def advise(self) -> Advice:
        """The first thing that is missing on the way from assets to results that are signed off."""
        if self.problem:
            return Advice(f"The program cannot be applied: {self.problem}")
        found = (
            self._advise_hulls()
            or (self._advise_before_learning() if self.rules is None else None)
            or self._advise_program()
            or (self._advise_new_assets() if self.asks_labels else None)
            or self._advise_output()
            or self._advise_review()
        )
        if self.rules is None and any(asset.prepared and not asset.is_done for asset in self.assets):
            return replace(
                found, say=f"{found.say} Or write what is prepared, without a program ({self._type('apply')})."
            )
        return found

    def _advise_hulls(self) -> Advice | None:
        bare = [asset for asset in self.assets if asset.hulls == 0 and asset.sources]
        if not bare:
            return None
        return Advice(
            f"{_name_assets(bare)} no hulls: decompose what has none.", self._type("prepare --decompose coacd")
        )

    def _advise_before_learning(self) -> Advice | None:
        shown = any(asset.demonstrated for asset in self.assets)
        if not any(asset.labelled for asset in self.assets):
            return None if shown else self._advise_label_source(self.assets)
        bare = [asset for asset in self.assets if asset.hulls and not asset.labelled]
        return (self._advise_labels(bare) if bare else None) or (None if shown else self._advise_demonstration())

    def _advise_new_assets(self) -> Advice | None:
        bare = [asset for asset in self.assets if asset.hulls and not asset.labelled and not asset.is_done]
        if not bare:
            return None
        some = any(asset.labelled for asset in self.assets)
        return self._advise_labels(bare) if some else self._advise_label_source(self.assets)

    def _advise_labels(self, bare: Sequence[AssetStatus]) -> Advice:
        if any(labels.label_file_beside(self.paths[asset.id]) for asset in bare):
            say = f"{_name_assets(bare)} no label: take over the labels files beside the assets."
            return Advice(say, self._type("label --with file"))
        if any(asset.hulls and asset.labelled == asset.hulls for asset in self.assets):
            say = f"{_name_assets(bare)} no label: propagate those of the labelled assets."
            return Advice(say, self._type("label --with propagate"))
        most = max(self.assets, key=lambda asset: asset.labelled)
        hull = next(name for name, label in zip(most.names, most.labels, strict=True) if label is None)
        say = f"{most.labelled} of {pluralize(len(most.names), 'hull')} of {most.id} have a label: label the others."
        return Advice(say, labels.label_command(self.folder, most.id, hull, self.vocabulary))

    def _advise_label_source(self, bare: Sequence[AssetStatus]) -> Advice:
        """Files beside the assets, else names where they say something, else by hand."""
        if any(labels.label_file_beside(self.paths[asset.id]) for asset in bare):
            say = "No hull has a label yet: take over the labels files beside the assets."
            return Advice(say, self._type("label --with file"))
        if count := self.count_names():
            say = f"No hull has a label yet: the names of {pluralize(count, 'hull')} say what they are."
            return Advice(say, self._type("label --with names"))
        counts = sorted(len(asset.names) for asset in self.assets if asset.names)
        if not counts:
            return Advice("No asset has hulls that can be read: fix what the remarks name.")
        usual = next(asset for asset in self.assets if len(asset.names) == counts[(len(counts) - 1) // 2])
        say = (
            f"No hull has a label yet: label those of an asset by hand, best first {usual.id}, here or in the studio "
            f"(names of hulls: meshforge info {quote_path(Path(usual.id))} --project {quote_path(self.folder)})."
        )
        return Advice(say, labels.label_command(self.folder, usual.id, usual.names[0], self.vocabulary))

    def _advise_demonstration(self) -> Advice:
        labelled = [asset.id for asset in self.assets if asset.labelled]
        example = self.first(labelled) or next(iter(labelled or self.paths))
        quoted = quote_path(Path(example))
        return Advice(
            f"Nothing is demonstrated yet: show the steps of the edit on an asset or two, best first on {example} "
            f"(names of hulls: meshforge info {quoted} --project {quote_path(self.folder)}).",
            self._type(f"demonstrate {quoted} 'HULLS => ACTION' ..."),
        )

    def _advise_program(self) -> Advice | None:
        if self.rules is None:
            return Advice("Learn the program from the demonstrations.", self._type("synthesize"))
        if self.state.outdated and not any(asset.demonstrated for asset in self.assets):
            return self._advise_demonstration()
        if self.state.outdated:
            say = "Labels, demonstrations, replies or settings changed since the program was learned: learn it again."
            return Advice(say, self._type("synthesize"))
        if self.state.question and self._behind:  # nobody is asked who has applied the program as it is
            rule, _, asset = self.state.question.partition(":")
            say = f"It is open what rule {rule} does on {asset}: answer the question, or apply the program as it is."
            return Advice(say, self._type("synthesize"))
        return None

    @property
    def _behind(self) -> list[AssetStatus]:
        some = (asset for asset in self.assets if not asset.is_done and not asset.excluded)
        return [asset for asset in some if asset.output != "failed" or asset.stale]

    def _advise_output(self) -> Advice | None:
        behind = self._behind
        readable = [asset for asset in behind if asset.hulls is not None]
        if readable:
            who = f"{behind[0].id} is" if len(behind) == 1 else f"{len(behind)} assets are"
            return Advice(f"Apply the program: {who} not up to date.", self._type("apply"))
        failed = [asset for asset in self.assets if asset.output == "failed" or asset in behind]
        if not failed:
            return None
        some = f"{len(failed)} of {len(self.assets)} assets, first on {failed[0].id}"
        return Advice(f"The program fails on {some}: fix what is named, then apply it again.", self._type("apply"))

    def _advise_review(self) -> Advice:
        """A look at what is not sure, then at what is flagged, then the checks."""
        held = [asset for asset in self.assets if asset.sign_off in ("held", "void", "unknown")]
        if held:
            which = f"{held[0].id} is" if len(held) == 1 else f"{len(held)} of them, first {held[0].id}, are"
            return Advice(f"All assets are edited; {which} not signed off: review them.", self._type("review"))
        odd = [asset.id for asset in self.assets if asset.flags]
        if odd:
            say = f"All assets are edited; {len(odd)} of them want a look, first {odd[0]}: edit them by hand."
            return Advice(say, self._type("studio"))
        edited = quote_path(Layout(self.folder).edited)
        return Advice("All assets are edited and signed off: check them.", f"meshforge check {edited}")

    def _type(self, words: str) -> str:
        """A command on the project as one types it here; words: its name, and what follows the project."""
        command, *more = words.split(" ", 1)
        return " ".join(["meshforge", command, quote_path(self.folder), *more])


def _name_assets(assets: Sequence[AssetStatus]) -> str:
    first = assets[0].id
    return f"{first} has" if len(assets) == 1 else f"{len(assets)} assets, first {first}, have"
