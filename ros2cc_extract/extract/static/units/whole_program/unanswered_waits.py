"""
Waits of code that is no callback, and whether anybody spins meanwhile.

Source: rclpy 7.1.6, ``client.py`` (``call`` waits for an event), ``__init__.py``
(``spin_until_future_complete`` spins the given node alone), ``task.py`` (``__await__``),
``timer.py`` (``Rate.sleep`` waits for an event that a timer of the node sets).
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from dataclasses import replace

from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.extract.static.concurrency.waits.uncalled_wakers import (
    data_is_written_elsewhere,
    uncalled_wakers,
)
from ros2cc_extract.extract.static.python.machine.recorded_deeds import ActivityState, Deeds
from ros2cc_extract.extract.static.python.machine.wake_operations import Word
from ros2cc_extract.extract.static.python.machine.world import (
    EntityState,
    NodeState,
    OutsideWait,
    PlainState,
    Spin,
    World,
)
from ros2cc_extract.extract.static.python.values.values import Const, Instance, Value, options_of
from ros2cc_extract.extract.static.units.whole_program.joined_threads import (
    JOIN,
    is_over,
    never_joined,
)
from ros2cc_extract.extract.static.units.whole_program.threads_at_exit import kept_at_exit
from ros2cc_extract.places import Place
from ros2cc_extract.spec.deeds import WORKING_LOOP
from ros2cc_extract.spec.model import ActivityKind, When
from ros2cc_extract.spec.partners import SERVER_KINDS

_ANSWERS = frozenset(['client.call', 'send_goal', 'get_result', 'busy wait'])
_RATE = 'Rate.sleep'
_ASYNCIO_AWAIT = 'asyncio-await'
_FUTURES = frozenset(['client', 'goal', 'result', 'cancel', 'future', 'task'])
# Waits for objects that nothing but the program ends, by their kinds.
_PLAIN = {
    'Event.wait': ('event',),
    'Condition.wait': ('condition',),
    'Condition.wait_for': ('condition',),
    'Queue.get': ('queue',),
    'spin_until_future_complete': ('future',),
}
_PASTIMES = frozenset(['sleep', 'print', 'info', 'debug', 'warn', 'warning', 'get_logger', 'ok'])
_WAITING = _PASTIMES | {'spin_once', 'time', 'monotonic', 'now', 'get_clock', 'warning_once'}
_HARMLESS = _PASTIMES | {'error', 'append', 'len', 'str', 'time', 'monotonic', 'put', 'set'}


def awaits_each_round(loop: ast.While) -> bool:
    """Whether no round of ``loop`` ends without an ``await``, unless it leaves the loop."""
    return _awaits((loop.test,)) or _always_awaits(loop.body)


def _always_awaits(statements: Sequence[ast.stmt]) -> bool:
    """Whether one of ``statements`` awaits whatever branches are taken inside of it."""
    return any(_awaits(_heads(each)) or _always_awaits(_bodies(each)) for each in statements)


def _bodies(statement: ast.stmt) -> Sequence[ast.stmt]:
    """What of a compound statement runs in any case."""
    if isinstance(statement, (ast.With, ast.AsyncWith)):
        return statement.body
    return (*statement.body, *statement.finalbody) if isinstance(statement, ast.Try) else ()


def _heads(statement: ast.stmt) -> Sequence[ast.AST]:
    """The parts of a statement that are evaluated in any case."""
    if isinstance(statement, (ast.If, ast.While)):
        return (statement.test,)
    if isinstance(statement, (ast.For, ast.AsyncFor)):
        return (statement.iter,)
    is_compound = hasattr(statement, 'body') or isinstance(statement, ast.Match)
    return () if is_compound else (statement,)


def _awaits(parts: Sequence[ast.AST]) -> bool:
    return any(isinstance(each, ast.Await) for part in parts for each in ast.walk(part))


def is_idle(loop: ast.While) -> bool:
    """True for a loop that only sleeps and logs while it waits."""
    return all(
        _called_name(part) in _PASTIMES
        for statement in loop.body
        for part in ast.walk(statement)
        if isinstance(part, (ast.Call, ast.Await))
    )


def only_waits(loop: ast.While) -> bool:
    """True for a loop that only sleeps, logs and spins while it waits."""
    parts = [part for each in loop.body for part in ast.walk(each)]
    called = {_called_name(part) for part in parts if isinstance(part, ast.Call)}
    stores = (part for part in parts if isinstance(part, (ast.Attribute, ast.Subscript)))
    return called <= _WAITING and not any(isinstance(part.ctx, ast.Store) for part in stores)


def minds_nothing(loop: ast.While) -> bool:
    """Whether it is ``while True``, and does nothing that may raise when rclpy is shut down."""
    called = (_called_name(part) for part in ast.walk(loop) if isinstance(part, ast.Call))
    is_plain = not any(isinstance(part, (ast.Raise, ast.Await)) for part in ast.walk(loop))
    return isinstance(loop.test, ast.Constant) and is_plain and _HARMLESS.issuperset(called)


def call_of_loop(loop: ast.While, call: str, activity: ActivityState | None) -> str:
    """
    How a loop that others end is called: one in which a thread works waits for nobody.

    Whoever joins the thread waits for its end all the same.
    """
    works = activity is not None and activity.kind is not ActivityKind.MAIN and not is_idle(loop)
    return WORKING_LOOP if works else call


def spins(loop: ast.While) -> bool:
    """True for a loop that lets an executor run what is ready, again and again."""
    return any(
        isinstance(part, ast.Call) and _called_name(part) == 'spin_once'
        for statement in loop.body
        for part in ast.walk(statement)
    )


def is_endless(loop: ast.While) -> bool:
    """True for ``while True`` and ``while rclpy.ok()``."""
    test = loop.test
    return bool(test.value) if isinstance(test, ast.Constant) else _called_name(test) == 'ok'


def _last(name: str) -> str:
    return name if name in _PLAIN else name.rpartition('.')[2]


def _called_name(call: ast.expr) -> str:
    function = call.func if isinstance(call, ast.Call) else None
    if isinstance(function, ast.Attribute):
        return function.attr
    return function.id if isinstance(function, ast.Name) else ''


def note(world: World, name: str, on: Instance, place: Place, spun: tuple[Instance, ...]) -> None:
    """Remember a wait of the program's set-up."""
    if world.when is not When.START or world.after_spin:
        return
    state = on.state
    if name == 'await' and isinstance(state, PlainState) and state.kind in _FUTURES:
        world.diagnostics.append(_awaited_by_asyncio(place))
    source = state.of if isinstance(state, PlainState) and state.of is not None else on
    client = source.state if isinstance(source, Instance) else None
    if not isinstance(client, EntityState):
        is_plain = isinstance(state, PlainState) and state.kind in _PLAIN.get(_last(name), ())
        if is_plain and world.is_program:
            _remember(world, name, on, place, spun)
        return
    if name == _RATE:
        _remember(world, name, client, place, ())
    if client.kind not in SERVER_KINDS:
        return
    if name in _ANSWERS or name.endswith('spin_until_future_complete'):
        _remember(world, name, client, place, spun)


