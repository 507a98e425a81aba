"""The web application: routes, errors in their parts, and the guard before all of it."""

from __future__ import annotations

import logging
from pathlib import Path

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse
from starlette.exceptions import HTTPException
from starlette.types import ASGIApp

from meshforge.errors import MeshForgeError
from meshforge.studio.serving.guard import Guard
from meshforge.studio.serving.problems import problem_of, status_of
from meshforge.studio.serving.routes import ROUTERS
from meshforge.studio.serving.routes.page import page_in
from meshforge.studio.state import Desk
from meshforge.studio.wire.events import Problem

_LOG = logging.getLogger(__name__)


def application(desk: Desk, token: str, page: Path) -> ASGIApp:
    """The studio on a desk. page: the folder of the built page. Raises MeshForgeError where that is not built."""
    app = FastAPI(title="MeshForge studio", docs_url=None, redoc_url=None, openapi_url=None)
    app.state.desk = desk
    for router in ROUTERS:
        app.include_router(router)
    app.mount("/", page_in(page))
    app.add_exception_handler(MeshForgeError, _told)
    app.add_exception_handler(RequestValidationError, _not_understood)
    app.add_exception_handler(HTTPException, _nothing_there)
    app.add_exception_handler(Exception, _our_fault)
    return Guard(app, token)


def _answer(problem: Problem, status: int) -> JSONResponse:
    return JSONResponse(problem.model_dump(mode="json"), status)


def _told(_: Request, error: Exception) -> JSONResponse:
    return _answer(problem_of(error), status_of(error))


def _our_fault(_: Request, error: Exception) -> JSONResponse:
    _LOG.debug("a fault of the studio", exc_info=error)
    return _answer(problem_of(error), 500)


def _not_understood(_: Request, error: Exception) -> JSONResponse:
    assert isinstance(error, RequestValidationError)
    first = error.errors()[0]
    field = ".".join(str(step) for step in first["loc"])
    return _answer(Problem(message=f"{field}: {first['msg']}"), 400)


def _nothing_there(_: Request, error: Exception) -> JSONResponse:
    assert isinstance(error, HTTPException)
    return _answer(Problem(message=str(error.detail)), error.status_code)
