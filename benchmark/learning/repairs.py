"""How often wrong labels are found out, and right ones left alone, on families of boxes with planted errors.

Usage: python -m benchmark.learning.repairs [--seeds 100-104] [--demos 2]
"""

from __future__ import annotations

import argparse
import time
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from benchmark.learning.repairs_families import FAMILIES, family
from benchmark.learning.repairs_rules import RULES
from meshforge.language import Extractor, parse_extractor, select_mask, show, size
from meshforge.symbolic import Label, Source, SymbolicMesh, descriptors
from meshforge.synthesis.correction import Correction
from meshforge.synthesis.example import Example
from meshforge.synthesis.options import Options
from meshforge.synthesis.repair import Explanation, Labels, explain
from meshforge.synthesis.search import Hit, Search
from meshforge.synthesis.watch import Watch

OPTIONS = Options(max_size=9)
ROUNDS = 6
"""Proposals that a simulated person answers at most."""


@dataclass(slots=True)
class Tally:
    """Counts of one setting."""

    counts: Counter[str] = field(default_factory=Counter)
    seconds: list[float] = field(default_factory=list)


@dataclass(frozen=True, slots=True)
class Noise:
    """How labels are spoilt: errors on each demonstrated mesh, share of wrong labels in the rest, and who says so."""

    errors: int
    rest: float = 0.08
    source: Source = "vlm"


def spoilt(mesh: SymbolicMesh, errors: int, noise: Noise, rng: np.random.Generator) -> SymbolicMesh:
    """The mesh with some labels wrong: those of touching or look-alike hulls."""
    rows = descriptors([mesh])
    rows = (rows - rows.mean(axis=0)) / np.maximum(rows.std(axis=0), 0.05)
    wrong: dict[int, str] = {}
    for index in rng.permutation(len(mesh.hulls)).tolist():
        if len(wrong) == errors:
            break
        own = mesh.hulls[index].label
        touching = [mesh.hulls[k].label for k in sorted(mesh.neighbours(index)) if mesh.hulls[k].label != own]
        others = [k for k, hull in enumerate(mesh.hulls) if hull.label != own]
        near = sorted(others, key=lambda k: float(np.linalg.norm(rows[k] - rows[index])))[:3]
        choice = touching if touching and rng.random() < 0.5 else [mesh.hulls[k].label for k in near]
        if choice:
            wrong[index] = str(choice[int(rng.integers(len(choice)))])
    labels = {}
    for index, hull in enumerate(mesh.hulls):
        sure = 1.0 if noise.source == "file" else float(rng.beta(6, 3) if index in wrong else rng.beta(18, 2))
        labels[hull.name] = Label(wrong.get(index) or str(hull.label), sure, noise.source)
    return mesh.labelled(labels)


def found(examples: Sequence[Example], vocabulary: Sequence[str]) -> Extractor | None:
    """The smallest exact extractor."""
    answer = Search(examples, vocabulary, Watch(30.0), OPTIONS).run()
    return answer.extractor if isinstance(answer, Hit) else None


Case = tuple[str, list[SymbolicMesh], list[SymbolicMesh], list[int]]
"""Rule, true meshes, meshes with wrong labels, and which of them are demonstrated."""


def cases(seed: int, noise: Noise, demos: int) -> Iterator[Case]:
    """Each rule of each family, on a family and demonstrations of its own seed."""
    for kind, maker in FAMILIES.items():
        rng = np.random.default_rng([seed, *kind.encode()])
        true = family(maker, int(rng.integers(20, 31)), rng)
        for rule in RULES[kind]:
            hidden = parse_extractor(rule)
            able = [k for k, mesh in enumerate(true) if select_mask(hidden, mesh)]
            if not able:
                continue
            first = int(rng.choice(able))
            chosen = [first, *rng.choice([k for k in range(len(true)) if k != first], demos - 1, False).tolist()]
            errors = [noise.errors if k in chosen else _drawn(mesh, noise, rng) for k, mesh in enumerate(true)]
            noisy = [spoilt(mesh, count, noise, rng) for mesh, count in zip(true, errors, strict=True)]
            yield f"{kind} {rule}", true, noisy, chosen


def _drawn(mesh: SymbolicMesh, noise: Noise, rng: np.random.Generator) -> int:
    return int(rng.binomial(len(mesh.hulls), noise.rest))


def run(seed: int, noise: Noise, demos: int, tally: Tally, talk: bool) -> None:
    """All rules of all families once."""
    for name, true, noisy, chosen in cases(seed, noise, demos):
        hidden = parse_extractor(name.split(" ", 1)[1])
        vocabulary = sorted({hull.label for mesh in true for hull in mesh.hulls if hull.label})
        clean = [Example(f"m{k}", true[k], select_mask(hidden, true[k])) for k in chosen]
        best = found(clean, vocabulary)
        assert best, "the hidden extractor matches"
        _learn(name, clean, best, true, noisy, chosen, vocabulary, tally, talk)