def _remember(
    world: World,
    name: str,
    on: EntityState | Instance,
    place: Place,
    spun: tuple[Instance, ...],
) -> None:
    # Threads are followed where they are started; what a thread waits for has no place among them.
    begun = None if world.in_thread or world.open_loops else len(world.spins)
    wait = OutsideWait(name, on, place, world.in_thread, spun, begun=begun, path=world.path)
    world.outside.append(wait)


def note_interruptible(world: World, name: str, on: Value | None) -> None:
    """
    Remember an event on which the main program may wait for the signal that ends it.

    What nobody can set as it has no name, or what stands where an interruption is caught.
    Source: CPython 3.12, ``signal`` (SIGINT raises ``KeyboardInterrupt`` in the main thread).
    """
    if name != 'Event.wait' or not isinstance(on, Instance) or world.in_thread:
        return
    if world.tries or on.hint is None:
        world.interruptible.add(id(on))


def forget_awaits(world: World, told: int) -> None:
    """Who runs a coroutine that nobody in sight calls is not known: an executor may do so."""
    late = [each for each in world.diagnostics[told:] if each.slug != _ASYNCIO_AWAIT]
    world.diagnostics[told:] = late


def _awaited_by_asyncio(place: Place) -> Diagnostic:
    return Diagnostic(
        severity=Severity.WARNING,
        slug=_ASYNCIO_AWAIT,
        place=place,
        message='asyncio awaits an rclpy future: from rclpy 7.1.9 on this raises RuntimeError '
        'unless the future is done already',
        help='await it in a callback or an executor task, or await an asyncio future that its '
        'done-callback sets by loop.call_soon_threadsafe',
    )


def note_unanswered(world: World) -> None:
    """Tell of waits whose answer nobody can take, or nobody can give, when all was followed."""
    if any(_may_be_spun_elsewhere(node) for node in world.nodes):
        return
    told = [each for wait in world.outside for each in _told(wait, world)]
    worst = {each.place for each in told if each.severity is Severity.ERROR}
    world.diagnostics.extend(
        each for each in told if each.severity is Severity.ERROR or each.place not in worst
    )
    world.diagnostics.extend(kept_at_exit(world, lambda wait: tuple(spun_beside(wait, world))))


def _told(wait: OutsideWait, world: World) -> Iterator[Diagnostic]:
    if isinstance(wait.client, Instance):
        yield from _unended(wait, wait.client, world)
        return
    if wait.client is None:
        yield from _unwritten(wait, world)
        return
    for node, what in _needed(wait, wait.client, world):
        if not any(node is spun for spun in (*wait.spun, *spun_beside(wait, world))):
            yield _unanswered(wait, wait.client, what)
            return


def _may_be_spun_elsewhere(node: Instance) -> bool:
    state = node.state
    return not isinstance(state, NodeState) or state.ghost is not None or bool(state.more)


