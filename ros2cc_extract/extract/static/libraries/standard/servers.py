"""
Servers whose handlers run on threads that no executor has, or as tasks of an event loop.

Sources: CPython 3.12, ``socketserver.py`` (``serve_forever``, ``ThreadingMixIn.process_request``
starts a thread for each request; a plain server runs the handler itself), ``http/server.py``
(``handle_one_request`` calls ``do_GET`` and its like) and ``asyncio/streams.py``
(``StreamReaderProtocol.connection_made`` makes a task for each connection); websockets 17.4,
``asyncio/server.py`` (``ServerConnection.connection_made`` does so, too).
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from functools import partial

from ros2cc_extract.extract.static.concurrency.activities import begin
from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.concurrency.waits import loop_tasks
from ros2cc_extract.extract.static.concurrency.waits.endless_runs import note_endless_run
from ros2cc_extract.extract.static.libraries.standard.asyncio_loops import make_task
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.machine.library_table import Library, LibraryClass
from ros2cc_extract.extract.static.python.objects.loops import counted
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Bound,
    Call,
    Class,
    Function,
    Instance,
    Partial,
    Value,
    options_of,
)
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.model import ActivityKind

_HANDLER = '__handler__'


def _init(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Instance)
    machine.store.write(receiver, _HANDLER, call.argument(1, 'RequestHandlerClass') or NONE)
    return NONE


def _serve(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Instance)
    given = receiver.slots.get(_HANDLER)
    options = options_of(given) if isinstance(given, Value) else ()
    with counted(machine, Unknown('as often as somebody asks', call.place)):
        for cls, made in filter(None, (_made(option, call) for option in options)):
            for method in _methods(machine, cls, receiver, made):
                if _starts_threads(receiver):
                    begin(machine, ActivityKind.THREAD, method, Call(call.place), daemon=True)
                else:
                    answers = partial(machine.call, method, Call(call.place))
                    machine.branch([answers, lambda: NONE], call.place)
    return NONE


def _serve_forever(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    note_endless_run(machine.world, receiver, call.place, 'shutdown')
    return _serve(machine, receiver, call)


def _serve_on_loop(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """``await asyncio.start_server(handler, …)``: a task of this loop for each connection."""
    handlers = options_of(call.args[0]) if call.args else ()
    if loop_tasks.current_task(machine.world) is not None:
        with counted(machine, Unknown('as often as somebody connects', call.place)):
            for handler in handlers:
                given = [machine.mystery('connection', call.place)] * _needs(handler)
                if given:
                    answer = machine.call(handler, Call(call.place, [*given]))
                    make_task(machine, NONE, Call(call.place, [answer]))
    return machine.mystery('server of the event loop', call.place, 'server')


def _needs(handler: Value) -> int:
    """How many arguments a handler gets; 0 where it is not known."""
    function = handler.function if isinstance(handler, Bound) else handler
    if not isinstance(function, Function) or isinstance(function.node, ast.Lambda):
        return 0
    return len(function.node.args.args) - isinstance(handler, Bound)


def _made(handler: Value, call: Call) -> tuple[Class, Call] | None:
    """The class of a handler, and how it is called for a request; ``partial`` gives it more."""
    if isinstance(handler, Class):
        return handler, Call(call.place)
    if isinstance(handler, Partial) and isinstance(handler.function, Class):
        return handler.function, Call(call.place, list(handler.args), dict(handler.keywords))
    return None


def _starts_threads(server: Instance) -> bool:
    cls = server.cls
    names = [getattr(each, 'name', '') for each in cls.mro] if isinstance(cls, Class) else []
    return any('Threading' in name for name in (*names, server.class_name))


def _methods(machine: ConcurrentMachine, cls: Class, server: Value, call: Call) -> Iterator[Value]:
    """What answers requests, of one handler: it lives no longer than its request."""
    handler = machine.instantiate(cls, call)
    if not isinstance(handler, Instance):
        return
    machine.store.write(handler, 'server', server)
    names = [name for each in cls.mro if isinstance(each, Class) for name in each.slots]
    for name in dict.fromkeys(names):
        if name == 'handle' or name.startswith('do_'):
            method = machine.attribute(handler, name, call.place)
            if isinstance(method, Bound):
                yield method


_SERVER = LibraryClass(
    state=lambda machine, instance: PlainState('server', place=instance.place),
    init=_init,
    methods={'serve_forever': _serve_forever, 'handle_request': _serve},
)

TABLE = Library(
    classes={
        f'{module}.{name}': _SERVER
        for module, name in (
            ('http.server', 'HTTPServer'),
            ('http.server', 'ThreadingHTTPServer'),
            ('socketserver', 'TCPServer'),
            ('socketserver', 'ThreadingTCPServer'),
            ('socketserver', 'UDPServer'),
            ('socketserver', 'ThreadingUDPServer'),
        )
    },
    functions=dict.fromkeys(
        (
            'asyncio.start_server',
            'asyncio.start_unix_server',
            'websockets.serve',
            'websockets.server.serve',
            'websockets.asyncio.server.serve',
            'websockets.legacy.server.serve',
        ),
        _serve_on_loop,
    ),
)
