"""
What callbacks and threads end while it is served: nodes, entities, executors, rclpy itself.

Measured on rclpy 3.3.21 (its ``executors.py`` and ``task.py`` over those of 7.1.6), 7.1.6 and
9.1.2: a callback that shuts rclpy down under ``rclpy.spin``, or shuts down the single-threaded
executor that runs it, waits for its own end on 3.3 and goes on later; a publisher raises when
rclpy is shut down; a subscription destroyed while another thread spins it ends that spin by
``InvalidHandle``, after 7 to 268 of them on 7.1.6 and after 23 and 153 on 9.1.2. What raises are
its QoS events, which are waitables beside it (``event_handler.py``, ``add_to_wait_set``). Of
timers, services and clients, which have none, no spin ended in 3,756, 3,022 and 1,315 rounds on
7.1.6, nor in 3,728, 2,781 and 1,151 on 9.1.2: who takes from one catches that it is destroyed.
On 3.3.21 nobody does (``executors.py``, ``_take_timer``): one spin ended after 1,413 timers.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import EntityRef
from ros2cc_extract.extract.static.libraries.rclpy.machine.end_operations import (
    DESTROY,
    DESTROY_NODE,
    DESTROY_PUBLISHER,
    OF_RATE,
    REMOVE_NODE,
    SHUTDOWN,
    SHUTDOWN_EXECUTOR,
    USED,
    executor_of,
)
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    End,
    EntityState,
    RosWorld,
    Spin,
    nodes_of,
)
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog
from ros2cc_extract.extract.static.python.values.values import (
    Bound,
    Const,
    Function,
    Instance,
)
from ros2cc_extract.extract.static.units.whole_program.destroyed_publishers import (
    published_meanwhile,
    used_behind_the_node,
)
from ros2cc_extract.extract.static.units.whole_program.threads_in_turn import go_in_turn
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import ActivityKind, EntityKind, When

_SINGLE = 'SingleThreadedExecutor'
_CAUGHT_WHERE_TAKEN = (
    EntityKind.TIMER,
    EntityKind.CLIENT,
    EntityKind.SERVICE,
    EntityKind.GUARD_CONDITION,
)
_TASKS = (EntityKind.TASK, EntityKind.DONE_CALLBACK, EntityKind.ACTION_EXECUTE)
_GOING = frozenset({'exit', '_exit', 'quit', 'shutdown', 'try_shutdown'})


def note_ends(world: RosWorld) -> None:
    """Report, after all was followed, what is no longer served."""
    found = (diagnostic for end in world.ends for diagnostic in _diagnostics(end, world))
    behind = (each for end in world.node_ends for each in used_behind_the_node(end, world))
    world.diagnostics.extend(dict.fromkeys((*found, *behind)))


def _diagnostics(end: End, world: RosWorld) -> Iterator[Diagnostic]:
    doer = end.doer
    if isinstance(doer, EntityState):
        if end.kind == USED:
            yield _used(end)
        elif end.kind in (SHUTDOWN, SHUTDOWN_EXECUTOR) and _waits_for_itself(end, doer, world):
            yield _waits_for_its_end(end)
        elif end.kind == SHUTDOWN_EXECUTOR and end.what is executor_of(doer.node):
            yield _ends_its_executor(end)
        elif end.kind in (DESTROY_NODE, REMOVE_NODE) and _leaves_nothing(end, doer, world):
            yield _serves_nothing(end)
        if end.kind == SHUTDOWN and doer.kind is EntityKind.SERVICE:
            yield _answers_no_more(end)
    if end.kind == DESTROY and isinstance(end.what, EntityState):
        yield from _destroyed(end, end.what, world)
    if end.kind == DESTROY_PUBLISHER and isinstance(end.what, Instance):
        yield from published_meanwhile(end, end.what, world)


def _spins_of(executor: Instance | None, world: RosWorld) -> list[Spin]:
    return [spin for spin in world.spins.values() if spin.executor is executor]


def _waits_for_itself(end: End, doer: EntityState, world: RosWorld) -> bool:
    """
    Whether the shutdown waits for the callback that calls it.

    It waits for what the executor does with an entity, and for no task. Source: rclpy 3.3.21,
    ``executors.py`` (``_make_handler`` alone enters the work tracker); run on 3.3.21.
    """
    executor = executor_of(doer.node)
    if doer.kind in _TASKS or end.is_limited:
        return False
    if executor is None or executor.state.kind != _SINGLE or not _spins_of(executor, world):
        return False
    if end.kind == SHUTDOWN_EXECUTOR:
        return end.what is executor
    return bool(executor.state.is_global)


def _leaves_nothing(end: End, doer: EntityState, world: RosWorld) -> bool:
    """Whether the node ends in its own callback, and its executor, spun forever, had no other."""
    executor = executor_of(doer.node)
    spins = _spins_of(executor, world)
    if executor is None or end.what is not doer.node or not spins:
        return False
    served = {id(node) for spin in spins for node in (*spin.nodes, *nodes_of(executor))}
    is_alone = served <= {id(doer.node)}
    return all(spin.for_ever for spin in spins) and is_alone and not _goes(doer, world)


def _goes(doer: EntityState, world: RosWorld) -> bool:
    """Whether the callback ends the program as well, or adds its node somewhere."""
    effects = doer.effects or EffectLog()
    if any(act.name == 'add_node' for act in effects.changes):
        return True
    if any(e.doer is doer and e.kind in (SHUTDOWN, SHUTDOWN_EXECUTOR) for e in world.ends):
        return True
    callback = doer.callback
    function = callback.function if isinstance(callback, Bound) else callback
    parts = _parts_reached(function) if isinstance(function, Function) else ()
    return any(isinstance(part, ast.Raise) or _called(part) in _GOING for part in parts)


def _parts_reached(function: Function) -> Iterator[ast.AST]:
    """What stands in a function, and in the methods of its class that it calls by their names."""
    body = function.owner.node.body if function.owner is not None else []
    methods = {each.name: each for each in body if isinstance(each, ast.FunctionDef)}
    left, seen = [function.node], set[ast.AST]()
    while left:
        node = left.pop()
        if node not in seen:
            seen.add(node)
            parts = list(ast.walk(node))
            yield from parts
            left += [methods[name] for part in parts if (name := _called(part)) in methods]


def _called(part: ast.AST) -> str:
    function = part.func if isinstance(part, ast.Call) else None
    if isinstance(function, ast.Attribute):
        return function.attr
    return function.id if isinstance(function, ast.Name) else ''


def _destroyed(end: End, entity: EntityState, world: RosWorld) -> Iterator[Diagnostic]:
    waits = [block for block in _waits_on(entity, end, world) if block.seconds is None]
    if waits:
        yield _awaited(end, entity, waits[0])
        return
    if entity.library == OF_RATE:
        return
    executor = executor_of(entity.node)
    spins = [spin for spin in _spins_of(executor, world) if not _is_over(spin, end)]
    if executor is None or not spins or executor.state.kind == 'EventsExecutor':
        return
    is_by_callback = isinstance(end.doer, EntityState)
    if _is_main(end.doer) and not any(spin.in_thread for spin in spins):
        return
    if isinstance(end.doer, ActivityState) and not _is_spun_beside(end.doer, spins, world):
        return
    has_pool = executor.state.threads != 1
    is_of_other = is_by_callback and executor_of(end.doer.node) is not executor  # type: ignore[union-attr]
    if has_pool or is_of_other or not is_by_callback:
        yield _destroyed_meanwhile(end, entity, executor, _is_done_again(end, world))


def _is_over(spin: Spin, end: End) -> bool:
    """
    Whether the program has waited for the thread that spins.

    A limit is no matter once the executor is shut down: the spin takes its handles no more.
    Source: rclpy 7.1.6, ``executors.py`` (``_is_shutdown`` is asked before each round).
    """
    if not _is_main(end.doer) or spin.by is None or spin.by.count != 1 or not spin.by.runners:
        return False
    joined = {id(over.what) for over in end.over}
    for join in end.timed_joins:
        if any(over.what in (None, spin.executor) for over in join.over):
            joined.add(id(join.thread))
    return all(id(runner) in joined for runner in spin.by.runners)


def _is_spun_beside(doer: ActivityState, spins: Sequence[Spin], world: RosWorld) -> bool:
    """Whether other code spins meanwhile."""
    others = (spin.by for spin in spins if spin.by is not doer or doer.count != 1)
    return not all(go_in_turn(world, other, doer) for other in others)


def _is_main(doer: object) -> bool:
    return isinstance(doer, ActivityState) and doer.kind is ActivityKind.MAIN


def _is_done_again(end: End, world: RosWorld) -> bool:
    """
    Whether entities come and go there while the program runs.

    One of the set-up goes once, and one of a life-cycle transition with each turn of that.
    """
    gone = [each.what for each in world.ends if each.kind == DESTROY and each.place == end.place]
    made = [each for each in world.entities if each.maker is end.doer]
    return any(_comes_again(each) for each in (*gone, *made) if isinstance(each, EntityState))


def _comes_again(entity: EntityState) -> bool:
    is_of_set_up = entity.when is When.START
    is_of_set_up = is_of_set_up and (entity.maker is None or _is_main(entity.maker))
    return not is_of_set_up and entity.when is not When.CONFIGURE


def _waits_on(entity: EntityState, end: End, world: RosWorld) -> Iterator[Blocking]:
    """Calls of others that wait for the answer which ``entity`` takes."""
    doers: tuple[EntityState | ActivityState, ...] = (*world.entities, *world.activities)
    for doer in doers:
        if doer is end.doer or doer.effects is None:
            continue
        for block in doer.effects.blocking:
            is_call = block.call in ('client.call', 'send_goal')
            if is_call and isinstance(block.on, EntityRef) and block.on.number == id(entity):
                yield block


def _used(end: End) -> Diagnostic:
    return Diagnostic(
        severity=Severity.ERROR,
        slug='served-no-more',
        place=end.place,
        message=f'a callback shuts rclpy down, and then {end.text}: that raises an '
        'exception and ends the spin',
        help='shut down last, or let the code after the spin do it',
    )


def _waits_for_its_end(end: End) -> Diagnostic:
    what = 'rclpy' if end.kind == SHUTDOWN else 'the executor that runs it'
    return Diagnostic(
        severity=Severity.NOTE,
        slug='shut-down-in-callback',
        place=end.place,
        message=f'a callback shuts down {what} and waits for its own end: on Humble (rclpy 3.3) '
        'it never returns',
        help='make a future done and spin until that, or raise SystemExit; shut down after the '
        'spin',
    )


def _answers_no_more(end: End) -> Diagnostic:
    return Diagnostic(
        severity=Severity.WARNING,
        slug='answer-after-shutdown',
        place=end.place,
        message='a service callback shuts rclpy down before its response is sent: from rclpy 9.0 '
        '(Kilted) on that destroys its node, and sending the response raises InvalidHandle, which '
        'ends the spin',
        help='make a future done and spin until that; shut down after the spin',
    )


def _ends_its_executor(end: End) -> Diagnostic:
    return Diagnostic(
        severity=Severity.NOTE,
        slug='served-no-more',
        place=end.place,
        message='a callback shuts down the executor that runs it: the spin ends, perhaps before '
        'this callback, and none of its callbacks runs again',
        help='make a future done and spin until that; shut down behind the spin',
    )


def _serves_nothing(end: End) -> Diagnostic:
    does = (
        'destroys its node' if end.kind == DESTROY_NODE else 'removes its node from the executor'
    )
    return Diagnostic(
        severity=Severity.WARNING,
        slug='served-no-more',
        place=end.place,
        message=f'a callback {does}: none of its callbacks runs again, and the spin continues '
        'with nothing to serve',
        help='end the spin instead: make a future done and spin until that, or raise SystemExit',
    )


def _awaited(end: End, entity: EntityState, wait: Blocking) -> Diagnostic:
    name = f' {entity.key.value!r}' if isinstance(entity.key, Const) else ''
    return Diagnostic(
        severity=Severity.ERROR,
        slug='served-no-more',
        place=end.place,
        message=f'client{name} is destroyed here while {wait.call} may wait for its answer '
        f'({wait.source}): nothing takes that answer any more, and it never returns',
        help='keep the client for as long as the program runs',
    )


def _destroyed_meanwhile(
    end: End, entity: EntityState, executor: Instance, is_done_again: bool
) -> Diagnostic:
    kind = entity.kind.value.replace('_', ' ')
    is_caught = entity.kind in _CAUGHT_WHERE_TAKEN
    ends = 'on Humble (rclpy 3.3) that spin' if is_caught else 'that spin'
    return Diagnostic(
        severity=Severity.WARNING if is_done_again and not is_caught else Severity.NOTE,
        slug='destroyed-while-spun',
        place=end.place,
        message=f'this {kind} is destroyed while another thread spins '
        f'{executor.hint or "its executor"}: {ends} may raise InvalidHandle',
        help='keep it and let its callback do nothing, or destroy it when nobody spins',
    )
