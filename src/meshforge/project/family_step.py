"""The next sensible step in a project: the first that is missing on the way from assets to results that are signed off.

`status`, the commands and the studio show the same step, in the same words.
"""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from meshforge.common import pluralize, quote_path
from meshforge.labels import label_command
from meshforge.project.status import GIVEN, AssetStatus, FamilyState, NextStep, StepKind
from meshforge.store import Layout


def choose_next_step(state: FamilyState) -> NextStep:
    """Return the first thing that is missing; where it is being done, the text says so."""
    step = (
        _decompose(state)
        or (None if state.is_begun else _begin(state))
        or _wait_for_learning(state)
        or _explain_last_run(state)
        or _fix_program(state)
        or _learn(state)
        or _label_new_assets(state)
        or _continue_demonstration(state)
        or _answer(state)
        or _apply(state)
        or _review(state)
        or _end(state)
    )
    return replace(step, text=state.running[step.kind]) if step.kind in state.running else step


def _decompose(state: FamilyState) -> NextStep | None:
    bare = [asset for asset in state.assets if asset.hulls == 0 and asset.sources]
    if not bare:
        return None
    text = f"{_count_assets(bare, 'has', 'have')} no hulls: decompose what has none."
    return _step(state, "decompose", text, "prepare --decompose coacd", bare[0].id)


def _begin(state: FamilyState) -> NextStep:
    if not state.vocabulary and not any(asset.labelled for asset in state.assets):
        return _take_offers(state, state.assets) or _find_readable(state) or _demonstrate(state)
    return _label_first(state) or _complete_labels(state) or _demonstrate(state)


def _find_readable(state: FamilyState) -> NextStep | None:
    if any(asset.names for asset in state.assets):
        return None
    return _step(state, "wait", "No asset has hulls that can be read: fix what the remarks name.")


def _label_first(state: FamilyState) -> NextStep | None:
    """Take labels that are there already, where no hull has one yet; else those of an asset of usual size by hand."""
    if any(asset.labelled for asset in state.assets):
        return None
    if step := _take_offers(state, state.assets) or _find_readable(state):
        return step
    usual = _usual(state)
    return _label_by_hand(state, usual, f"No hull has a label yet: label those of {usual.id}.")


