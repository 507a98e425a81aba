"""The frozen assets and the tasks are what the design asks for."""

from collections import Counter

import numpy as np
import pytest

from benchmark.assets import CATEGORIES, MERGED, SEPARATE, SETS, SETTINGS, samples
from benchmark.assets.decomposition import are_different
from benchmark.assets.generation import COUNT, category, kinds
from benchmark.evaluation.purity import count_impure
from benchmark.tasks import DIFFICULTIES, EditResult, Task, task, tasks
from meshforge.geometry import is_closed, is_convex
from meshforge.language import Attach, BaseExtractor, Diff, Each, Extractor, Geo, Intersect, Union, size_of

TASKS = tasks()
SOME_LONG = [
    pytest.param(one, marks=[pytest.mark.long] if one.difficulty != "easy" else [], id=one.name) for one in TASKS
]
"""Easy tasks run the same code as others on fewer rules."""
MOTIFS = {
    "remove residue",
    "one stable support proxy",
    "merge each leg by itself",
    "clear an interior",
    "make handles graspable",
    "ground-contact base only",
    "drop what hangs below or sticks out",
    "separate a moving leaf from its frame",
    "add a stop, a lip, a knob",
    "grow or shrink for clearance",
    "primitives instead of hulls for speed",
}


@pytest.mark.parametrize("name", CATEGORIES)
def test_a_category_is_whole(name: str) -> None:
    rows = samples(name)
    assert len(rows) == COUNT * len(SEPARATE)
    assert len({row.name for row in rows}) == len(rows)
    module = category(name)
    kinds_of = Counter(row.asset.kind for row in rows if row.setting == "fine")
    assert kinds_of == Counter(kinds(name, COUNT, 2026)) == Counter(dict(module.KINDS))
    assert sum(kinds_of[kind] for kind in module.RARE) > 0
    assert max(kinds_of[kind] for kind in module.RARE) <= 0.12 * COUNT
    tilted = sum(row.asset.pose.rotation[2, 2] < 0.9999 for row in rows) / len(rows)
    assert 0.1 < tilted < 0.6


@pytest.mark.parametrize("name", CATEGORIES)
def test_hulls_are_sound_and_carry_the_label_of_the_part_that_they_share_most_with(name: str) -> None:
    for row in samples(name, settings=SETTINGS):
        assert row.mesh.hulls
        for hull, share in zip(row.mesh.hulls, row.shares, strict=True):
            assert hull.label == max(share, key=lambda label: share[label])
            assert sum(share.values()) == pytest.approx(1.0, abs=1e-3)
            assert is_convex(hull.vertices, hull.faces, 1e-3 * row.mesh.diagonal)
            assert is_closed(hull.faces)
            assert hull.volume > 0
            assert np.isfinite(hull.vertices).all()


@pytest.mark.parametrize(
    ("group", "count", "calibrating"), [("separate", 600, 201), ("union", 200, 67), ("welded", 200, 67)]
)
def test_all_meshes_of_a_set_differ_also_from_the_calibration_set(group: str, count: int, calibrating: int) -> None:
    sets = [
        [row for name in CATEGORIES for row in samples(name, calibration, SETS[group])] for calibration in (False, True)
    ]
    assert list(map(len, sets)) == [count, calibrating]
    assert are_different(row.mesh.hulls for rows in sets for row in rows)


@pytest.mark.parametrize("calibration", [False, True])
@pytest.mark.parametrize("group", MERGED)
def test_a_fifth_of_the_hulls_of_a_merged_set_span_parts_and_hardly_any_other(group: str, calibration: bool) -> None:
    assert count_impure(CATEGORIES, group, calibration).share >= 20
    assert count_impure(CATEGORIES, "separate", calibration).share < 2


def test_there_are_three_tasks_a_category() -> None:
    assert [(one.category, one.difficulty) for one in TASKS] == [(c, d) for c in CATEGORIES for d in DIFFICULTIES]
    counts = Counter(motif for one in TASKS for motif in one.motifs)
    assert set(counts) == MOTIFS
    assert min(counts.values()) >= 2
    rare = [one for one in TASKS if one.rare]
    assert len(rare) >= 8
    assert all(one.rare in category(one.category).RARE for one in rare)


def leaves(extractor: Extractor) -> list[Extractor]:
    match extractor:
        case Union() | Intersect() | Diff():
            return [*leaves(extractor.left), *leaves(extractor.right)]
        case _:
            return [extractor]


@pytest.mark.parametrize("one", TASKS, ids=lambda one: one.name)
def test_a_task_is_as_hard_as_its_name_says(one: Task) -> None:
    rules = one.program.rules
    extractors = [rule.extractor for rule in rules]
    near = [e for e in extractors if any(isinstance(leaf, Attach | Geo) for leaf in leaves(e))]
    if one.difficulty == "easy":
        assert len(rules) == 1
        assert isinstance(extractors[0], BaseExtractor)
    elif one.difficulty == "medium":
        assert len(rules) == 2
        assert near
    else:
        assert 3 <= len(rules) <= 5
        assert any(isinstance(e, Union | Intersect | Diff) for e in near)
        assert one.program.orient
    assert set(one.program.labels) == set(category(one.category).LABELS)
    assert all(size_of(e) <= 9 for e in extractors)
    templates = {name for rule in rules for name in rule.action.templates}
    assert templates == set(one.templates)
    assert not any(isinstance(rule.action, Each) and rule.action.action == rule.action for rule in rules)


@pytest.mark.parametrize("one", SOME_LONG)
def test_the_reference_runs_on_every_pure_mesh_and_mends_three_of_the_first_four(one: Task) -> None:
    rows = one.samples()
    edits = [one.run(one.program, row.mesh) for row in rows]
    pure = [(row, edited) for row, edited in zip(rows, edits, strict=True) if not one.impure(row)]
    assert [edited.error for _, edited in pure if edited.error] == []
    assert len(pure) >= 0.4 * len(rows)
    assert sum(one.failure(row, edited) is None for row, edited in pure[:4]) >= 3


@pytest.mark.parametrize("name", ["cup-easy", "table-hard"])
def test_the_criterion_refuses_what_is_unedited_and_a_wrong_edit(name: str) -> None:
    one = task(name)
    rows = one.samples()[:12]
    assert any(one.failure(row, EditResult(row.mesh)) for row in rows)
    assert any(one.failure(row, one.run(one.wrong, row.mesh)) for row in rows)
