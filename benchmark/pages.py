"""The pages of results: which parts each has, and how it opens."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from benchmark.report import Result, as_text


@dataclass(frozen=True, slots=True)
class Page:
    """A page, named as the folder of its parts is.

    parts: those of a whole run; aside: those that run only when they are named; packages: whose versions matter;
    given: the parts that take what is given on the command line besides.
    """

    name: str
    head: str
    parts: tuple[str, ...]
    packages: tuple[str, ...]
    aside: tuple[str, ...] = ()
    given: tuple[str, ...] = ()

    @property
    def all_parts(self) -> tuple[str, ...]:
        return (*self.parts, *self.aside)


PAGES = (
    Page(
        "speed",
        "# Speed\n\nWritten by `script/bench` from the JSON files beside it. Medians; contestants take turns.\n",
        ("contact", "load", "robots", "save", "apply", "geometry", "start", "commands"),
        ("numpy", "scipy", "coal", "manifold3d", "trimesh", "python-fcl", "pybullet", "mujoco"),
    ),
    Page(
        "learning",
        "# Learning\n\nWritten by `script/bench` from the JSON files beside it. All draws are seeded: but for the "
        "times, every run gives the same figures.\n",
        ("search", "growth", "asking", "repairs"),
        ("numpy", "scipy", "coal", "cvc5"),
        aside=("calibrate",),
    ),
    Page(
        "evaluation",
        "",
        (
            "ceiling",
            "mutation",
            "calibration",
            "effectiveness",
            "real",
            "comparison",
            "ablation",
            "correction",
            "contest",
            "scaling",
            "gallery",
        ),
        ("numpy", "scipy", "coal", "coacd", "manifold3d", "mujoco", "cvc5"),
        aside=("tuning",),
        given=("comparison",),
    ),
    Page(
        "signoff",
        "# Families signed off\n\nWritten by `script/bench` from the JSON beside it. Every run gives the same, but for "
        "times of the computer. A person's seconds are modelled by keystrokes, at prices fixed beforehand.\n",
        ("review", "real_families", "terminal_sessions", "product_before", "lessons", "orientation", "posterior"),
        ("numpy", "scipy", "coal", "mujoco"),
    ),
    Page(
        "checks",
        "# Checks and goals\n\nWritten by `script/bench` from the JSON beside it. Every run gives the same.\n",
        ("goals", "evidence", "defects", "pairs", "engine_shapes", "referees"),
        ("numpy", "scipy", "mujoco"),
    ),
    Page(
        "labels",
        "# Labels\n\nWritten by `script/bench` from the JSON beside it. Every run gives the same, but for times.\n",
        ("propagation", "confidence", "transfer", "labellers", "scale"),
        ("numpy", "scipy"),
        given=("labellers",),
    ),
    Page(
        "spanning",
        "# Hulls that span parts\n\nWritten by `script/bench` from the JSON beside it. Every run gives the same, but "
        "for times.\n",
        ("detection", "alarms", "edits", "costs", "real_assets", "programs"),
        ("numpy", "scipy", "coacd", "manifold3d", "mujoco"),
    ),
    Page(
        "batch",
        "# Very many assets\n\nWritten by `script/bench` from the JSON beside it.\n",
        (),
        ("pebble", "numpy"),
        aside=("many",),
    ),
    Page(
        "studio",
        "# The studio\n\nWritten by `script/bench` from the JSON files beside it, measured in a real Chromium.\n",
        ("opening", "moving", "relearning", "replies", "scrolling", "thousands"),
        ("fastapi", "uvicorn", "playwright"),
    ),
)


def page_of(part: str) -> Page:
    """The page that a part is on."""
    return next(page for page in PAGES if part in page.all_parts)


def parts_of(names: Sequence[str]) -> tuple[str, ...]:
    """The parts that names of parts and of pages mean; a page's are those of a run. Without any, those of all pages.

    Raises KeyError for a name that is neither.
    """
    known = {part: (part,) for page in PAGES for part in page.all_parts} | {page.name: page.parts for page in PAGES}
    return tuple(dict.fromkeys(part for name in names or [page.name for page in PAGES] for part in known[name]))


def text_of(page: Page, results: Sequence[Mapping[str, Any]], pictures: str = "") -> str:
    """The page on some results; pictures: Markdown that shows them, after all else."""
    listed = "Machine: " + ", ".join(f"{name} {value}" for name, value in results[-1]["machine"].items()) + ".\n"
    quick = "**A quick run: few files, one round.**\n" if any(result["quick"] for result in results) else ""
    return "\n".join(filter(None, [page.head, listed, quick, *(as_text(Result.of_json(r)) for r in results), pictures]))
