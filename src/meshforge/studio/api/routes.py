"""Routes that answer questions about assets, pictures, programs, the language, and checks of outputs; those that change
the project: edits, undo and redo, learning, jobs, uploads.
"""

from asyncio import gather, wait, wrap_future
from collections.abc import Collection
from concurrent.futures import Future
from pathlib import Path
from typing import Annotated, Literal, TypeVar

from fastapi import APIRouter, Body, Query, Request, Response

from meshforge.batch import ADDED
from meshforge.common import ProjectError, StoppedError, join_names
from meshforge.language import Program
from meshforge.rendering import LengthUnit
from meshforge.store import NotHereError
from meshforge.studio.api.connection import BodyText, CurrentSession, SenderId, packet_response
from meshforge.studio.edits import AnyEdit
from meshforge.studio.edits.assets import AddAssets
from meshforge.studio.jobs import start_job
from meshforge.studio.queries import assets, goals, packets, programs
from meshforge.studio.similar_hulls import choose_assets
from meshforge.studio.thumbnails import ThumbnailOf
from meshforge.studio.wire import requests
from meshforge.studio.wire.asset import AssetView, CheckPart, CheckPicture, CheckResult
from meshforge.studio.wire.family import ExtractorSuggestion, GoalCall, GoalView
from meshforge.studio.wire.jobs import Job, JobRequest
from meshforge.studio.wire.program import CoverageView, Guess, ProgramCheck, SelectionView
from meshforge.studio.workers import wait_for

router = APIRouter()
Result = TypeVar("Result")

MoveTarget = Annotated[int | None, Body(embed=True)]
MOST_ACTS = 100
"""Acts before and after the present state that a page is sent."""
POLL_SECONDS = 0.2
"""Seconds between two checks whether the page still waits."""
_CACHE_FOREVER = {"Cache-Control": "private, max-age=31536000, immutable"}


@router.get("/api/asset")
def get_asset(session: CurrentSession, asset: str) -> AssetView:
    """Return an asset with its steps."""
    return assets.build_asset_view(session.project, asset, session.mesh(asset))


@router.get("/api/shapes")
def get_shapes(session: CurrentSession, asset: str) -> Response:
    """Return the hulls and non-convex pieces of an asset."""
    return packet_response(packets.pack_asset(session.mesh(asset)))


@router.get("/api/visual")
def get_visual(session: CurrentSession, asset: str) -> Response:
    """Return the visual surfaces of an asset."""
    return packet_response(packets.pack_visual(session.mesh(asset)))


@router.get("/api/stage")
def get_stage(session: CurrentSession, asset: str, steps: int) -> Response:
    """Return an asset after some of its steps."""
    return packet_response(packets.preview_steps(session.project, asset, session.mesh(asset), steps))


@router.post("/api/preview")
def preview(session: CurrentSession, request: requests.PreviewRequest) -> Response:
    """Return what one more action would do."""
    return packet_response(packets.preview_action(session.project, request.asset, session.mesh(request.asset), request))


@router.post("/api/select")
def select(session: CurrentSession, request: requests.SelectRequest) -> SelectionView:
    """Return what an extractor selects on an asset."""
    program = None if request.rule is None else session.present_program
    return programs.select_hulls(session.project, request.asset, session.mesh(request.asset), request, program)


@router.post("/api/similar")
def find_similar(session: CurrentSession, request: requests.SimilarRequest) -> requests.SimilarView:
    """Return which hulls look like some."""
    session.check_assets(*(one.asset for one in request.hulls), *(request.assets or ()))
    return session.similar.find(session.project, session.pages.with_hulls, request)


@router.post("/api/similar/prepare")
def prepare_similar(session: CurrentSession) -> requests.EditReceipt:
    """Describe the assets, as hulls that look alike may soon be asked for."""
    session.similar.prepare(session.project, choose_assets((), session.pages.with_hulls))
    return requests.EditReceipt(message="preparing")


@router.post("/api/generalise")
def generalise(session: CurrentSession, extractor: BodyText, rule: Annotated[int, Body()] = 1) -> CoverageView:
    """Return what an extractor selects on all assets."""
    return wait_for(session.learning.generalise(extractor, rule))


