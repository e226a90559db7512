"""
``rclpy.spin`` and its kin: they add a node to an executor, spin it, and take the node out.

Sources: rclpy 7.1.6, ``__init__.py`` (without an executor it is the global one; ``spin_once``
and ``spin_until_future_complete`` take out only a node that they have added, ``spin`` any).
"""

from __future__ import annotations

from typing import TypeGuard

from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.extract.static.concurrency.waits.uncalled_wakers import is_handed_on
from ros2cc_extract.extract.static.libraries.rclpy.machine.machine import RosMachine
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    LOOP_KIND,
    ExecutorState,
    nodes_of,
)
from ros2cc_extract.extract.static.libraries.rclpy.tables.executors import (
    Awaited,
    add_node,
    as_executor,
    as_node,
    future_of,
    global_executor,
    note_inside,
    note_served_inside,
    record_spin,
    remove_node,
)
from ros2cc_extract.extract.static.python.machine.library_table import Library
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Call,
    Handler,
    Instance,
    Value,
    options_of,
)
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import When
from ros2cc_extract.spec.node_moves import ADDED, ANY_EXECUTOR


def _module_spin(how: str, position: int | None, ever: bool) -> Handler:
    """``rclpy.spin`` and its kin: add the node, spin, take the node out again."""

    def spin(machine: RosMachine, receiver: Value, call: Call) -> Value:
        given = call.argument(0, 'node') or NONE
        executor = call.argument(position, 'executor')
        place = call.place

        def with_node(node_value: Value) -> Value:
            def with_executor(executor_value: Value) -> Value:
                future = future_of(call, 1, how)
                _spin_node(machine, node_value, executor_value, how, place, ever, future)
                return NONE

            return machine.each(executor if executor is not None else NONE, with_executor, place)

        machine.each(given, with_node, place)
        return machine.mystery(f'result of rclpy.{how}', place)

    return spin


def _nested(
    machine: RosMachine, node: Instance, given: Value, how: str
) -> tuple[str, Instance | None, str]:
    """
    What a callback does that spins ``node``: its name, what moves, and how.

    Nothing moves where the executor is named that serves the node, or that cannot be followed;
    nor where a node of no executor is spun on one that is named: it is as if that were spun.
    """
    if given == NONE:
        return f'rclpy.{how}', node, f'rclpy.{how}'
    current = machine.world.current
    is_own = current is not None and current.node is node
    serving = node.slots.get('__executor__') or (node.slots.get('__owner__') if is_own else None)
    if not _is_executor(given) or serving is given or (serving in (None, NONE) and not is_own):
        return f'executor.{how}', None, ''
    others = [other for other in nodes_of(given) if other is not node]
    is_plain = given.state.kind == 'SingleThreadedExecutor' and not others
    return f'rclpy.{how}', node, (given.state.kind if is_plain else ANY_EXECUTOR) + ADDED


def _is_executor(value: Value) -> TypeGuard[Instance]:
    return isinstance(value, Instance) and isinstance(value.state, ExecutorState)


def _spin_node(
    machine: RosMachine,
    node_value: Value,
    given: Value,
    how: str,
    place: Place,
    ever: bool,
    future: Awaited,
    *,
    is_for_library: bool = False,
) -> None:
    node = as_node(machine, node_value)
    if node is None or machine.world.second_pass:
        return
    call, moved, change = _nested(machine, node, given, how)
    if machine.note_nested_spin(call, moved, given, future, place, change):
        note_served_inside((node,), f'rclpy.{how}', place)
        spun = global_executor(machine) if given == NONE else given
        current = machine.world.current
        is_own = current is not None and current.node is node
        if _is_executor(spun) and not is_own:
            nodes = tuple(dict.fromkeys((*nodes_of(spun), node)))
            note_inside(
                machine,
                spun,
                f'rclpy.{how}',
                future[1],
                place,
                nodes,
                is_for_library=is_for_library,
            )
        return
    executor = global_executor(machine) if given == NONE else as_executor(machine, given, place)
    _warn_of_theft(machine, node, executor, how, place)
    stays = not ever and node in nodes_of(executor)
    add_node(machine, executor, node)
    # Nested spins recognise the global executor by this name.
    called = f'rclpy.{how}' if executor.state.is_global else how
    record_spin(machine, executor, called, place, ever, future[1], takes=True)
    machine.note_outside_wait(f'rclpy.{how}', *future, place, nodes_of(executor))
    if not stays and not (ever and machine.world.in_thread):
        remove_node(machine, executor, node)


