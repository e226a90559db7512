"""Clients, futures, timers, rates and publishers: what set-up code and callbacks do with them."""

from __future__ import annotations

from ros2cc_extract.extract.static.concurrency.accesses.lost_notifications import note_begun
from ros2cc_extract.extract.static.libraries.rclpy.machine import lost_tasks, message_waits
from ros2cc_extract.extract.static.libraries.rclpy.machine.end_operations import (
    CANCEL,
    note_end,
    note_published,
    note_use,
)
from ros2cc_extract.extract.static.libraries.rclpy.machine.machine import RosMachine
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import EntityState
from ros2cc_extract.extract.static.libraries.rclpy.tables.clocks import note_sleep
from ros2cc_extract.extract.static.libraries.rclpy.tables.nodes import mark_destroyed
from ros2cc_extract.extract.static.libraries.standard.done_callbacks import (
    add_done_callback,
    begin_anew,
    cancel,
    complete,
    init_future,
)
from ros2cc_extract.extract.static.libraries.standard.futures import waited_for
from ros2cc_extract.extract.static.program.retried_calls import is_retried
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.machine.library_table import Library, LibraryClass
from ros2cc_extract.extract.static.python.machine.path_facts import (
    Word,
    answer,
    cancelled,
    running,
)
from ros2cc_extract.extract.static.python.machine.waitable_objects import OF_POOL
from ros2cc_extract.extract.static.python.machine.world import Cut, note_once
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Call,
    Const,
    Handler,
    Instance,
    Value,
)
from ros2cc_extract.extract.static.python.values.values import Library as Name
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.effects import CANCELS, Act
from ros2cc_extract.spec.model import When


def _blocking(name: str, position: int | None) -> Handler:
    def handler(machine: RosMachine, receiver: Value, call: Call) -> Value:
        timeout = call.argument(position, 'timeout_sec')
        machine.note_blocking(name, receiver, timeout, call.place)
        return machine.mystery(f'result of {name}', call.place, name)

    return handler


def note_presence(machine: RosMachine, name: str, receiver: Value, call: Call) -> None:
    """
    A service or a server is waited for, which may be absent forever.

    A loop that asks again after each time-out has none; so it is told in a callback.
    """
    timeout = call.argument(0, 'timeout_sec')
    asking = machine.stack[-1].node if machine.stack else None
    if asking is not None and is_retried(asking, call.place):
        machine.world.asked_until.add(call.place)
        timeout = None if machine.world.in_callback else timeout
    machine.note_blocking(name, receiver, timeout, call.place)


def _wait_for_service(machine: RosMachine, receiver: Value, call: Call) -> Value:
    note_presence(machine, 'wait_for_service', receiver, call)
    return machine.mystery('result of wait_for_service', call.place, 'wait_for_service')


def _call_async(machine: RosMachine, receiver: Value, call: Call) -> Value:
    return machine.future(call.place, 'client', receiver)


