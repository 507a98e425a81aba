import errno
import json
import os
import shutil
from collections.abc import Generator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from meshforge.batch import (
    IN_PROCESS,
    ApplyOptions,
    AssetJob,
    AssetOutcome,
    ExecutionOptions,
    Failed,
    Skipped,
    apply,
    expand,
    hold_lock,
    make_jobs,
    to_json_line,
)
from meshforge.batch.outcome import Edited, Unchanged
from meshforge.common import MeshForgeError, UsageError
from meshforge.formats import load
from meshforge.language import Program
from tests.unit.batch.families import PROGRAM, obj, tree, write_table, write_tables, write_urdf_table


def run(assets: Path, out: Path, text: str = PROGRAM, **more: Any) -> list[AssetOutcome]:
    more.setdefault("execution", IN_PROCESS)
    return list(apply(Program.parse(text), make_jobs(expand([assets])), out, **more))


def words(outcomes: Sequence[AssetOutcome]) -> list[str]:
    return [outcome.status for outcome in outcomes]


def results(folder: Path) -> dict[str, bytes]:
    """The files of an output without what the batch keeps about them."""
    return {name: data for name, data in tree(folder).items() if not name.startswith(".meshforge")}


@pytest.fixture
def assets(tmp_path: Path) -> Path:
    write_tables(tmp_path / "assets", 3)
    return tmp_path / "assets"


@pytest.fixture
def out(tmp_path: Path) -> Path:
    return tmp_path / "out"


def test_every_asset_is_edited_into_a_tree_that_mirrors_the_input(assets: Path, out: Path) -> None:
    outcomes = run(assets, out)
    assert words(outcomes) == ["edited"] * 3
    first = outcomes[0]
    assert isinstance(first, Edited)
    assert (first.asset, first.before, first.after) == ("table0/model.obj", 6, 3)
    assert first.rules[0].selected == ("crumb",)
    assert first.rules[1].made == ("left_low~1", "right_low~1")
    assert first.out == str(out / "table0/model.obj")
    assert sorted(results(out)) == [f"table{k}/model{end}" for k in range(3) for end in (".labels.json", ".obj")]


def test_outcomes_and_files_do_not_depend_on_the_number_of_workers(assets: Path, tmp_path: Path) -> None:
    (assets / "table1" / "model.obj").write_text("v 0 0\nf 1 2 3\n")
    runs = {
        workers: run(assets, tmp_path / f"out{workers}", execution=ExecutionOptions(workers)) for workers in (0, 1, 2)
    }
    lines = {w: [to_json_line(o) | {"seconds": 0, "out": None} for o in outcomes] for w, outcomes in runs.items()}
    assert lines[0] == lines[1] == lines[2]
    trees = {workers: tree(tmp_path / f"out{workers}") for workers in runs}
    assert trees[0] == trees[1] == trees[2]
    assert words(runs[2]) == ["edited", "failed", "edited"]


def test_a_failed_asset_is_named_and_not_written_and_stops_no_other(assets: Path, out: Path) -> None:
    (assets / "table1" / "model.labels.json").unlink()
    outcomes = run(assets, out)
    assert words(outcomes) == ["edited", "failed", "edited"]
    failed = outcomes[1]
    assert isinstance(failed, Failed)
    assert "no labels" in failed.error and "table1" in failed.error
    assert not (out / "table1").exists()


def test_an_unchanged_asset_is_written_too(assets: Path, out: Path) -> None:
    outcomes = run(assets, out, "labels misc, seat\nIs(seat) => Delete\n")
    assert words(outcomes) == ["unchanged"] * 3
    assert isinstance(outcomes[0], Unchanged)
    assert (out / "table0/model.obj").read_bytes() == (assets / "table0/model.obj").read_bytes()


def test_a_second_run_skips_what_is_up_to_date(assets: Path, out: Path) -> None:
    first = run(assets, out)
    before = tree(out)
    second = run(assets, out)
    assert words(second) == ["skipped"] * 3
    assert tree(out) == before
    old, new = first[0], second[0]
    assert isinstance(old, Edited) and isinstance(new, Skipped)
    assert (new.rules, new.before, new.after, new.out) == (old.rules, old.before, old.after, old.out)
    assert words(run(assets, out, options=ApplyOptions(resume=False))) == ["edited"] * 3


