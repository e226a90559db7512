"""
Calls that wait for what is outside of the program: processes, sockets, ports, people.

Sources: CPython 3.12, ``subprocess.py``, ``socket``, ``select``, ``urllib/request.py``; pyserial
3.5, ``serial/serialutil.py``; requests 2.32, ``api.py``; OpenCV 4, ``waitKey`` (a delay of zero or
less means forever) and ``videoio`` (a read takes as long as a frame, and gives up after 10 s by
``cap_v4l.cpp``, after 30 s by ``cap_ffmpeg_impl.hpp``); librealsense 2, ``pyrealsense2``
(``wait_for_frames`` gives up after 5 s).
"""

from __future__ import annotations

import ast
from collections.abc import Mapping

from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.concurrency.machine.outside_names import (
    CLASSES,
    FRAMES,
    FUNCTIONS,
    READS_OF_CAMERAS,
    SENDS_OF_SOCKETS,
    STREAM,
    WAIT_KEY,
    OutsideRow,
)
from ros2cc_extract.extract.static.libraries.standard.exit_hooks import on_exit
from ros2cc_extract.extract.static.libraries.standard.processes import child_pipes
from ros2cc_extract.extract.static.libraries.standard.processes.short_commands import is_short
from ros2cc_extract.extract.static.libraries.standard.signal_handlers import on_signal
from ros2cc_extract.extract.static.program.text_queries import noted_on, walk
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.machine.library_table import (
    Library,
    LibraryClass,
    Property,
)
from ros2cc_extract.extract.static.python.values.containers import Sequence
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Call,
    Const,
    Handler,
    Instance,
    Value,
)
from ros2cc_extract.extract.static.python.values.values import Library as Name
from ros2cc_extract.source_locations import Place

_TIMEOUT = 'timeout'
_LIMIT = '__timeout__'


_READ = 'os.read'
_COMMUNICATE, _PIPED = 'Popen.communicate', '__piped__'
_SOCKET, _ACCEPT = 'socket.socket', 'socket.accept'
_CONNECTED = 'socket.create_connection'
_DATAGRAM = 'socket.SOCK_DGRAM'
_SENDS = frozenset(f'socket.{name}' for name in SENDS_OF_SOCKETS)
_AT_ONCE = 'socket.MSG_DONTWAIT'


