"""Programs learned on meshes that are rebuilt where hulls span: which are, who labels first, what is compared."""

from __future__ import annotations

from benchmark.assets import samples
from benchmark.spanning.family import choose_known
from benchmark.spanning.programs import open_bench
from benchmark.study.client import TaskClient
from benchmark.study.project import SUFFIX, name_by_files, open_project
from benchmark.study.propagation import begin_by_hand
from benchmark.tasks import task
from meshforge.symbolic import Label


def test_a_session_begins_with_labels_by_hand_of_the_known_assets_and_those_of_split_parts() -> None:
    rows = samples("cup", False, ("coarse",))[:6]
    known = [rows[place].name for place in choose_known(6)]
    split = next(row for row in rows if row.name not in known)
    part = split.mesh.hulls[0].name
    told = Label("handle", 0.6, "rebuild")
    bench = name_by_files(open_bench(task("cup-medium"), [(row, {part: told} if row is split else {}) for row in rows]))
    with open_project(bench.desk("propagated", 0)) as project:
        by_hand, _ = begin_by_hand(TaskClient(project), bench, 3)
        meshes = dict(project.meshes_by_id())
    assert by_hand == {f"{name}{SUFFIX}" for name in known}
    parts = meshes[f"{split.name}{SUFFIX}"]
    assert parts.hull_of(part).annotation == told
    assert all(hull.source == "propagated" for hull in parts.hulls if hull.name != part)
    for name in by_hand:
        pairs = zip(meshes[name].hulls, bench.truth.meshes[name].hulls, strict=True)
        assert all(hull.label == true.label and hull.source == "user" for hull, true in pairs)