def _goal_of_unknown(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """Its feedback callback runs in the group of a client that is not known."""
    if call.argument(1, 'feedback_callback') is not None:
        reason = 'feedback callback of an action client that could not be followed'
        note_once(machine.world.cut, Cut(reason, call.place, machine.running_classes()))
    return machine.future(call.place, 'goal', receiver)


UNKNOWN_CLIENT: dict[str, Handler] = {
    'call_async': _call_async,
    'send_goal_async': _goal_of_unknown,
}
"""Methods by which a value that could not be followed is known to be a client."""


def _cancel(machine: RosMachine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Instance)
    world, entity = machine.world, receiver.state
    if not isinstance(entity, EntityState):
        return NONE
    entity.cancelled = True
    if entity is world.current:
        if world.path == world.callback_path:
            entity.one_shot = True
            if world.effects is not None and world.effects.blocking:
                act = Act(name=CANCELS, source=call.place, chain=world.chain[1:])
                note_once(world.effects.changes, act)
    elif world.when is When.START and not world.in_callback and world.activity is None:
        is_early = not world.after_spin and not world.path
        entity.dormant = call.place if is_early else entity.dormant
    else:
        note_end(machine, CANCEL, entity, call.place)
    return NONE


def _reset(machine: RosMachine, receiver: Value, call: Call) -> Value:
    if isinstance(receiver, Instance) and isinstance(receiver.state, EntityState):
        receiver.state.restarted = True
        note_begun(machine.world, receiver.state.place)
    return NONE


def _destroy(machine: RosMachine, receiver: Value, call: Call) -> Value:
    if isinstance(receiver, Instance) and isinstance(receiver.state, EntityState):
        mark_destroyed(machine, receiver.state, call.place)
    return NONE


def _publish(machine: RosMachine, receiver: Value, call: Call) -> Value:
    machine.note_publish(receiver, call.place)
    note_use(machine, 'a message is published', call.place)
    note_published(machine, receiver, call.place)
    return NONE


def _future_result(machine: RosMachine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Instance)
    if receiver.state.kind == OF_POOL:
        awaited, timeout = waited_for(machine, receiver), call.argument(0, 'timeout')
        machine.note_blocking('Future.result', awaited, timeout, call.place)
    lost_tasks.note_asked_at_once(machine.world, receiver, call.place)
    return result_of(machine, receiver, call.place)


def _future_exception(machine: RosMachine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Instance)
    if receiver.state.kind == OF_POOL:
        timeout = call.argument(0, 'timeout')
        machine.note_blocking(
            'Future.exception', waited_for(machine, receiver), timeout, call.place
        )
    return machine.mystery('exception of a future', call.place, 'exception()')


def _future_done(machine: RosMachine, receiver: Value, call: Call) -> Value:
    return answer(receiver, Word.SET, call)


def _future_cancelled(machine: RosMachine, receiver: Value, call: Call) -> Value:
    return cancelled(receiver, call)


def _future_running(machine: RosMachine, receiver: Value, call: Call) -> Value:
    return running(receiver, call)


def result_of(machine: RosMachine, future: Instance, place: Place) -> Value:
    """What a future gives: a goal handle for a goal that was sent, else a mystery."""
    if future.state.kind != 'goal':
        return machine.mystery(f'result of a {future.state.kind} future', place, 'result()')
    handle = Instance(Name('rclpy.action.client.ClientGoalHandle'), place)
    handle.state = PlainState('goal handle', of=future.state.of, place=place)
    return handle


def _goal_future(kind: str) -> Handler:
    def handler(machine: RosMachine, receiver: Value, call: Call) -> Value:
        assert isinstance(receiver, Instance)
        return machine.future(call.place, kind, receiver.state.of)

    return handler


def _get_result(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """Blocks until the goal has ended (``action/client.py``, ``get_result``)."""
    machine.note_blocking('get_result', receiver, None, call.place)
    return machine.mystery('result of a goal', call.place, 'get_result()')


def future_class(kind: str) -> LibraryClass:
    """rclpy's futures."""
    return LibraryClass(
        state=lambda machine, instance: PlainState(kind, place=instance.place),
        init=init_future,
        again=begin_anew,
        methods={
            'add_done_callback': add_done_callback,
            'result': _future_result,
            'exception': _future_exception,
            'done': _future_done,
            'cancelled': _future_cancelled,
            'running': _future_running,
            'cancel': cancel,
            'set_result': complete,
            'set_exception': complete,
        },
    )


_ENTITY: dict[str, Handler] = {'destroy': _destroy}


def _sleep_by_rate(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """A timer of the node wakes it; where the time is simulated, that waits for its clock."""
    state = receiver.state if isinstance(receiver, Instance) else None
    if isinstance(state, EntityState):
        note_sleep(machine, 'Rate.sleep', state.node, call.place)
    return _blocking('Rate.sleep', None)(machine, receiver, call)


def _absent(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """A method of ROS 1 that rclpy has not (``timer.py``): what stands behind never runs."""
    machine.stop_program()
    return NONE


def _destroy_rate(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """Wake the code that sleeps by it; its timer stays (``timer.py``, ``Rate.destroy``)."""
    state = receiver.state if isinstance(receiver, Instance) else None
    machine.world.given.setdefault(id(state), Unknown('somebody destroys the rate', call.place))
    return NONE


def _wait_for_message(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """It takes the message itself, in the thread that waits (``taken_messages.py``)."""
    topic = Instance(Name('rclpy.topic'), call.place)
    topic.state = PlainState('topic', call.argument(2, 'topic'), place=call.place)
    timeout = call.argument(None, 'time_to_wait')
    if (
        isinstance(timeout, Const)
        and isinstance(timeout.value, (int, float))
        and timeout.value < 0
    ):
        timeout = None
    machine.note_blocking('wait_for_message', topic, timeout, call.place)
    node, has_limit = call.argument(1, 'node'), timeout not in (None, NONE)
    message_waits.note(machine.world, node, call.place, has_limit=has_limit)
    return machine.mystery('a message at run time', call.place, 'wait_for_message(…)')


TABLE = Library(
    classes={
        'rclpy.timer.Timer': LibraryClass(
            methods={'cancel': _cancel, 'reset': _reset, 'shutdown': _absent, **_ENTITY}
        ),
        'rclpy.timer.Rate': LibraryClass(
            methods={'sleep': _sleep_by_rate, 'destroy': _destroy_rate}
        ),
        'rclpy.subscription.Subscription': LibraryClass(methods=_ENTITY),
        'rclpy.service.Service': LibraryClass(methods=_ENTITY),
        'rclpy.guard_condition.GuardCondition': LibraryClass(methods=_ENTITY),
        'rclpy.client.Client': LibraryClass(
            methods={
                'call': _blocking('client.call', 1),
                'call_async': _call_async,
                'wait_for_service': _wait_for_service,
                **_ENTITY,
            }
        ),
        'rclpy.action.client.ClientGoalHandle': LibraryClass(
            state=lambda machine, instance: PlainState('goal handle', place=instance.place),
            methods={
                'get_result_async': _goal_future('result'),
                'cancel_goal_async': _goal_future('cancel'),
                'get_result': _get_result,
            },
        ),
        'rclpy.publisher.Publisher': LibraryClass(methods={'publish': _publish}),
        'rclpy.task.Future': future_class('future'),
        'rclpy.task.Task': future_class('task'),
    },
    functions={'rclpy.wait_for_message.wait_for_message': _wait_for_message},
    aliases={'rclpy.Future': 'rclpy.task.Future', 'rclpy.Task': 'rclpy.task.Task'},
)
