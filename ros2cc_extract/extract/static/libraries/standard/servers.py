"""
Servers of the standard library, whose handlers run on threads that no executor has.

Source: CPython 3.12, ``socketserver.py`` (``serve_forever``, ``ThreadingMixIn.process_request``
starts a thread for each request; a plain server runs the handler itself) and ``http/server.py``
(``handle_one_request`` calls ``do_GET`` and its like).
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from ros2cc_extract.extract.static.concurrency.activities import begin
from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.concurrency.waits.endless_runs import note_endless_run
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.machine.library_table import Library, LibraryClass
from ros2cc_extract.extract.static.python.objects.loops import counted
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Bound,
    Call,
    Class,
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
    }
)