def _waiting(name: str, row: OutsideRow) -> Handler:
    def handler(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
        timeout = call.argument(row.position, _TIMEOUT)
        slots = receiver.slots if isinstance(receiver, Instance) else {}
        limit = slots.get(_TIMEOUT, slots.get(_LIMIT))
        if row.takes_limit and isinstance(limit, Value):
            timeout = limit
        is_at_once = (name in _SENDS and _DATAGRAM in slots) or _is_set_so(call)
        is_at_once = (is_at_once and row.takes_limit) or _is_killed(machine, name, call.place)
        is_at_once = is_at_once or (isinstance(timeout, Const) and timeout.value == 0)
        is_at_once = is_at_once or is_short(name, call)
        if not is_at_once and not _is_there(machine, name):
            machine.note_blocking(name, None, timeout, call.place)
        if name == child_pipes.WAIT and timeout in (None, NONE):
            child_pipes.note_wait(machine.world, receiver, _streams(slots), call.place)
        elif name == _COMMUNICATE:
            child_pipes.note_read(machine.world, receiver)
        if name == _CONNECTED:
            return _socket(machine, call, timeout)
        if name == _ACCEPT:
            address = machine.mystery('address of the peer', call.place)
            return Sequence((_socket(machine, call, None), address), 'tuple')
        return machine.mystery(f'result of {name}', call.place, f'{name}(…)')

    return handler


def _is_set_so(call: Call) -> bool:
    """Whether a read takes the flag by which it does not wait (``recv(2)``)."""
    given = (*call.args, *call.keywords.values())
    return any(isinstance(each, Name) and each.name == _AT_ONCE for each in given)


def _socket(machine: ConcurrentMachine, call: Call, limit: Value | None) -> Value:
    """A new socket waits forever; one that is connected so keeps the time-out of that."""
    made = Instance(Name(_SOCKET), call.place)
    if limit is not None:
        machine.store.write(made, _LIMIT, limit)
    return made


def _streams(slots: Mapping[str, object]) -> list[str]:
    return [name for name in ('stdout', 'stderr') if f'{_PIPED}{name}' in slots]


def _is_killed(machine: ConcurrentMachine, name: str, place: Place) -> bool:
    """Whether the end of a child is waited for that was killed just before."""
    asking = machine.stack[-1].node if machine.stack else None
    if name != child_pipes.WAIT or asking is None:
        return False
    return place.line in noted_on(asking, 'after_kill', child_pipes.lines_after_kill)


def _is_there(machine: ConcurrentMachine, name: str) -> bool:
    """
    Whether something is read after the program has asked whether it is there.

    ``select`` shows before a read that it will not wait, and ``in_waiting`` what a port has;
    a regular file, as ``S_ISREG`` knows one, and a descriptor that ``os.set_blocking`` or
    ``fcntl`` has changed give what there is. A function may have another one ask,
    or its caller does: ``if self.has_key():``.
    """
    if not name.rpartition('.')[2].startswith(('read', 'recv')):
        return False
    asking = machine.stack[-1].node if machine.stack else None
    if asking is not None and noted_on(asking, 'asks_first', _asks_first):
        return True
    nodes = [each.node for each in machine.stack[-2:]]
    called = {
        name for node in nodes for name in noted_on(node, 'called_in_tests', _called_in_tests)
    }
    if any(not called.isdisjoint(noted_on(t, 'askers', _askers)) for t in machine.world.trees):
        return True
    trees = machine.world.trees if name == _READ else ()
    return any(noted_on(tree, 'never_blocks', _never_blocks) for tree in trees)


_ASKS_FIRST = frozenset(
    {'select', 'in_waiting', 'inWaiting', 'S_ISREG', 'set_blocking', 'O_NONBLOCK'}
)


def _asks_first(function: ast.AST) -> bool:
    return any(
        isinstance(part, ast.Attribute) and part.attr in _ASKS_FIRST for part in walk(function)
    )


def _called_in_tests(function: ast.AST) -> frozenset[str]:
    """The functions and methods that a test calls, by name."""
    calls = (
        part.func
        for branch in walk(function)
        if isinstance(branch, (ast.If, ast.While, ast.IfExp))
        for part in walk(branch.test)
        if isinstance(part, ast.Call)
    )
    return frozenset(
        called.attr if isinstance(called, ast.Attribute) else called.id
        for called in calls
        if isinstance(called, (ast.Attribute, ast.Name))
    )


def _askers(tree: ast.Module) -> frozenset[str]:
    """The functions of a file that ask whether something is there, by name."""
    functions = (part for part in walk(tree) if isinstance(part, ast.FunctionDef))
    return frozenset(each.name for each in functions if noted_on(each, 'asks_first', _asks_first))


def _never_blocks(tree: ast.Module) -> bool:
    return any(
        isinstance(part, ast.Attribute) and part.attr in ('set_blocking', 'O_NONBLOCK')
        for part in walk(tree)
    )


def _fork(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """Parent and child go on with the same text, the child with all that others have locked."""
    machine.world.forked = machine.world.forked or call.place
    return machine.mystery('which of two processes goes on', call.place, 'os.fork()')


def _limit(position: int, *names: str) -> Handler:
    def handler(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
        limit = call.argument(position, *names)
        if isinstance(receiver, Instance) and limit is not None:
            machine.store.write(receiver, _LIMIT, limit)
        return NONE

    return handler


def _blocks(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """``setblocking(False)`` is a time-out of zero (``socket`` documentation)."""
    flag = call.argument(0, 'flag')
    if isinstance(receiver, Instance) and isinstance(flag, Const):
        machine.store.write(receiver, _LIMIT, NONE if flag.value else Const(0))
    return NONE


def _kind_of_socket(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """Nothing answers the ``connect`` of a datagram socket (``socket`` documentation)."""
    kind = call.argument(1, 'type')
    if isinstance(receiver, Instance) and isinstance(kind, Name) and kind.name == _DATAGRAM:
        machine.store.write(receiver, _DATAGRAM, kind)
    return NONE


def _child(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    if isinstance(receiver, Instance):
        for name in child_pipes.piped(call):
            machine.store.write(receiver, f'{_PIPED}{name}', Const(value=True))
    return NONE


_INITS: dict[str, Handler] = {
    'serial.Serial': _limit(5, _TIMEOUT),
    'subprocess.Popen': _child,
    _SOCKET: _kind_of_socket,
}


def _stream(machine: ConcurrentMachine, instance: Instance, place: Place) -> Value:
    child_pipes.note_read(machine.world, instance)
    return Instance(Name(STREAM), instance.place)


_PROPERTIES: dict[str, dict[str, Property]] = {
    'subprocess.Popen': {'stdout': _stream, 'stderr': _stream}
}
_MORE: dict[str, dict[str, Handler]] = {
    _SOCKET: {'settimeout': _limit(0, 'value'), 'setblocking': _blocks},
}


def _class(name: str, methods: dict[str, OutsideRow]) -> LibraryClass:
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


def _wait_key(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """``cv2.waitKey(0)`` waits for a person; with a delay, which is in milliseconds, it ends."""
    delay = call.argument(0, 'delay')
    if delay is None or (isinstance(delay, Const) and delay.value == 0):
        machine.note_blocking(WAIT_KEY, None, None, call.place)
    return machine.mystery(f'result of {WAIT_KEY}', call.place, f'{WAIT_KEY}(…)')


_CAPTURE = 'cv2.VideoCapture'


def _reads_camera(name: str) -> Handler:
    def handler(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
        if not (isinstance(receiver, Instance) and _OF_FILE in receiver.slots):
            machine.note_blocking(name, None, None, call.place)
        return machine.mystery(f'result of {name}', call.place, f'{name}(…)')

    return handler


def _open_capture(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """A number, a device, an address or a pipeline is a camera; other texts are files."""
    source = call.argument(0, 'filename')
    text = source.value if isinstance(source, Const) else None
    is_camera = not isinstance(text, str) or text.startswith('/dev/') or '://' in text
    if not is_camera and '!' not in str(text) and isinstance(receiver, Instance):
        machine.store.write(receiver, _OF_FILE, Const(True))
    return NONE


_OF_FILE = '__of_file__'


TABLE = Library(
    classes={
        **{name: _class(name, methods) for name, methods in CLASSES.items()},
        _CAPTURE: LibraryClass(
            init=_open_capture,
            methods={
                name.rpartition('.')[2]: _reads_camera(name)
                for name in sorted(READS_OF_CAMERAS - {FRAMES})
            },
        ),
        'pyrealsense2.pipeline': LibraryClass(
            init=lambda machine, receiver, call: NONE,
            methods={'wait_for_frames': _reads_camera(FRAMES)},
        ),
    },
    functions={
        'os.fork': _fork,
        'socket.create_server': lambda machine, receiver, call: _socket(machine, call, None),
        **{name: _waiting(name.removeprefix('builtins.'), row) for name, row in FUNCTIONS.items()},
        WAIT_KEY: _wait_key,
        'atexit.register': on_exit,
        'signal.signal': on_signal,
    },
)
