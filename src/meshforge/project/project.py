"""A project as people use it: a `Store` whose further methods are the use cases, each a function of a store."""

import shutil
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Self

from meshforge import batch, labels
from meshforge.language import Orient
from meshforge.project import (
    demonstrations,
    goals,
    learn,
    new_assets,
    overview,
    preparation_plan,
    prepare,
    rebuild,
    rename,
    run,
    sign_offs,
    unprepare,
)
from meshforge.project.replies import reply_to
from meshforge.project.review import review_project
from meshforge.samples import TABLES, family_of, write_family
from meshforge.store import MeshCache, Store, Up, add_assets, create_folder

TABLE_ORIENT = "+Z: Is(leg) -> Is(panel)"


@dataclass(frozen=True)
class Project(Store):
    """A project folder, with everything that is done with it. It is a `Store`: what is set is written at once."""

    # Opening

    @classmethod
    def create(
        cls,
        folder: str | Path,
        assets: Sequence[str | Path],
        *,
        name: str | None = None,
        vocabulary: Sequence[str] = (),
        orient: Orient | str | None = None,
        up: Up = "",
    ) -> Self:
        """Make a project folder for some assets, given as files, folders and globs.

        up: the axis that points up in views and pictures of assets whose format does not say, `Y` or `Z`.
        Raises ProjectError where there is a project already, UsageError where an argument matches nothing.
        """
        return cls.open(create_folder(folder, assets, name, vocabulary, orient, up))

    def with_cache(self, cache: MeshCache | None = None) -> Self:
        """Return the same project, whose meshes stay in memory as long as their files do not change."""
        return replace(self, cache=cache or MeshCache())

    def add_assets(self, paths: Iterable[str | Path]) -> Self:
        """Return the project with more assets: files below the folder of the ids. Raises ProjectError for others."""
        with self.lock():
            added = add_assets(self.folder, self.every, paths)
            if away := [asset for asset in added if asset in self.exclusions()]:
                self.open(self.folder).exclude(away, None)
        return self.open(self.folder)

    # Labels

    set_labels = labels.set_labels
    set_labels_of = labels.set_labels_of
    label = labels.label_project
    tally_labels = labels.tally_labels
    rename_label = rename.rename_label

    # Preparation

    decompose = prepare.decompose
    cut = prepare.cut
    unprepare = unprepare.unprepare
    rebuild_spanning = rebuild.rebuild_spanning
    dismiss_spanning = preparation_plan.dismiss_spanning
    prepare_new = new_assets.prepare_new

    # Demonstrations

    demonstrate = demonstrations.demonstrate
    move_rule = demonstrations.move_rule
    delete_rule = demonstrations.delete_rule

    # The program

    accept = Store.write_program
    program_state = learn.read_program_state
    update_classes = learn.update_classes
    forget_learned = learn.forget_learned
    synthesize = learn.learn_program
    mesh_before_rule = run.mesh_before_rule
    read_goals = goals.read_goals
    set_goal = goals.set_goal
    try_goals = goals.try_goals
    read_accepted_goals = goals.read_accepted_goals
    work = run.build_work
    jobs = run.build_jobs

    def apply(
        self,
        only: Collection[str] | None = None,
        *,
        out: Path | None = None,
        options: batch.ApplyOptions = batch.APPLY_DEFAULTS,
        execution: batch.ExecutionOptions = batch.EXECUTION_DEFAULTS,
    ) -> Iterator[batch.AssetOutcome]:
        """Run the program on all assets or those of some ids, into `edited/` or `out`, as `meshforge.batch.apply` does.

        Raises ProjectError for an asset that is not there, and what `meshforge.batch.apply` raises.
        """
        program, work, templates = self.work(only)
        options = replace(options, urdf_capsules=options.urdf_capsules or self.settings.urdf_capsules)
        out = out or self.layout.edited
        return batch.apply(program, work, out, templates=templates, options=options, execution=execution)

    # What a person said while it was learned

    add_answer = demonstrations.add_answer
    confirm = demonstrations.confirm
    take_back = demonstrations.take_back
    forget_answers = demonstrations.forget_answers

    # After the program

    correct = run.correct
    set_verdict = run.review_assets
    review = review_project
    reply = reply_to
    renew_sign_offs = sign_offs.renew_sign_offs
    status = overview.compute_status


def create_tour_project(folder: Path, assets: Path, name: str = "tables") -> Project:
    """Return a new project of the bundled tables, with the labels that lie beside them, the templates of their program
    and its orientation. assets: the folder that their files are written into."""
    tables = family_of("tables")
    write_family(tables, assets)
    project = Project.create(
        folder, [assets / tables.pattern], name=name, vocabulary=tables.vocabulary, orient=TABLE_ORIENT
    )
    shutil.copytree(TABLES / "templates", project.folder / "templates")
    project.label("file")
    return project