def _usual(state: FamilyState) -> AssetStatus:
    """The first asset with as many hulls as most have."""
    sizes = sorted(len(asset.names) for asset in state.assets if asset.names)
    return next(asset for asset in state.assets if len(asset.names) == sizes[(len(sizes) - 1) // 2])


def _take_offers(state: FamilyState, bare: Sequence[AssetStatus]) -> NextStep | None:
    """Take labels that are there already, in files, and in names while no hull has a label: later all is heard."""
    if not bare:
        return None
    ids, offers = {asset.id for asset in bare}, state.find_offers()
    if files := ids.intersection(offers.files):
        return _label_all(state, f"Labels files lie beside {pluralize(len(files), 'asset')}")
    named = sum(len(names) for asset, names in offers.names.items() if asset in ids)
    if named and not any(asset.labelled for asset in state.assets):
        return _label_all(state, f"The names of {pluralize(named, 'hull')} contain a label")
    return None


def _label_by_hand(state: FamilyState, asset: AssetStatus, text: str) -> NextStep:
    hull = next(name for name, label in zip(asset.names, asset.labels, strict=True) if label is None)
    command = label_command(state.folder, asset.id, hull, state.vocabulary)
    return NextStep("label", text, asset.id, command, _explain_names(state, asset.id))


def _explain_names(state: FamilyState, asset: str) -> str:
    note = f"Names of hulls: meshforge info {quote_path(Path(asset))} --project {quote_path(state.folder)}"
    if not state.has_program and any(one.prepared and not one.is_done for one in state.assets):
        note += f"\nOr write what is prepared, without a program: meshforge apply {quote_path(state.folder)}"
    return note


def _complete_labels(state: FamilyState) -> NextStep | None:
    bare = [asset for asset in state.assets if asset.hulls and not asset.labelled]
    if step := _take_offers(state, bare):
        return step
    if bare and _has_whole(state):
        return _label_all(state, f"{_count_assets(bare, 'has', 'have')} no label")
    return _label_rest(state) or _check_labels(state)


def _has_whole(state: FamilyState) -> bool:
    """Whether people, files or names labelled all hulls of an asset, so that its labels can be propagated."""
    return any(asset.hulls and asset.confidence.count(GIVEN) == asset.hulls for asset in state.assets)


def _label_all(state: FamilyState, why: str) -> NextStep:
    return _step(state, "label-all", f"{why}: label all hulls.", "label")


def _label_rest(state: FamilyState) -> NextStep | None:
    lacking = [asset for asset in state.assets if asset.labelled < len(asset.names)]
    if not lacking:
        return None
    lack = sum(len(asset.names) - asset.labelled for asset in lacking)
    every = sum(len(asset.names) for asset in state.assets)
    why = f"{lack} of {pluralize(every, 'hull')} {'has' if lack == 1 else 'have'} no label"
    if state.propagation is None and _has_whole(state):
        return _label_all(state, why)
    begun = [asset for asset in lacking if asset.labelled] or lacking
    best = min(begun, key=lambda asset: len(asset.names) - asset.labelled)
    return _label_by_hand(state, best, f"{why}: label those of {best.id}.")


def _check_labels(state: FamilyState) -> NextStep | None:
    unsure = sum(asset.unsure for asset in state.assets)
    if not unsure:
        return None
    last = state.propagation
    if last and last.unused >= unsure:
        return _label_all(state, f"{pluralize(last.unused, 'label')} of yours not used yet")
    are = "1 label is unsure" if unsure == 1 else f"{unsure} labels are unsure"
    best = next((asset for asset in state.assets if last and asset.id == last.next), None)
    if best and len(best.names) - best.confidence.count(GIVEN) < unsure:
        return _step(state, "check-labels", f"{are}: label {best.id} next.", "studio", best.id)
    first = next(asset.id for asset in state.assets if asset.unsure)
    return _step(state, "check-labels", f"{are}: look at them, first on {first}.", "studio", first)


def _demonstrate(state: FamilyState) -> NextStep:
    labelled = [asset.id for asset in state.assets if asset.labelled]
    best = state.suggest_first(labelled) or (_usual(state).id if not labelled else None)
    example = best or labelled[0]
    text = f"Show the steps of the edit on an asset or two{f', best first on {best}' if best else ''}."
    note = _explain_names(state, example)
    return _step(
        state, "demonstrate", text, f"demonstrate {quote_path(Path(example))} 'HULLS => ACTION' ...", example, note
    )


def _wait_for_learning(state: FamilyState) -> NextStep | None:
    """While it is not known what is next, the step that is shown stays, unless it rests on what is worked out anew."""
    if state.is_judged or state.problem:
        return None
    if state.has_program and state.shown and state.shown.kind in ("answer", "review", "demonstrate"):
        return state.shown
    return _step(state, "learn", "The program is being learned.")


def _continue_demonstration(state: FamilyState) -> NextStep | None:
    """Where just one asset is demonstrated and nothing else was done yet, more steps may come."""
    examples = [asset.id for asset in state.assets if asset.demonstrated]
    is_open = ("unknown", "needs review")
    others = [a.id for a in state.assets if a.hulls and not a.demonstrated and a.result_status.state in is_open]
    if state.has_replies or len(examples) != 1 or not others or any(asset.output != "none" for asset in state.assets):
        return None
    text = f"Show the next step on {examples[0]}, or see what the program does on {others[0]}."
    return _step(state, "demonstrate", text, asset=others[0])


def _explain_last_run(state: FamilyState) -> NextStep | None:
    """What to do where learning gave no program; the run itself explains why."""
    run = state.last_run
    if run is None:
        return None
    if run.repairs:
        return _step(state, "answer", f"{pluralize(run.repairs, 'label')} may be wrong: answer the question.", "review")
    rule, asset = run.nearest or (0, None)
    if run.status == "error":
        text = "Learning failed: see why, then learn again."
    elif run.status == "timeout":
        text = "Learning was stopped: learn again, or show the steps on another asset."
    elif run.status == "none" and asset:
        text = f"No selection fits rule {rule} yet: see what comes nearest."
    elif run.status == "none":
        text = "No program does all that is demonstrated: see why, and what may help."
    else:
        return None
    return _step(state, "learn", text, "synthesize", asset)


def _fix_program(state: FamilyState) -> NextStep | None:
    if not state.problem:
        return None
    problem, *more = state.problem.split("\n", 1)
    return _step(state, "fix-program", f"The program cannot be applied: {problem}", note="".join(more))


def _learn(state: FamilyState) -> NextStep | None:
    if not state.has_program:
        return _step(state, "learn", "Learn the program from what is demonstrated.", "synthesize")
    if not state.outdated:
        return None
    if not any(asset.demonstrated for asset in state.assets):
        return _demonstrate(state)
    text = "Labels, demonstrations, replies or settings changed since the program was learned: learn it again."
    return _step(state, "learn", text, "synthesize")


def _label_new_assets(state: FamilyState) -> NextStep | None:
    bare = [a for a in state.assets if a.hulls and not a.labelled and not a.is_done and not a.result_status.excluded]
    if not state.asks_labels or not bare:
        return None
    why = f"{_count_assets(bare, 'has', 'have')} no label"
    if not state.vocabulary:  # they get classes when the program is applied
        return None
    if any(asset.result_status.state == "signed off" for asset in state.assets):
        text = f"{_count_assets(bare, 'is', 'are')} new: apply the program, which labels them like the others first."
        return _step(state, "apply", text, "apply")
    if step := _take_offers(state, bare):
        return step
    if _has_whole(state):
        return _label_all(state, why)
    return _label_by_hand(state, bare[0], f"{why}: label those of {bare[0].id}.")


def _answer(state: FamilyState) -> NextStep | None:
    asked = state.question
    if asked is None:
        return None
    need = _count_open(state)
    match asked.kind:
        case "result":
            return _step(state, "review", f"{need}: look at one result, {asked.asset}.", "review", asked.asset)
        case "demonstrate":
            return _step(state, "answer", f"{need}: demonstrate one more asset, {asked.asset}.", "review", asked.asset)
        case "other":
            return _step(state, "answer", f"{need}: answer the question{asked.about}.", "review", asked.asset)


def _apply(state: FamilyState) -> NextStep | None:
    counted = [asset for asset in state.assets if not asset.result_status.excluded]
    behind = [a for a in counted if not a.is_done and (a.output != "failed" or a.stale)]
    if any(asset.hulls is not None for asset in behind):
        return _step(
            state, "apply", f"Apply the program: {_count_assets(behind, 'is', 'are')} not up to date.", "apply"
        )
    failed = [asset for asset in counted if asset.output == "failed" or asset in behind]
    if not failed:
        new = [asset for asset in counted if any(goal.outcome is None for goal in asset.result_status.goals)]
        why = f"Try the goals, which were not tried on {pluralize(len(new), 'asset')} as they are now."
        return _step(state, "apply", why, "apply") if new else None
    some = f"{len(failed)} of {pluralize(len(state.assets), 'asset')}, first on {failed[0].id}"
    text = f"The program fails on {some}: fix what is named, then apply it again."
    return _step(state, "apply", text, "apply", failed[0].id)


def _review(state: FamilyState) -> NextStep | None:
    wrong = [asset for asset in state.assets if asset.review == "wrong" and not asset.result_status.excluded]
    if wrong:
        text = f"{pluralize(len(wrong), 'result')} wrong: correct them, first {wrong[0].id}."
        return _step(state, "review", text, "review", wrong[0].id)
    left = [asset for asset in state.assets if asset.result_status.needs_review]
    if not left:
        failing = [asset.id for asset in state.assets if any(goal.fails for goal in asset.result_status.goals)]
        text = f"Goals fail on {pluralize(len(failing), 'result')}: look at them, first {''.join(failing[:1])}."
        return _step(state, "review", text, "review", failing[0]) if failing else None
    least = min(left, key=lambda asset: asset.result_status.confidence)
    return _step(state, "review", f"{_count_open(state)}: look at them, first {least.id}.", "review", least.id)


def _count_open(state: FamilyState) -> str:
    need = sum(asset.result_status.needs_review for asset in state.assets)
    every = pluralize(sum(not asset.result_status.excluded for asset in state.assets), "result")
    return f"{need} of {every} {'needs' if need == 1 else 'need'} review"


def _end(state: FamilyState) -> NextStep:
    if flagged := [asset.id for asset in state.assets if asset.flags]:
        what = "result is" if len(flagged) == 1 else "results are"
        text = f"{len(flagged)} {what} flagged: edit by hand, first {flagged[0]}."
        return _step(state, "correct", text, "studio", flagged[0])
    edited = quote_path(Layout(state.folder).edited)
    count = pluralize(sum(not asset.result_status.excluded for asset in state.assets), "result")
    return NextStep("export", f"{count} signed off: check and export.", None, f"meshforge check {edited}")


def _count_assets(assets: Sequence[AssetStatus], one: str, many: str) -> str:
    return f"{assets[0].id} {one}" if len(assets) == 1 else f"{pluralize(len(assets), 'asset')} {many}"


def _step(
    state: FamilyState, kind: StepKind, text: str, command: str = "", asset: str | None = None, note: str = ""
) -> NextStep:
    """A step. command: its name and what follows the project in it, or empty."""
    name, *more = command.split(" ", 1)
    typed = " ".join(["meshforge", name, quote_path(state.folder), *more]) if command else None
    return NextStep(kind, text, asset, typed, note or None)
