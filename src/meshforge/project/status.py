"""How far a project is: each asset, the program, what is stale, and the next sensible step, as commands name it."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any, Literal

from meshforge import labels, rendering, symbolic
from meshforge.common import quote_path
from meshforge.signoff import THRESHOLD, ResultStatus

StepKind = Literal[
    "wait",
    "decompose",
    "label-all",
    "label",
    "check-labels",
    "demonstrate",
    "learn",
    "answer",
    "fix-program",
    "apply",
    "review",
    "correct",
    "export",
]


@dataclass(frozen=True, slots=True)
class NextStep:
    """What to do next, in words. asset: the one to open; command: what to type; note: what helps to type it."""

    kind: StepKind
    text: str
    asset: str | None = None
    command: str | None = None
    note: str | None = None


Done = Literal["made", "demonstrated", "forgot", "learned", "left open", "signed off", "prepared", "prepared all"]
"""What a command did: it learned a program, or left a question open; it prepared assets beside a program, or all that
there is to do without one."""
_AFTER: Mapping[Done, tuple[str, str]] = {
    "made": ("status", ""),
    "demonstrated": ("synthesize", ""),
    "forgot": ("synthesize", ""),
    "learned": ("apply", ""),
    "left open": ("review", ""),
    "signed off": ("apply", ""),
    "prepared": ("apply", " runs the program on it"),
    "prepared all": ("apply", " writes what is prepared, also without a program"),
}


def format_next(done: Done, folder: str | Path) -> str:
    """Return the line by which a command names the one that follows it, without a look at the whole family."""
    command, what = _AFTER[done]
    return f"Next: meshforge {command} {quote_path(Path(folder))}{what}"


def format_step(step: NextStep) -> str:
    """Return the step that is chosen for a whole family, with what to type."""
    lines = (step.command, *(step.note or "").splitlines())
    return "\n  ".join([f"Next: {step.text}", *(line for line in lines if line)])


OutputState = Literal["none", "edited", "unchanged", "failed"]
LearnStatus = Literal["found", "ambiguous", "repair", "none", "timeout", "error"]
SOURCE_WORDS: dict[str, str] = {
    "user": "people", "repair": "people, repairs confirmed", "file": "files", "name": "names",
    "propagated": "propagation", "like": "another family", "step": "steps shown", "class": "likeness to steps shown",
    "rebuild": "rebuilt bodies", "vlm": "a model", "edit": "edits", "plugin": "plug-ins",
}  # fmt: skip
"""Where labels of each source are from."""
NO_LABEL, GIVEN = -1, 101
"""In `AssetStatus.confidence`: of a hull without a label; of a label that a person, a file or a name gave."""
_HALF, _ROUNDING = 50, 1e-6  # 0.29 is 29 percent, and what is below one half stays below it


@dataclass(frozen=True, slots=True)
class AssetStatus:
    """One asset. hulls: how many, None where it cannot be read; labelled: how many of them have a label.

    output: what the last `apply` made; stale: what changed since then (`asset`, `labels`, `program`, ...), or `output`
    where written files changed or are gone. error: why it cannot be read, or why it failed.
    doubtful: labelled hulls that are gone, or have another geometry than was labelled.
    prepared: what was done to it before the program; sources: pieces and bodies without hulls that can be decomposed.
    flags: edits by hand that were left out, demonstrated hulls that are no more; review, review_note: what a person
    said about the output as it is.
    names, labels: of the hulls, in the asset's order; geometry: the digest of names and shapes of all hulls, empty
    where it cannot be read. after, after_labels, output_digest: hulls of the output, the label of each where that is
    known, and its files; corrections: edits by hand, a number.
    result_status: whether it is signed off, and how sure its edit is as of the last review where nothing changed since.
    """

    id: str
    hulls: int | None
    labelled: int = 0
    doubtful: tuple[str, ...] = ()
    demonstrated: bool = False
    output: OutputState = "none"
    stale: tuple[str, ...] = ()
    error: str | None = None
    flags: tuple[str, ...] = ()
    review: Literal["accepted", "wrong"] | None = None
    prepared: tuple[str, ...] = ()
    sources: int = 0
    names: tuple[str, ...] = ()
    labels: tuple[symbolic.Label | None, ...] = ()
    geometry: str = ""
    after: int | None = None
    after_labels: tuple[str | None, ...] = ()
    output_digest: str | None = None
    manual_edits: int = 0
    review_note: str | None = None
    result_status: ResultStatus = field(default_factory=ResultStatus)

    @property
    def confidence(self) -> tuple[int, ...]:
        """To how many percent each label is sure, not at all where it was given to another geometry; see `GIVEN`."""
        rows = zip(self.names, self.labels, strict=True)
        return tuple(0 if name in self.doubtful else _percent_of(label) for name, label in rows)

    @property
    def unsure(self) -> int:
        """How many labels are not sure, or were given to another geometry."""
        return sum(NO_LABEL < sure < _HALF for sure in self.confidence)

    @property
    def is_done(self) -> bool:
        """Whether its output is there and up to date."""
        return self.output in ("edited", "unchanged") and not self.stale

    def to_json(self) -> dict[str, Any]:
        """Return it as `status` says it in JSON."""
        names = (
            *("hulls", "sources", "prepared", "labelled", "doubtful", "demonstrated", "output", "stale", "error"),
            *("flags", "review"),
        )
        status = self.result_status
        return {
            "asset": self.id,
            **{name: getattr(self, name) for name in names},
            "sign_off": status.state,
            "signed_by": status.by,
            "void": status.void,
            "excluded": status.excluded,
            "found_since": status.found_since,
            **status.to_json(),
        }


def _percent_of(label: symbolic.Label | None) -> int:
    if label is None:
        return NO_LABEL
    return GIVEN if rendering.look_of(label) == "given" else int(100 * label.confidence + _ROUNDING)


@dataclass(frozen=True, slots=True)
class PropagationState:
    """The last propagation of labels. unused: how many labels people and files gave since; next: the asset that would
    help most if it were labelled, null where it is labelled by now, or where all are."""

    unused: int
    next: str | None = None


@dataclass(frozen=True, slots=True)
class LastRun:
    """The last learning run of this session. repairs: how many labels are probably wrong; nearest: the rule that
    nothing fits, and an asset that shows what comes nearest."""

    status: LearnStatus
    repairs: int = 0
    nearest: tuple[int, str] | None = None


@dataclass(frozen=True, slots=True)
class OpenQuestion:
    """The question that is worth most; about: what it is about, in words."""

    kind: Literal["result", "demonstrate", "other"]
    asset: str
    about: str = ""


@dataclass(frozen=True, slots=True)
class FamilyState:
    """All that the next step of a project depends on.

    has_program, asks_labels: whether there is one, and it selects by labels; outdated: whether it was learned from
    other labels, demonstrations, replies or settings than there are now; problem: why it cannot be applied;
    suggest_first: which of some assets, by id, is to be demonstrated first; find_offers: labels in files and names.
    is_judged: whether nothing is being learned, and it is known how sure the results are; shown: the step that a page
    shows; has_replies: whether people said anything of results or questions, as all do who use commands; running: the
    titles of jobs, by the kinds of steps that they do.
    """

    folder: Path
    assets: Sequence[AssetStatus]
    vocabulary: Sequence[str]
    has_program: bool = False
    asks_labels: bool = False
    outdated: bool = False
    problem: str | None = None
    question: OpenQuestion | None = None
    last_run: LastRun | None = None
    propagation: PropagationState | None = None
    is_judged: bool = True
    shown: NextStep | None = None
    has_replies: bool = True
    running: Mapping[StepKind, str] = field(default_factory=dict)
    suggest_first: Callable[[Sequence[str]], str | None] = field(default=lambda assets: None)
    find_offers: Callable[[], labels.LabelOffers] = field(default=lambda: labels.LabelOffers())

    @property
    def is_begun(self) -> bool:
        """Whether there is a program, or something is demonstrated for one."""
        return self.has_program or bool(self.problem) or any(asset.demonstrated for asset in self.assets)


@dataclass(frozen=True, slots=True)
class Status:
    """A project. assets: all, or those that were asked for. rules: of the program, None where there is none.

    outdated: whether it was learned from other demonstrations, labels, replies or settings than there are now.
    problem: why the program cannot be applied at all.

    lost: ids that have labels, demonstrations or corrections, but no asset; not_of_family: those of assets that are
    excluded as not of the family.
    family: all that the next step depends on; question: the id of the one that was open when the program was learned.
    """

    name: str
    assets: tuple[AssetStatus, ...]
    vocabulary: tuple[str, ...]
    rules: int | None
    outdated: bool
    problem: str | None
    lost: tuple[str, ...]
    not_of_family: tuple[str, ...]
    next: NextStep
    family: FamilyState = field(compare=False)
    question: str | None = None
    threshold: float = THRESHOLD

    @property
    def open_assets(self) -> tuple[AssetStatus, ...]:
        """Those to be looked at: neither sure enough nor excluded, the least probable first."""
        some = [asset for asset in self.assets if asset.result_status.needs_review]
        return tuple(sorted(some, key=lambda asset: (asset.result_status.confidence, asset.id)))

    @property
    def is_signed_off(self) -> bool:
        """Whether every asset of the family is signed off, and there is one; no goal is open."""
        states = {asset.result_status.state for asset in self.assets}
        return states == {"signed off"} and not self.with_open_goals

    @property
    def is_signed_off_but_unsolved(self) -> bool:
        """Whether every asset of the family is signed off or given up, and some are signed off."""
        states = {asset.result_status.state for asset in self.assets}
        return "signed off" in states and states <= {"signed off", "excluded"} and not self.with_open_goals

    @property
    def with_open_goals(self) -> tuple[AssetStatus, ...]:
        """Those on which a goal fails that nobody accepted, or was not tried."""
        return tuple(asset for asset in self.assets if asset.result_status.open_goals)

    def count(self, holds: Callable[[AssetStatus], bool]) -> int:
        """Return how many assets a condition holds for."""
        return sum(map(holds, self.assets))

    def to_json(self) -> dict[str, Any]:
        """Return the status for scripts."""
        return {
            "name": self.name,
            "vocabulary": list(self.vocabulary),
            "rules": self.rules,
            "outdated": self.outdated,
            "question": self.question,
            "problem": self.problem,
            "signed_off": self.count(lambda asset: asset.result_status.state == "signed off"),
            "assets": [asset.to_json() for asset in self.assets],
            "lost": list(self.lost),
            "not_of_family": list(self.not_of_family),
            "next": asdict(self.next),
        }
