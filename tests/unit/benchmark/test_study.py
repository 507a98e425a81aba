"""Simulated demonstrators: the same seed does the same, what they say is true, noisy labels are as noisy as said."""

import json
from dataclasses import replace

import pytest

from benchmark.assets import CATEGORIES, SEPARATE, family, samples
from benchmark.study import CONDITIONS, FLAT, REPORTED, TRUE, Bench, Session, open_bench, teach_task
from benchmark.study.client import TaskClient
from benchmark.study.condition import KIND, PROPAGATED, SEEN, SYSTEMATIC
from benchmark.study.keystrokes import GLANCE, count_acts, model_seconds
from benchmark.study.labels import ACCURACY, AFFECTED, FEW, MOST, count_wrong, mislabel, noisy
from benchmark.study.project import SUFFIX, name_by_files, open_project
from benchmark.study.propagation import begin_by_hand, label_by_hand
from benchmark.study.sample import select_sample
from meshforge.synthesis import synthesize
from tests.synthesis_boxes import boxes
from tests.synthesis_cupboards import cupboards, shown
from tests.unit.benchmark.conftest import few


@pytest.fixture(scope="module")
def bench() -> Bench:
    return few("cup-medium")


def without_times(session: Session) -> Session:
    return replace(session, rounds=[replace(row, seconds={}) for row in session.rounds])


@pytest.mark.parametrize(
    "condition", [TRUE, FLAT, CONDITIONS["noisy labels, flat confidence: errs in 5%"], KIND, SYSTEMATIC]
)
def test_a_session_is_the_same_every_time_and_survives_json(bench: Bench, condition: object) -> None:
    one, other = (teach_task(bench, condition, 0) for _ in range(2))  # type: ignore[arg-type]
    assert without_times(one) == without_times(other)
    assert Session.of_json(json.loads(json.dumps(one.to_json()))) == one
    assert one.k == len(one.shown) + one.answers
    assert one.judged == len(bench.samples) - len(set(one.shown))


CARRIED = PROPAGATED[3]


def test_labels_that_are_carried_over_leave_what_was_labelled_by_hand_and_judge_the_rest(bench: Bench) -> None:
    one, other = (teach_task(bench, CARRIED, 0) for _ in range(2))
    assert without_times(one) == without_times(other)
    named, name = name_by_files(bench), one.shown[0] + SUFFIX
    true = named.truth.meshes
    with open_project(named.desk("propagated", 0)) as project:
        client = TaskClient(project)
        by_hand, painted = begin_by_hand(client, named, 3)
        before = client.read_meshes()
        more, _ = label_by_hand(client, named, name)
        after = client.read_meshes()
    given = painted.typed
    assert len(by_hand) == 3
    assert sum(len(true[known].hulls) for known in by_hand) >= given > 0
    assert one.judged == len(bench.samples) - len(by_hand | {shown + SUFFIX for shown in one.shown})
    assert one.typed >= given
    for known in (*by_hand, name):
        assert [hull.label for hull in after[known].hulls] == [hull.label for hull in true[known].hulls]
    assert more.inspected == len(before[name].hulls)
    assert more.typed == sum(a.label != b.label for a, b in zip(before[name].hulls, true[name].hulls, strict=True))
    carried = [h for n, mesh in after.items() if n not in by_hand | {name} for h in mesh.hulls]
    assert {hull.source for hull in carried} == {"propagated"}


def test_with_true_labels_nobody_confirms_anything_wrong_and_accepts_only_what_looks_right(bench: Bench) -> None:
    session = teach_task(bench, TRUE, 1)
    assert session.confirmed == 0
    assert session.f1 == pytest.approx(1.0) or not session.right
    assert session.right == (session.rounds[-1].differs == 0)


def test_the_noisy_labeller_is_as_noisy_as_it_says() -> None:
    rows = [sample for category in CATEGORIES for sample in samples(category, calibration=True)]
    errors = [count_wrong(row.mesh, noisy(row.mesh, (5, k), telling=True)) for k, row in enumerate(rows)]
    hulls = [len(row.mesh.hulls) for row in rows]
    assert 1 - sum(errors) / sum(hulls) == pytest.approx(ACCURACY, abs=0.02)
    assert all(error <= MOST for error, count in zip(errors, hulls, strict=True) if count <= FEW)


def test_a_persons_time_is_modelled_from_what_was_done(bench: Bench) -> None:
    session = teach_task(bench, TRUE, 0)
    spent = model_seconds(session)
    assert spent["answering"] == pytest.approx(session.answers * 4.0)
    assert spent["looking"] == pytest.approx(session.glances * GLANCE)
    assert session.glances > 0
    assert spent["demonstrating"] > 0
    assert model_seconds(Session("cup-medium", "", 0)) == dict.fromkeys(spent, 0.0)
    assert count_acts(session) >= len(session.shown) + session.steps_shown + session.hulls_shown + session.glances


def test_decompositions_of_one_asset_never_share_a_family() -> None:
    for setting in SEPARATE:
        rows = open_bench("cup-easy", setting).samples.values()
        assert {row.setting for row in rows} == {setting}
        assert len({row.asset.name for row in rows}) == len(rows)
    assert {TRUE.setting(seed) for seed in TRUE.seeds(REPORTED)} == set(SEPARATE)
    assert {SYSTEMATIC.setting(seed) for seed in SYSTEMATIC.seeds(REPORTED)} == set(SEPARATE)


@pytest.mark.parametrize("category", CATEGORIES)
def test_systematic_errors_call_one_kind_of_part_by_one_wrong_name_in_a_third_of_the_assets(category: str) -> None:
    rows = {row.name: row.mesh for row in family(category, "medium", calibration=True)}
    for seed in range(5):
        found = mislabel(rows, (seed,))
        assert found.keys() == rows.keys()
        pairs = {
            name: {(a.label, b.label) for a, b in zip(mesh.hulls, found[name].hulls, strict=True)}
            for name, mesh in rows.items()
        }
        (confused,) = {pair for some in pairs.values() for pair in some if pair[0] != pair[1]}
        having = [name for name, some in pairs.items() if confused[0] in {true for true, _ in some}]
        affected = [name for name in having if confused in pairs[name]]
        assert len(affected) == max(round(AFFECTED * len(having)), 1)
        assert all((confused[0], confused[0]) not in pairs[name] for name in affected)


def test_a_guided_person_sees_every_believable_candidate_fail_and_then_what_is_unlike_all_before() -> None:
    meshes = cupboards(40, every=8)
    outcome = synthesize(shown(meshes, ["c0"], "Is(handle) => Delete"), meshes)
    sample = select_sample(outcome, meshes, ("body", "drawer", "handle"), ["c0"])
    assert len(set(sample) - {"c0"}) == len(sample) == SEEN
    for one in outcome.candidates:
        assert not one.differs_on or one.belief < 0.005 or set(one.differs_on) & set(sample)
    plain = {f"p{k}": boxes(("a", "body", (0, 0, 0), (1, 1, 1))) for k in range(20)}
    odd = {"odd": boxes(("a", "body", (0, 0, 0), (1, 1, 1)), ("b", "lid", (0, 0, 1), (1, 1, 1)))}
    outcome = synthesize(shown(plain, ["p0"], "Is(body) => Delete"), plain | odd)
    assert select_sample(outcome, plain | odd, ("body", "lid"), ["p0"])[0] == "odd"
