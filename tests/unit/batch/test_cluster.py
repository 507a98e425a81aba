"""The same run on a Ray cluster of several nodes, of which one dies in the midst."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from meshforge.batch import CheckTask, ExecutionOptions, Failed, WorkerFailure, apply, check_assets, expand, make_jobs
from meshforge.batch.execution import run_on_cluster
from meshforge.checks import CheckOptions
from meshforge.language import Program
from meshforge.project import Project
from tests.unit.batch.cluster_work import square_or_worse
from tests.unit.batch.families import PROGRAM, label_of, table_boxes, tree, write_tables

ray = pytest.importorskip("ray")
pytestmark = [pytest.mark.slow, pytest.mark.filterwarnings("ignore")]  # the warnings are Ray's own


@pytest.fixture(scope="module")
def cluster() -> Iterator[Any]:
    """A head without processors for work, and two nodes of one each."""
    from ray.cluster_utils import Cluster

    made = Cluster()
    made.add_node(num_cpus=0, include_dashboard=False)
    for _ in range(2):
        made.add_node(num_cpus=1)
    ray.init(address=made.address, log_to_driver=False)
    yield made
    ray.shutdown()
    made.shutdown()  # type: ignore[no-untyped-call]


def test_results_come_in_order_and_a_crash_or_a_hang_loses_one_item(cluster: Any) -> None:
    count = [0]

    def done() -> None:
        count[0] += 1

    found = list(run_on_cluster(square_or_worse, range(40), ExecutionOptions(timeout=8.0, progress=done)))
    assert found[3] == WorkerFailure("its worker process died (SIGKILL)")
    assert found[5] == WorkerFailure("it took longer than 8 seconds and was stopped", 8.0)
    assert [(k, n) for k, n in enumerate(found) if k not in (3, 5)] == [
        (k, k * k) for k in range(40) if k not in (3, 5)
    ]
    assert count == [40]


def test_a_node_that_dies_in_the_midst_costs_nothing(cluster: Any, tmp_path: Path) -> None:
    """Both nodes work when one of them is killed, and a third one comes."""
    write_tables(tmp_path / "assets", 24)
    (tmp_path / "assets/table7/model.obj").write_text("v 1 2\n")
    program, work = Program.parse(PROGRAM), make_jobs(expand([tmp_path / "assets"]))
    here = list(apply(program, work, tmp_path / "here", execution=ExecutionOptions(2)))
    there, killed = [], False
    for outcome in apply(program, work, tmp_path / "there", execution=ExecutionOptions(backend="ray")):
        there.append(outcome)
        if not killed:
            cluster.remove_node(next(iter(cluster.worker_nodes)), allow_graceful=False)
            cluster.add_node(num_cpus=1)
            killed = True
    assert [(o.asset, o.status) for o in there] == [(o.asset, o.status) for o in here]
    assert [o.asset for o in there if isinstance(o, Failed)] == ["table7/model.obj"]
    assert tree(tmp_path / "there") == tree(tmp_path / "here")
    again = apply(program, work, tmp_path / "there", execution=ExecutionOptions(backend="ray"))
    assert {o.status for o in again} == {"skipped", "failed"}


def test_checks_and_labels_are_the_same_there(cluster: Any, tmp_path: Path) -> None:
    write_tables(tmp_path / "assets", 6)
    (tmp_path / "assets/table3/model.obj").write_text("v 1 2\n")
    work, wanted = make_jobs(expand([tmp_path / "assets"])), CheckTask(CheckOptions(("unreal", "fit")))
    found, labels = [], []
    for spread in (ExecutionOptions(workers=2), ExecutionOptions(backend="ray")):
        found.append([examined.to_json() for examined in check_assets(work, wanted, spread) if examined])
        made = Project.create(tmp_path / spread.backend, [tmp_path / "assets"], vocabulary=("top", "leg", "misc"))
        made.set_labels("table0/model.obj", {name: label_of(name) for name in table_boxes()})
        named, told = made.label("names", execution=spread).outcomes, made.label("propagate", execution=spread)
        labels.append((named, told, tree(made.folder / "labels")))
    assert found[0] == found[1] and [row["asset"] for row in found[0] if row["error"]] == [str(work[3].path)]
    assert labels[0] == labels[1] and len(labels[0][2]) == 5