def test_a_changed_asset_label_program_or_output_is_made_again(assets: Path, out: Path) -> None:
    run(assets, out)
    write_table(assets / "table0/model.obj", 3.0)
    assert words(run(assets, out)) == ["edited", "skipped", "skipped"]
    labels = assets / "table1/model.labels.json"
    labels.write_text(labels.read_text().replace('"misc"', '"leg"'))
    assert words(run(assets, out)) == ["skipped", "edited", "skipped"]
    (out / "table2/model.obj").write_text("broken")
    assert words(run(assets, out)) == ["skipped", "skipped", "edited"]
    (out / "table2/model.labels.json").unlink()
    assert words(run(assets, out)) == ["skipped", "skipped", "edited"]
    assert words(run(assets, out, PROGRAM.replace("Each(Merge)", "Delete"))) == ["edited"] * 3


def test_a_file_that_an_asset_refers_to_is_part_of_it(tmp_path: Path, out: Path) -> None:
    write_urdf_table(tmp_path / "robots")
    text = "labels misc, leg\nIs(leg) => Delete\n"
    assert words(run(tmp_path / "robots", out, text)) == ["edited"]
    assert (out / "meshes/crumb.obj").read_bytes() == (tmp_path / "robots/meshes/crumb.obj").read_bytes()
    assert words(run(tmp_path / "robots", out, text)) == ["skipped"]
    (tmp_path / "robots/meshes/crumb.obj").write_text(obj({"crumb": ((0, 0, 0), (0.2, 0.1, 0.1))}))
    assert words(run(tmp_path / "robots", out, text)) == ["edited"]


def test_an_output_whose_asset_fails_now_is_taken_away(assets: Path, out: Path) -> None:
    run(assets, out)
    (assets / "table0/model.obj").write_text("nothing of use")
    assert words(run(assets, out)) == ["failed", "skipped", "skipped"]
    assert not (out / "table0").exists()
    write_table(assets / "table0/model.obj")
    assert words(run(assets, out)) == ["edited", "skipped", "skipped"]


def test_a_file_of_someone_else_in_the_output_folder_is_not_overwritten(assets: Path, out: Path) -> None:
    (out / "table1").mkdir(parents=True)
    (out / "table1/model.obj").write_text("mine")
    outcomes = run(assets, out)
    assert words(outcomes) == ["edited", "failed", "edited"]
    assert isinstance(outcomes[1], Failed) and "no earlier run wrote it" in outcomes[1].error
    assert (out / "table1/model.obj").read_text() == "mine"
    assert words(run(assets, out)) == ["skipped", "failed", "skipped"]


def test_the_output_folder_cannot_be_that_of_the_assets(assets: Path) -> None:
    before = tree(assets)
    with pytest.raises(UsageError, match="folder of the assets"):
        run(assets, assets)
    assert tree(assets) == before


def test_assets_may_share_files_that_they_do_not_edit(tmp_path: Path, out: Path) -> None:
    for name in ("a.urdf", "b.urdf"):
        write_urdf_table(tmp_path / "robots", name)
    text = "labels misc, leg\nIs(leg) => Delete\n"
    assert words(run(tmp_path / "robots", out, text)) == ["edited", "edited"]
    (tmp_path / "robots/a.labels.json").unlink()
    assert words(run(tmp_path / "robots", out, text)) == ["failed", "skipped"]
    assert (out / "meshes/crumb.obj").exists()


def test_the_second_of_two_assets_that_change_one_file_differently_fails(tmp_path: Path, out: Path) -> None:
    first, second = (write_table(tmp_path / name / "t.obj", height) for name, height in (("a", 1.0), ("b", 2.0)))
    work = [AssetJob("a", first, first.parent, None), AssetJob("b", second, second.parent, None)]
    program = Program.parse("labels misc\nAll => Merge\n")
    outcomes = list(apply(program, work, out, execution=IN_PROCESS))
    assert words(outcomes) == ["edited", "failed"]
    assert isinstance(outcomes[1], Failed) and "a has written this file with other contents" in outcomes[1].error
    assert words(list(apply(program, work, out, execution=IN_PROCESS))) == ["skipped", "failed"]


def test_a_dry_run_tells_the_same_and_writes_nothing(assets: Path, out: Path) -> None:
    dry = [to_json_line(o) | {"seconds": 0} for o in run(assets, out, options=ApplyOptions(dry_run=True))]
    assert not out.exists()
    assert dry == [to_json_line(o) | {"seconds": 0} for o in run(assets, out)]


def test_files_that_an_edit_no_longer_makes_are_taken_away(tmp_path: Path, out: Path) -> None:
    write_urdf_table(tmp_path / "robots")
    run(tmp_path / "robots", out, "labels top, leg, misc\nUnion(Is(leg), Is(top)) => Merge\n")
    made = set(results(out))
    run(tmp_path / "robots", out, "labels top, leg, misc\nIs(misc) => Delete\n")
    assert len(made) > len(set(results(out)) & made)
    assert words(run(tmp_path / "robots", out, "labels top, leg, misc\nIs(misc) => Delete\n")) == ["skipped"]


