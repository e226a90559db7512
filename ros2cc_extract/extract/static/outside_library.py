"""
Calls that wait for what is outside of the program: processes, sockets, ports, people.

Sources: CPython 3.12, ``subprocess.py``, ``socket``, ``select``, ``urllib/request.py``; pyserial
3.5, ``serial/serialutil.py``; requests 2.32, ``api.py``.
"""

from __future__ import annotations

from dataclasses import dataclass

from ros2cc_extract.extract.static.library_table import Library, LibraryClass, Property
from ros2cc_extract.extract.static.machine import Machine
from ros2cc_extract.extract.static.values import (
    NONE,
    Call,
    Const,
    Handler,
    Instance,
    Value,
)
from ros2cc_extract.extract.static.values import Library as Name
from ros2cc_extract.extract.static.world import PlainState
from ros2cc_extract.places import Place

_TIMEOUT = 'timeout'
_LIMIT = '__timeout__'


@dataclass(frozen=True)
class _Wait:
    """
    One call that waits.

    :param position: where its time-out may stand; by name it is ``timeout`` everywhere.
    :param takes_limit: it keeps to the time-out of its object.
    """

    position: int | None = None
    takes_limit: bool = False


_BY_NAME = _Wait()
_LIMITED = _Wait(takes_limit=True)

_FUNCTIONS: dict[str, _Wait] = {
    'subprocess.run': _BY_NAME,
    'subprocess.call': _BY_NAME,
    'subprocess.check_call': _BY_NAME,
    'subprocess.check_output': _BY_NAME,
    'subprocess.getoutput': _BY_NAME,
    'subprocess.getstatusoutput': _BY_NAME,
    'os.system': _BY_NAME,
    'os.read': _BY_NAME,
    'os.wait': _BY_NAME,
    'os.waitpid': _BY_NAME,
    'builtins.input': _BY_NAME,
    'sys.stdin.read': _BY_NAME,
    'sys.stdin.readline': _BY_NAME,
    'sys.stdin.readlines': _BY_NAME,
    'select.select': _Wait(3),
    'signal.pause': _BY_NAME,
    'signal.sigwait': _BY_NAME,
    'socket.create_connection': _Wait(1),
    'urllib.request.urlopen': _Wait(2),
    'requests.request': _BY_NAME,
    'requests.get': _BY_NAME,
    'requests.post': _BY_NAME,
    'requests.put': _BY_NAME,
    'requests.patch': _BY_NAME,
    'requests.delete': _BY_NAME,
    'requests.head': _BY_NAME,
}

_SOCKET = dict.fromkeys(
    ('accept', 'connect', 'recv', 'recv_into', 'recvfrom', 'recvfrom_into', 'recvmsg'), _LIMITED
)
_SERIAL = dict.fromkeys(('read', 'read_until', 'readline', 'readlines', 'readinto'), _LIMITED)
_REQUESTS = dict.fromkeys(('get', 'post', 'put', 'patch', 'delete', 'head', 'request'), _BY_NAME)

# What another program writes (``subprocess.py``, ``Popen.__init__``).
_STREAM = 'io.BufferedReader'
_READS = dict.fromkeys(('read', 'read1', 'readinto', 'readline', 'readlines'), _BY_NAME)

_CLASSES: dict[str, dict[str, _Wait]] = {
    'subprocess.Popen': {'wait': _Wait(0), 'communicate': _Wait(1)},
    _STREAM: _READS,
    'socket.socket': _SOCKET,
    'serial.Serial': _SERIAL,
    'requests.Session': _REQUESTS,
    'selectors.DefaultSelector': {'select': _Wait(0)},
}


def _waiting(name: str, row: _Wait) -> Handler:
    def handler(machine: Machine, receiver: Value, call: Call) -> Value:
        timeout = call.argument(row.position, _TIMEOUT)
        slots = receiver.slots if isinstance(receiver, Instance) else {}
        limit = slots.get(_TIMEOUT, slots.get(_LIMIT))
        if row.takes_limit and isinstance(limit, Value):
            timeout = limit
        if not (isinstance(timeout, Const) and timeout.value == 0 and row.takes_limit):
            machine.note_blocking(name, None, timeout, call.place)
        return machine.mystery(f'result of {name}', call.place, f'{name}(…)')

    return handler


def _limit(position: int, *names: str) -> Handler:
    def handler(machine: Machine, receiver: Value, call: Call) -> Value:
        limit = call.argument(position, *names)
        if isinstance(receiver, Instance) and limit is not None:
            machine.store.write(receiver, _LIMIT, limit)
        return NONE

    return handler


def _blocks(machine: Machine, receiver: Value, call: Call) -> Value:
    """``setblocking(False)`` is a time-out of zero (``socket`` documentation)."""
    flag = call.argument(0, 'flag')
    if isinstance(receiver, Instance) and isinstance(flag, Const):
        machine.store.write(receiver, _LIMIT, NONE if flag.value else Const(0))
    return NONE


_INITS: dict[str, Handler] = {'serial.Serial': _limit(5, _TIMEOUT)}


def _stream(machine: Machine, instance: Instance, place: Place) -> Value:
    return Instance(Name(_STREAM), instance.place)


_PROPERTIES: dict[str, dict[str, Property]] = {
    'subprocess.Popen': {'stdout': _stream, 'stderr': _stream}
}
_MORE: dict[str, dict[str, Handler]] = {
    'socket.socket': {'settimeout': _limit(0, 'value'), 'setblocking': _blocks},
}


def _class(name: str, methods: dict[str, _Wait]) -> LibraryClass:
    last = name.rpartition('.')[2]
    return LibraryClass(
        state=lambda machine, instance: PlainState('outside', place=instance.place),
        init=_INITS.get(name, lambda machine, receiver, call: NONE),
        methods={
            **{method: _waiting(f'{last}.{method}', row) for method, row in methods.items()},
            **_MORE.get(name, {}),
        },
        properties=_PROPERTIES.get(name, {}),
    )


CALLS = frozenset(
    [
        *(name.removeprefix('builtins.') for name in _FUNCTIONS),
        *(f'{name.rpartition(".")[2]}.{method}' for name, of in _CLASSES.items() for method in of),
    ]
)
"""How these waits are called in a specification."""

TABLE = Library(
    classes={name: _class(name, methods) for name, methods in _CLASSES.items()},
    functions={
        name: _waiting(name.removeprefix('builtins.'), row) for name, row in _FUNCTIONS.items()
    },
)