def _learn(
    name: str,
    clean: Sequence[Example],
    best: Extractor,
    true: Sequence[SymbolicMesh],
    noisy: Sequence[SymbolicMesh],
    chosen: Sequence[int],
    vocabulary: Sequence[str],
    tally: Tally,
    talk: bool,
) -> None:
    """One rule, with a simulated person who answers proposals rightly."""
    examples = [Example(one.name, noisy[k], one.selection) for one, k in zip(clean, chosen, strict=True)]
    truth = {(one.name, hull.name): hull.label for one in clean for hull in one.mesh.hulls}
    wrong = sum(hull.label != truth[one.name, hull.name] for one in examples for hull in one.mesh.hulls)
    rest = [mesh for k, mesh in enumerate(noisy) if k not in chosen]
    exact = found(examples, vocabulary)
    needed = bool(wrong) and (exact is None or size(exact) > size(best))
    rejected: set[Correction] = set()
    spent: Counter[str] = Counter()
    counts = tally.counts
    counts["rules"] += 1
    for _ in range(ROUNDS):
        labels = Labels({one.name: one.mesh for one in examples}, rest, vocabulary)
        start = time.perf_counter()
        said = explain(examples, vocabulary, labels, OPTIONS, Watch(60.0), exact=exact, spent=spent, rejected=rejected)
        tally.seconds.append(time.perf_counter() - start)
        if said is None:
            break
        right = all(truth[c.asset, c.hull] == c.to for c in said.corrections)
        _count(counts, said, right, bool(wrong), exact)
        if talk and not right:
            _tell(name, said, exact, truth)
        counts["belief in right, percent" if right else "belief in wrong, percent"] += round(100 * min(said.beliefs))
        agreed = [c for c in said.corrections if truth[c.asset, c.hull] == c.to]
        rejected |= set(said.corrections) - set(agreed)
        spent.update(c.asset for c in agreed)
        examples = [_corrected(one, agreed) for one in examples]
        exact = found(examples, vocabulary)
    if needed:
        counts["needed"] += 1
        same = exact is not None and all(select_mask(exact, m) == select_mask(best, m) for m in true)
        counts["recovered"] += same
        if talk and not same:
            print("  LOST", name, "| found", show(exact) if exact else None, "| wrong labels", wrong)


def _count(counts: Counter[str], said: Explanation, right: bool, spoilt: bool, exact: Extractor | None) -> None:
    counts["proposals"] += 1
    counts["right"] += right
    counts["corrections"] += len(said.corrections)
    counts["without exact"] += exact is None
    counts["without exact, right"] += exact is None and right
    if not spoilt:
        counts["false on clean"] += 1


def _tell(name: str, said: Explanation, exact: Extractor | None, truth: Mapping[tuple[str, str], str | None]) -> None:
    print("  WRONG", name, "| exact", show(exact) if exact else None, "| said", show(said.extractor))
    for row, belief, why in zip(said.corrections, said.beliefs, said.whys, strict=True):
        true = truth[row.asset, row.hull]
        print(f"      {row.asset} {row.hull}: {row.was} -> {row.to}, truly {true}, belief {belief:.2f}: {why}")


def _corrected(example: Example, rows: Sequence[Correction]) -> Example:
    labels = {row.hull: Label(row.to, 1.0, "repair") for row in rows if row.asset == example.name}
    return Example(example.name, example.mesh.labelled(labels), example.selection)


def main() -> None:
    """Run all settings, and print a row for each."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", default="0-4")
    parser.add_argument("--demos", type=int, default=2)
    parser.add_argument("--talk", action="store_true", help="print wrong proposals, and what was not recovered")
    parser.add_argument("--errors", default="0,1,2")
    parser.add_argument("--sources", default="vlm,file")
    chosen = parser.parse_args()
    low, high = (int(part) for part in (chosen.seeds.split("-") * 2)[:2])
    for source in chosen.sources.split(","):
        for errors in map(int, chosen.errors.split(",")):
            tally = Tally()
            for seed in range(low, high + 1):
                run(seed, Noise(errors, source=source), chosen.demos, tally, chosen.talk)
            print(source, errors, "errors a mesh:", _row(tally), flush=True)


def _row(tally: Tally) -> str:
    counts = tally.counts
    asked, needed, wrong = counts["proposals"], counts["needed"], counts["proposals"] - counts["right"]
    return (
        f"{counts['rules']} rules, {asked} proposals, right {counts['right']} ({_share(counts['right'], asked)}), "
        f"of {counts['without exact']} without exact {counts['without exact, right']}, "
        f"false on clean {counts['false on clean']} ({_share(counts['false on clean'], counts['rules'])}), "
        f"needed {needed}, recovered {counts['recovered']} ({_share(counts['recovered'], needed)}), "
        f"belief in right {counts['belief in right, percent'] / max(1, counts['right']):.0f}%, "
        f"in wrong {counts['belief in wrong, percent'] / max(1, wrong):.0f}%, "
        f"time median {1000 * np.median(tally.seconds):.0f} ms, most {1000 * max(tally.seconds):.0f} ms"
    )


def _share(part: int, whole: int) -> str:
    return f"{100 * part / whole:.1f}%" if whole else "-"


if __name__ == "__main__":
    main()
