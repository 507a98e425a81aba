"""Long work that a page asks for: decomposing, labelling, applying, checking, exporting."""

from typing import assert_never

from meshforge.studio.jobs.outputs import start_apply, start_check, start_export, start_goal
from meshforge.studio.jobs.preparation import start_decompose, start_label, start_preview, start_rebuild
from meshforge.studio.session.session import Session
from meshforge.studio.wire import jobs as wire


def start_job(session: Session, request: wire.JobRequest) -> wire.Job:
    """Start a job. Raises MeshForgeError where it cannot be done."""
    match request:
        case wire.ApplyJob():
            return start_apply(session, request)
        case wire.DecomposeJob():
            return start_decompose(session, request)
        case wire.PreviewJob():
            return start_preview(session, request)
        case wire.RebuildJob():
            return start_rebuild(session, request)
        case wire.ExportJob():
            return start_export(session, request)
        case wire.LabelJob():
            return start_label(session)
        case wire.CheckJob():
            return start_check(session) if request.goal is None else start_goal(session, request.goal)
        case _:
            assert_never(request)