def spin_in_passing(
    machine: RosMachine, node: Value, how: str, place: Place, timeout: Value | None = None
) -> None:
    """
    A library spins ``node`` by the global executor until something has come.

    :param timeout: after which it goes on in any case.
    """
    future = (None, timeout)
    _spin_node(machine, node, NONE, how, place, False, future, is_for_library=True)


def _warn_of_theft(
    machine: RosMachine, node: Instance, executor: Instance, how: str, place: Place
) -> None:
    old = node.slots.get('__executor__')
    for other in options_of(old) if isinstance(old, Value) else ():
        if not isinstance(other, Instance) or other is executor:
            continue
        if machine.world.when is When.LATER and not _is_spun_then(machine, other):
            continue
        if other.state.spun and _is_spun_no_more(machine, other):
            continue
        if other.state.kind == LOOP_KIND:
            machine.world.diagnostics.append(_refused(how, place))
            continue
        name = other.hint or 'executor'
        machine.world.diagnostics.append(
            Diagnostic(
                severity=Severity.WARNING,
                slug='executor-not-spun' if not other.state.spun else 'node-taken-out',
                place=place,
                message=f'rclpy.{how} removes the node from {name} ({other.state.kind}, '
                f'{other.place}) and runs it on '
                + (
                    'the global single-threaded executor'
                    if executor.state.is_global
                    else 'another'
                )
                + _afterwards(other, how),
                help=_instead(machine, other, name, how),
            )
        )


def _refused(how: str, place: Place) -> Diagnostic:
    """Source: rclpy 10.0.10: an ``AsyncNode`` lacks what an executor asks a node for."""
    return Diagnostic(
        severity=Severity.WARNING,
        slug='executor-not-spun',
        place=place,
        message=f'rclpy.{how} of an AsyncNode raises AttributeError: only a loop of asyncio '
        'runs it',
        help='`asyncio.run(node.run())`',
    )


def _is_spun_then(machine: RosMachine, executor: Instance) -> bool:
    """
    Whether a thread spins ``executor`` while code without a known caller runs.

    So it is where the program hands that on, as to a window, and the spin ends with rclpy or
    never. What no code names may be for use before the spin, or none at all.
    """
    world = machine.world
    spins = [s for s in world.spins.values() if s.executor is executor]
    goes_on = any(spin.in_thread and spin.for_ever for spin in spins)
    ends = [over.what for over in world.over if over.what in (None, executor)]
    is_whole = not ends or ends[0] is None
    name = machine.stack[0].name if machine.stack else ''
    return goes_on and is_whole and world.is_program and is_handed_on(world, name)


def _is_spun_no_more(machine: RosMachine, executor: Instance) -> bool:
    """Whether the set-up takes the node out when each spin of ``executor`` is over."""
    world = machine.world
    over = (
        number < world.spins_over or (spin.thread == 0 and spin.for_ever and not spin.repeated)
        for number, spin in enumerate(world.spins.values())
        if spin.executor is executor
    )
    return world.when is When.START and world.thread == 0 and all(over)


def _afterwards(executor: Instance, how: str) -> str:
    if how == 'spin' or not executor.state.spun:
        return ''
    return '; after that it is in none until somebody adds it again'


def _instead(machine: RosMachine, other: Instance, name: str, how: str) -> str:
    """What a thread spins already is not to be spun by a second one."""
    spins = machine.world.spins.values()
    if not any(spin.executor is other and spin.in_thread for spin in spins):
        return f'call {name}.{how}() or pass executor={name}'
    wait = ', and wait for the future by an Event that its done-callback sets'
    is_wait = how == 'spin_until_future_complete'
    return f'leave this out, a thread spins {name} already{wait if is_wait else ""}'


TABLE = Library(
    functions={
        'rclpy.spin': _module_spin('spin', 1, True),
        'rclpy.spin_once': _module_spin('spin_once', None, False),
        'rclpy.spin_until_future_complete': _module_spin('spin_until_future_complete', 2, False),
    },
)
