"""
Web servers, known by their names: which thread runs one, and by what it answers.

A server answers on threads of its own, or in the loop of the thread that runs it; only what it
calls once, as it begins or ends, is left aside. Sources: Flask 3, ``Flask.run`` (``threaded`` is
the default); FastAPI 0.115, *Concurrency and async / await* (a plain function is called by a pool,
a coroutine by the loop); uvicorn 0.30, ``main.py`` (``run``).
"""

from __future__ import annotations

import re

from ros2cc_extract.extract.static.concurrency.machine.state import ConcurrentWorld
from ros2cc_extract.source_locations import Place

_APPS = re.compile(
    r'result of (fastapi|flask|flask_socketio|starlette|quart|sanic|bottle|uvicorn|aiohttp\.web)\b'
)
_RUNNERS = frozenset({'uvicorn.run', 'waitress.serve', 'aiohttp.web.run_app', 'bottle.run'})
_RUNS = ('.run', '.serve', '.serve_forever')
_ONCE = ('startup', 'shutdown', 'cleanup', 'lifespan', 'on_event', 'contextmanager')
"""What is in the names of what such code calls once."""


def is_called_once(name: str) -> bool:
    """Whether what stands under ``name`` in code that is not scanned is called once."""
    return any(word in name for word in _ONCE)


def answers(name: str, whose: str) -> bool:
    """Whether a server answers by a function that it has got by ``name``."""
    return _APPS.match(whose) is not None and not is_called_once(name)


def note_run(world: ConcurrentWorld, name: str, whose: str, place: Place) -> None:
    """Something unknown is called that may run a server until its end."""
    is_app = name.endswith(_RUNS) and _APPS.match(whose) is not None
    if (is_app or name in _RUNNERS) and not world.second_pass:
        world.servers.append((world.thread, place))