@router.get("/api/result")
def get_result(session: CurrentSession, asset: str, of: Literal["program", "output"]) -> Response:
    """Return what the program makes of an asset, or the output that was written."""
    program = session.project.program() if of == "program" else None
    return packet_response(packets.preview_result(session.project, asset, session.mesh(asset), of, program))


@router.get("/api/hulls")
def get_tried_hulls(session: CurrentSession, asset: str) -> Response:
    """Return an asset with the hulls that were tried on it last."""
    tried = session.preview
    if tried is None or tried[0] != asset:
        raise NotHereError("no hulls were tried on it", where=asset)
    return packet_response(tried[1])


@router.get("/api/guesses")
def get_guesses(session: CurrentSession, asset: str) -> tuple[Guess, ...]:
    """Return what the program would select for each rule."""
    mesh, program = session.mesh(asset), session.present_program
    return programs.guess_selections(session.project, asset, mesh, program) if program else ()


@router.get("/api/thumbnail")
async def get_thumbnail(session: CurrentSession, asset: str, of: ThumbnailOf, v: str) -> Response:
    """Return the thumbnail of an asset or of its output; v: the digest on its card."""
    session.check_assets(asset)
    if not (v.isalnum() and v.isascii() and len(v) == 32):
        raise NotHereError("there is no such picture", where=asset)
    drawn = session.thumbnails.get(session.project, asset, of, v)
    await gather(wrap_future(drawn), return_exceptions=True)
    return Response(wait_for(drawn), media_type="image/png", headers=_CACHE_FOREVER)


@router.get("/api/picture")
def get_picture(
    session: CurrentSession, asset: str, rule: int, show: Annotated[tuple[str, ...], Query()] = ()
) -> Response:
    """Return an asset as it is before a rule of the present program; show: hulls that are to be seen in it."""
    program = session.present_program
    return packet_response(assets.draw_rule_picture(session.project, asset, session.mesh(asset), rule, program, show))


@router.get("/api/turned")
def get_turned(session: CurrentSession, asset: str, orient: str = "", up: Literal["y", "z"] | None = None) -> Response:
    """Return the thumbnail of an asset as a directive turns it, or with an axis up."""
    mesh = session.mesh(asset)
    mesh = mesh.with_view_up(up) if up else mesh
    turn = Program.parse(f"orient {orient}\n").orient if orient else None
    pose, _ = assets.compute_upright(session.project, mesh, turn)
    return Response(assets.draw_thumbnail(mesh, pose), media_type="image/png")


@router.post("/api/goal/check")
def check_goal(session: CurrentSession, request: GoalCall) -> GoalView:
    """Return what a form comes to, and whether that is a goal."""
    return goals.check_goal(session.project, request)


@router.post("/api/goal/extractors")
def suggest_extractors(
    session: CurrentSession, asset: BodyText, select: Annotated[tuple[str, ...], Body()]
) -> tuple[ExtractorSuggestion, ...]:
    """Return extractors that select some hulls of an asset."""
    return goals.suggest_extractors(session.project, asset, session.mesh(asset), select, session.present_program)


@router.get("/api/goal/picture")
def get_goal_picture(session: CurrentSession, asset: str, v: str) -> Response:
    """Return the picture of a failure; v: its key."""
    session.check_assets(asset)
    kept = session.project.layout.goals(asset)
    path = kept.parent / f"{kept.stem}.{v}.png"
    if not (v.isalnum() and v.isascii() and path.is_file()):
        raise NotHereError("there is no such picture", where=asset)
    return Response(path.read_bytes(), media_type="image/png", headers=_CACHE_FOREVER)


@router.post("/api/program/check")
def check_program(text: BodyText) -> ProgramCheck:
    """Return whether a text is a program."""
    return programs.check_text(text)


@router.get("/api/checked")
async def get_checked(session: CurrentSession, request: Request, asset: str, part: CheckPart) -> CheckResult:
    """Return what is measured of the output of an asset."""
    session.check_assets(asset)
    known = session.checks.check_part(session.project, asset, part)
    fresh = not known.done()
    found = await _wait_while_connected(request, known)
    if fresh:  # its card may show more now
        session.refresh_queue.add([asset])
    return found