def test_only_one_run_may_write_into_a_folder(assets: Path, out: Path) -> None:
    with hold_lock(out / ".meshforge" / "lock", str(out)), pytest.raises(MeshForgeError, match="another meshforge"):
        run(assets, out)


def test_a_caller_that_stops_early_leaves_finished_work_and_no_drafts(assets: Path, out: Path) -> None:
    outcomes = apply(Program.parse(PROGRAM), make_jobs(expand([assets])), out, execution=ExecutionOptions(1))
    assert next(outcomes).status == "edited"
    assert isinstance(outcomes, Generator)
    outcomes.close()
    assert sorted(results(out)) == ["table0/model.labels.json", "table0/model.obj"]
    assert not (out / ".meshforge" / "drafts").exists()
    assert words(run(assets, out)) == ["skipped", "edited", "edited"]


def test_two_assets_of_one_id_are_refused(assets: Path, out: Path) -> None:
    job = make_jobs(expand([assets]))[0]
    with pytest.raises(UsageError, match="two assets have the id"):
        apply(Program.parse(PROGRAM), [job, job], out)


def test_a_folder_of_pieces_is_edited_as_one_asset(tmp_path: Path, out: Path) -> None:
    pieces = {"left": ((0, 0, 0), (1, 1, 1)), "right": ((1, 0, 0), (2, 1, 1)), "far": ((9, 9, 9), (10, 10, 10))}
    (tmp_path / "pieces").mkdir()
    for name, box in pieces.items():
        (tmp_path / f"pieces/{name}.obj").write_text(obj({name: box}))
    (tmp_path / "pieces.labels.json").write_text(json.dumps({"hulls": {"left": "a", "right": "a", "far": "b"}}))
    program = "labels a, b\nIs(a) => Merge\n"
    outcomes = run(tmp_path / "pieces", out, program)
    assert [(o.asset, o.status) for o in outcomes] == [("pieces", "edited")]
    assert {hull.name: hull.label for hull in load(out / "pieces").hulls} == {"far": "b", "left~1": "a"}
    assert words(run(tmp_path / "pieces", out, program)) == ["skipped"]
    (tmp_path / "pieces/more.obj").write_text(obj({"more": ((20, 0, 0), (21, 1, 1))}))
    assert words(run(tmp_path / "pieces", out, program)) == ["edited"]


def test_what_the_program_cannot_see_and_labels_that_do_not_fit_are_noted(tmp_path: Path, out: Path) -> None:
    path = write_table(tmp_path / "assets" / "t.obj")
    run(tmp_path / "assets", out)
    (tmp_path / "assets" / "t.labels.json").write_bytes((out / "t.labels.json").read_bytes())
    leaf = "o leaf\nv 0 0 9\nv 1 0 9\nv 0 1 9.5\nv 1 1 9\nf 49 50 51\nf 52 50 51\n"
    path.write_text(path.read_text().replace("o crumb", "o litter") + leaf)
    (edited,) = run(tmp_path / "assets", out)
    assert isinstance(edited, Unchanged)
    opaque, gone = edited.notes[:2]
    assert opaque.startswith("no convex hulls, so left as they are: leaf (")
    assert gone == "labels of hulls that are gone were left out: left_low~1, right_low~1"


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no named pipes")
def test_an_asset_that_takes_for_ever_fails_and_the_others_are_done(assets: Path, out: Path) -> None:
    first, *others = make_jobs(expand([assets]))
    endless = out.with_name("endless.json")
    os.mkfifo(endless)  # whoever reads it waits for a writer that never comes
    work = [replace(first, labels=endless), *others]
    outcomes = list(apply(Program.parse(PROGRAM), work, out, execution=ExecutionOptions(1, 2.0)))
    assert words(outcomes) == ["failed", "edited", "edited"]
    assert isinstance(outcomes[0], Failed) and "longer than 2 seconds" in outcomes[0].error


@pytest.mark.slow
def test_after_a_full_disk_the_next_run_goes_on(
    assets: Path, out: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole = tmp_path / "whole"
    run(assets, whole)
    rename, room = Path.replace, [0]

    def replace(self: Path, target: Path) -> Path:
        room[0] -= 1
        if room[0] < 0:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        return rename(self, target)

    for start in range(21):  # seven renames an asset: three for its draft, four into place
        shutil.rmtree(out, ignore_errors=True)
        room[0] = start
        with monkeypatch.context() as full:
            full.setattr(Path, "replace", replace)
            with pytest.raises(MeshForgeError, match=r"out: nothing can be written here any more: No space left") as e:
                run(assets, out)
        assert "goes on" in str(e.value)
        run(assets, out)
        assert tree(out) == tree(whole)