def _unended(wait: OutsideWait, thing: Instance, world: World) -> Iterator[Diagnostic]:
    """Nobody makes a future done, or only callbacks that nobody serves meanwhile end the wait."""
    spun = (*wait.spun, *spun_beside(wait, world))
    if wait.call == JOIN:
        yield from never_joined(wait, world, spun)
        return
    name = thing.hint or thing.class_name
    words = frozenset({Word.PUT if wait.call == 'Queue.get' else Word.SET})
    wakings = [each for each in world.wakings.get(id(thing), ()) if each.word in words]
    if not wakings and id(thing) in world.interruptible:
        return
    if id(thing) in world.given or uncalled_wakers(world, name, words, thing.place):
        return
    doers = [waking.by for waking in wakings]
    nodes = [doer.node for doer in doers if isinstance(doer, EntityState)]
    if len(nodes) < len(doers) or any(node is each for node in nodes for each in spun):
        return
    # What nobody touches may be meant to keep the program.
    is_meant = not nodes and not wait.in_thread and wait.call != 'Queue.get'
    yield _waits_for_ever(wait, name, has_node=bool(nodes), is_meant=is_meant)


def _waits_for_ever(wait: OutsideWait, name: str, *, has_node: bool, is_meant: bool) -> Diagnostic:
    what = 'nobody ends that wait'
    if has_node:
        what = 'nobody spins the node whose callback would end it'
    return Diagnostic(
        severity=Severity.WARNING if is_meant else Severity.ERROR,
        slug='nobody-spins',
        place=wait.place,
        message=f'{wait.call} waits for {name}, but {what}: it waits for ever',
        help='spin the node in a thread before, and only there'
        if has_node
        else 'end it somewhere, or give it a time-out',
    )


def note_loop(world: World, names: set[str], place: Place) -> None:
    """Remember that the set-up looks again and again whether data of ``names`` has changed."""
    is_set_up = world.when is When.START and not world.after_spin and not world.in_thread
    if is_set_up and world.is_program and not world.in_callback and not world.retelling:
        begun = None if world.open_loops else len(world.spins)
        wait = OutsideWait('a polling loop', None, place, in_thread=False, begun=begun)
        world.outside.append(replace(wait, names=frozenset(names)))


def _unwritten(wait: OutsideWait, world: World) -> Iterator[Diagnostic]:
    """Only callbacks write what a loop looks at, and nobody serves them meanwhile."""
    if any(_writes(state.deeds, wait.names) for state in world.activities):
        return
    served = (*world.entities, *world.builtins)
    nodes = [each.node for each in served if _writes(each.deeds, wait.names)]
    is_spun = any(node is each for node in nodes for each in spun_beside(wait, world))
    if not nodes or is_spun or data_is_written_elsewhere(world, wait.names) is not None:
        return
    yield _waits_for_ever(wait, min(wait.names), has_node=True, is_meant=False)


def _writes(deeds: Deeds | None, names: frozenset[str]) -> bool:
    return deeds is not None and any(access.name in names for access in deeds.writes)


def _needed(
    wait: OutsideWait, client: EntityState, world: World
) -> Iterator[tuple[Instance, str]]:
    """The nodes that must be spun, with what each is needed for."""
    if wait.call == _RATE:
        yield client.node, 'has it'
        return
    yield client.node, 'must take it'
    kind, key = SERVER_KINDS[client.kind], client.key
    servers = [e for e in world.entities if e.kind is kind and _is_same(e.key, key)]
    if len(servers) == 1:
        yield servers[0].node, 'must give it'


def _is_same(one: Value | None, other: Value | None) -> bool:
    return isinstance(one, Const) and isinstance(other, Const) and one.value == other.value


def spun_beside(wait: OutsideWait, world: World) -> Iterator[Instance]:
    """The nodes that other threads spin."""
    for _, nodes in spins_beside(wait, world):
        yield from nodes


def spins_beside(wait: OutsideWait, world: World) -> Iterator[tuple[Spin, tuple[Instance, ...]]]:
    """The spins of other threads, with their nodes; which thread is which is not told apart."""
    for number, spin in enumerate(world.spins.values()):
        is_later = wait.begun is not None and number >= wait.begun
        is_beside = (spin.in_thread or wait.in_thread) and not is_later
        if is_beside and not is_over(spin, number, wait, world):
            entries = spin.executor.slots.get('__nodes__', ())
            added = [each for entry in entries for each in options_of(entry)]
            yield spin, (*spin.nodes, *(each for each in added if isinstance(each, Instance)))


def _unanswered(wait: OutsideWait, client: EntityState, what: str) -> Diagnostic:
    key = client.key
    name = f' of {key.value!r}' if isinstance(key, Const) else ''
    call = 'a busy loop' if wait.call == 'busy wait' else wait.call
    awaited = 'a timer' if wait.call == _RATE else f'the answer{name}'
    return Diagnostic(
        severity=Severity.ERROR,
        slug='nobody-spins',
        place=wait.place,
        message=f'{call} waits for {awaited} while nobody spins the node that {what}: '
        'it waits for ever',
        help='use time.sleep, or spin the node in a thread before, and only there'
        if wait.call == _RATE
        else 'spin the nodes concerned in a thread before, and only there, or wait by '
        'spin_until_future_complete on an executor that has them',
    )