@router.get("/api/checked/pictures")
async def get_check_pictures(
    session: CurrentSession, request: Request, asset: str, part: Literal["fit", "clearance"], unit: LengthUnit = "m"
) -> tuple[CheckPicture, ...]:
    """Return the pictures of what is measured; unit: of the lengths in them."""
    session.check_assets(asset)
    return await _wait_while_connected(request, session.checks.draw_pictures(session.project, asset, part, unit))


async def _wait_while_connected(request: Request, future: Future[Result]) -> Result:
    """The result of some work, which is stopped where nobody waits for it any more."""
    waiting = wrap_future(future)
    while not (await wait([waiting], timeout=POLL_SECONDS))[0]:
        if await request.is_disconnected():
            waiting.cancel()
            raise StoppedError("the page went on")
    if waiting.cancelled():
        raise StoppedError("the studio is being closed")
    waiting.exception()  # `wait_for` raises it
    return wait_for(future)


@router.post("/api/edit")
def make_edit(
    session: CurrentSession, change: Annotated[AnyEdit, Body()], page: SenderId = None
) -> requests.EditReceipt:
    """Make an edit."""
    return session.edit(change, page)


@router.post("/api/undo")
def undo(session: CurrentSession, page: SenderId = None, to: MoveTarget = None) -> requests.EditReceipt:
    """Undo what was done last; to: until so many changes are done."""
    return session.move("undo", page, to)


@router.post("/api/redo")
def redo(session: CurrentSession, page: SenderId = None, to: MoveTarget = None) -> requests.EditReceipt:
    """Redo what was undone last; to: until so many changes are done."""
    return session.move("redo", page, to)


@router.get("/api/history")
def get_history(session: CurrentSession) -> requests.HistoryView:
    """Return what was done and undone last."""
    return requests.HistoryView(acts=session.history.list_acts(MOST_ACTS))


@router.post("/api/learn")
def learn(session: CurrentSession) -> requests.EditReceipt:
    """Learn now, and take what is learned."""
    return session.learn()


@router.post("/api/learn/stop")
def stop_learning(session: CurrentSession) -> requests.EditReceipt:
    """Stop the learning run that is under way."""
    session.learning.stop()
    return requests.EditReceipt(message="stopped")


@router.post("/api/jobs")
def post_job(session: CurrentSession, request: Annotated[JobRequest, Body(discriminator="kind")]) -> Job:
    """Start a job."""
    return start_job(session, request)


@router.post("/api/jobs/cancel")
def cancel_job(session: CurrentSession, id: BodyText) -> Job:
    """Have a job stop."""
    return session.jobs.cancel(id)


@router.get("/api/labels/sources")
def get_label_sources(session: CurrentSession) -> requests.LabelSources:
    """Return where labels could come from, as far as assets are read by now."""
    offered = session.offers.of(session.project, session.pages.readable)
    return requests.LabelSources(files=len(offered.files), names=offered.named)


@router.put("/api/assets")
async def put_asset_file(session: CurrentSession, request: Request, path: str) -> requests.UploadReceipt:
    """Keep a file of an asset aside."""
    await session.uploads.put(path, request.stream())
    return requests.UploadReceipt(names=(path,))


@router.post("/api/assets")
def add_assets(session: CurrentSession, page: SenderId = None) -> requests.UploadReceipt:
    """Take the files that were sent as assets, but for those that cannot be read. Raises ProjectError,
    and throws them away, where none can be read, or one would take the place of another file."""
    try:
        sent = session.uploads.keep_readable(session.readers)
        staged, files = session.uploads.list_files()
        home = session.project.found.added
        _check_free(home, files, session.project.every.ids)
        session.edit(AddAssets(staged=str(staged), files=files, added=sent.names, home=str(home)), page)
    finally:
        session.uploads.clear()
    return requests.UploadReceipt(names=tuple(f"{ADDED}/{name}" for name in sent.names), problems=sent.problems)


def _check_free(home: Path, files: tuple[str, ...], ids: Collection[str]) -> None:
    if not home.resolve().is_relative_to(home.parent.resolve()):
        raise ProjectError("this folder is a link to somewhere else", where=str(home), remedy="Remove the link.")
    taken = [name for name in files if (home / name).exists() or f"{ADDED}/{name}" in ids]
    if taken:
        raise ProjectError(f"there is a file of that name already: {join_names(taken)}", remedy="Give it another name.")
