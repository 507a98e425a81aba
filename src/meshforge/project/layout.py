"""Where each thing lies in a project folder."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from meshforge.batch import SETTINGS, STATE
from meshforge.preparation import RECORD


@dataclass(frozen=True, slots=True)
class Layout:
    """The paths of a project; those of one asset mirror its id."""

    folder: Path

    def labels(self, asset: str) -> Path:
        return self.folder / "labels" / f"{asset}.json"

    def demonstration(self, asset: str) -> Path:
        return self.folder / "demonstrations" / f"{asset}.json"

    def corrections(self, asset: str) -> Path:
        return self.folder / "corrections" / f"{asset}.json"

    def preparation(self, asset: str) -> Path:
        """The folder of what is done to an asset before the program."""
        return self.folder / "prepared" / asset

    @property
    def settings(self) -> Path:
        """What the project is about, as its owner writes it."""
        return self.folder / SETTINGS

    @property
    def templates(self) -> tuple[Path, Path]:
        """Where templates are looked for: beside the program, then in their folder."""
        return self.folder, self.folder / "templates"

    @property
    def program(self) -> Path:
        return self.folder / "program.mf"

    @property
    def answers(self) -> Path:
        """What a person said while the program was learned."""
        return self.folder / "answers.json"

    @property
    def questions(self) -> Path:
        """Pictures of the question that is being asked."""
        return self.folder / STATE / "questions"

    @property
    def learned(self) -> Path:
        """What the program was learned from."""
        return self.folder / STATE / "learned.json"

    @property
    def review(self) -> Path:
        return self.folder / "review.json"

    @property
    def edited(self) -> Path:
        return self.folder / "edited"

    @property
    def lock(self) -> Path:
        return self.folder / STATE / "lock"

    @property
    def survey(self) -> Path:
        """What is known of the asset files, so that they are not read again for a status."""
        return self.folder / STATE / "survey.json"

    @property
    def sketches(self) -> Path:
        """How the hulls of assets are described, so that labels are soon carried over again."""
        return self.folder / STATE / "sketches"

    @property
    def vlm(self) -> Path:
        """What was sent to models, and what came back."""
        return self.folder / STATE / "vlm"

    def ids_with(self, kind: str) -> tuple[str, ...]:
        """The ids of all assets that have a file in `labels`, `demonstrations` or `corrections`, sorted."""
        root = self.folder / kind
        return tuple(sorted(path.relative_to(root).as_posix().removesuffix(".json") for path in root.rglob("*.json")))

    def ids_with_preparation(self) -> tuple[str, ...]:
        """The ids of all assets that have a preparation, sorted."""
        root = self.folder / "prepared"
        return tuple(sorted(path.parent.relative_to(root).as_posix() for path in root.rglob(RECORD)))
