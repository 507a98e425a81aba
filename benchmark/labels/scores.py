"""How a labeller does on the drawn meshes, and how far its repeats agree."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from benchmark.labels.families import Family
from benchmark.labels.methods import LabellerOutput, Labels, Method
from benchmark.labels.metric import PURE

_Bools = npt.NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Score:
    """A labeller on the drawn meshes of all families. right: of each hull, in each repeat (repeats, hulls).

    said: what it says of each hull, likewise, empty for nothing; pure: whether a hull is of one part; mesh: whose it
    is; known: whether what was said is a label that there is to choose from (repeats, hulls).
    """

    name: str
    right: _Bools
    said: npt.NDArray[np.str_]
    known: _Bools
    pure: _Bools
    mesh: npt.NDArray[np.int64]
    category: npt.NDArray[np.str_]
    seconds: float
    cost: float | None
    missing: int
    why: str

    @property
    def meshes(self) -> int:
        return int(self.mesh[-1]) + 1

    @property
    def accuracy(self) -> float:
        """The share of hulls with the right label, none and wrong words counted as wrong; of the first repeat."""
        return float(self.right[0].mean())

    @property
    def accuracy_pure(self) -> float:
        """The same of hulls that are of one part."""
        return float(self.right[0][self.pure].mean())

    @property
    def unlabelled(self) -> float:
        """The share of hulls without a label."""
        return float((self.said[0] == "").mean())

    @property
    def foreign(self) -> float:
        """The share of hulls with a word that is not in the vocabulary."""
        return float(((self.said[0] != "") & ~self.known[0]).mean())

    @property
    def agreement(self) -> float | None:
        """The share of hulls of which all repeats say the same; None where there is one."""
        return float((self.said == self.said[0]).all(axis=0).mean()) if len(self.said) > 1 else None

    @property
    def friedman(self) -> float | None:
        """The p of a Friedman test whether some repeat is better than others, mesh by mesh (paper).

        None for fewer than three repeats or meshes, and where no repeat differs from another on any mesh.
        """
        from scipy.stats import friedmanchisquare

        shares = [np.bincount(self.mesh, row) / np.bincount(self.mesh) for row in self.right]
        if len(shares) < 3 or len(shares[0]) < 3 or all(np.array_equal(row, shares[0]) for row in shares):
            return None
        return float(friedmanchisquare(*shares).pvalue)

    def of(self, category: str) -> float:
        """The accuracy on a category."""
        return float(self.right[0][self.category == category].mean())


def score_labels(method: Method, families: Sequence[Family], told: Sequence[Sequence[LabellerOutput]]) -> Score:
    """What a method said of the families, repeat by repeat, held against the truth."""
    hulls = [hull.label or "" for family in families for k in family.drawn for hull in family.samples[k].mesh.hulls]
    truth, said = np.array(hulls), np.array([[word or "" for word in _words(row)] for row in told])
    sizes = [len(family.samples[k].mesh.hulls) for family in families for k in family.drawn]
    counts = [sum(len(family.samples[k].mesh.hulls) for k in family.drawn) for family in families]
    purities = [purity for family in families for k in family.drawn for purity in family.samples[k].purities]
    known = [
        np.isin(part, family.vocabulary)
        for family, part in zip(families, np.split(said, np.cumsum(counts)[:-1], axis=1), strict=True)
    ]
    first = told[0]
    costs = [one.cost for one in first]
    every = [one for row in told for one in row]
    return Score(
        method.name,
        said == truth,
        said,
        np.concatenate(known, axis=1),
        np.array(purities) >= PURE,
        np.repeat(np.arange(len(sizes)), sizes),
        np.repeat([family.name for family in families], counts),
        sum(one.seconds for one in first),
        None if None in costs else sum(cost or 0.0 for cost in costs),
        sum(one.missing for one in every),
        next((one.why for one in every if one.missing), ""),
    )


def _words(row: Sequence[LabellerOutput]) -> list[str | None]:
    labels: list[Labels] = [mesh for one in row for mesh in one.labels]
    return [word for mesh in labels for word in mesh]
