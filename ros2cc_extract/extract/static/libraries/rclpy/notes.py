"""What a machine that models rclpy notes, and knows of objects whose use alone is seen."""

from __future__ import annotations

import ast

from ros2cc_extract.extract.static.concurrency.accesses import lost_notifications
from ros2cc_extract.extract.static.concurrency.activities import run_in_thread
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import DataRef, MessageRef
from ros2cc_extract.extract.static.concurrency.waits import cleared_events, outside_waits
from ros2cc_extract.extract.static.concurrency.waits.blocking_calls import is_main
from ros2cc_extract.extract.static.concurrency.waits.unknown_waits import called_name
from ros2cc_extract.extract.static.libraries.rclpy.machine import end_operations, lost_tasks
from ros2cc_extract.extract.static.libraries.rclpy.machine.assumptions import assumption
from ros2cc_extract.extract.static.libraries.rclpy.machine.durations import (
    CLOCKS,
    slept,
    time_from_now,
)
from ros2cc_extract.extract.static.libraries.rclpy.machine.machine import RosMachine
from ros2cc_extract.extract.static.libraries.rclpy.machine.settled_loops import is_over_before
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    EntityState,
    ExecutorState,
    NodeState,
)
from ros2cc_extract.extract.static.libraries.rclpy.tables.async_nodes import (
    loop_node,
    node_of_loop,
)
from ros2cc_extract.extract.static.libraries.rclpy.tables.clients import (
    UNKNOWN_CLIENT,
    result_of,
)
from ros2cc_extract.extract.static.libraries.rclpy.tables.clocks import serve
from ros2cc_extract.extract.static.libraries.rclpy.tables.executors import add_node, node_executor
from ros2cc_extract.extract.static.libraries.rclpy.tables.nodes import (
    CREATE_CALLS,
    NODE,
    ghost_node,
    make_node,
)
from ros2cc_extract.extract.static.libraries.rclpy.tables.tasks import add_task, note_its_end
from ros2cc_extract.extract.static.libraries.standard.asyncio_loops import (
    IN_TASK,
    STARTED,
    coroutine_of,
)
from ros2cc_extract.extract.static.libraries.standard.context_exits import StandardBlocks
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.machine.library_table import AWAITED
from ros2cc_extract.extract.static.python.machine.recorded_effects import Doer
from ros2cc_extract.extract.static.python.machine.waitable_objects import OF_LOOP, OF_POOL
from ros2cc_extract.extract.static.python.machine.world import note_once
from ros2cc_extract.extract.static.python.objects.library_calls import is_standard
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Call,
    Class,
    Const,
    Instance,
    Library,
    Mystery,
    Native,
    Value,
)
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.effects import ABORTS, Act
from ros2cc_extract.spec.model import EntityKind

_ENTITY_ONLY = frozenset((*CREATE_CALLS, 'create_rate'))
_NODE_ONLY = _ENTITY_ONLY | {'create_publisher'}

_SPINS = frozenset(
    {'spin', 'spin_until_future_complete', 'rclpy.spin', 'rclpy.spin_until_future_complete'}
)


class RosNotes(StandardBlocks, RosMachine):
    """Nodes, spins, messages, and what is known of rclpy beside its tables."""

    def other_member(
        self, cls: Library, receiver: Value | None, name: str, place: Place
    ) -> Value | None:
        """``node.executor``, of a class that is known only by name."""
        if not isinstance(receiver, Instance) or not isinstance(receiver.state, NodeState):
            return None
        if not cls.name.startswith('rclpy.') or name != 'executor':
            return None
        return node_executor(self, receiver, place)

    def member_of_unknown_base(
        self, order: tuple[Value, ...], receiver: Value, name: str, place: Place
    ) -> Value | None:
        """A node's method on a class with an unknown base makes it a node."""
        if not isinstance(receiver, Instance):
            return None
        if name in _NODE_ONLY:
            self.become_node(receiver)
        if not isinstance(receiver.state, NodeState) or self._unknown_base(receiver) is None:
            return None
        return self.library_member(Library(NODE), receiver, name, place)

    def become_node(self, instance: Instance) -> Instance | None:
        """Treat an instance of a class with an unknown base as the node it is used as."""
        if isinstance(instance.state, NodeState):
            return instance
        base = self._unknown_base(instance)
        if base is None or instance.state is not None:
            return None
        instance.state = make_node(self, instance)
        name = base.name if isinstance(base, Library) else 'which could not be followed'
        at = instance.cls.place if isinstance(instance.cls, Class) else instance.place
        instance.state.more.append((f'its base class {name} is not scanned and may add more', at))
        return instance

    def _unknown_base(self, instance: Instance) -> Value | None:
        for cls in instance.mro:
            if isinstance(cls, Class):
                continue
            if not isinstance(cls, Library):
                return cls
            if not is_standard(cls.name) and not cls.name.startswith('builtins.'):
                return cls if not self.model.rows(cls.name) else None
        return None

    def member_of_mystery(self, value: Mystery, name: str, place: Place) -> Value | None:
        """Attribute ``name`` of a value that must be a node, or a client."""
        if name in UNKNOWN_CLIENT and not _is_no_node(value):
            return Native(name, UNKNOWN_CLIENT[name], value)
        if name in _ENTITY_ONLY and value.text and not _is_no_node(value):
            return self.library_member(Library(NODE), ghost_node(self, value), name, place)
        return None

    def library_operation(self, op: ast.operator, left: Value, right: Value) -> Value | None:
        """``clock.now() + Duration(…)``."""
        return time_from_now(op, left, right)

    def awaited(self, future: Instance, place: Place) -> Value | None:
        """What awaiting a future gives."""
        return result_of(self, future, place)

    def takes_over(self, function: Native, arguments: list[Value], place: Place) -> bool:
        """Whether it is a spin: code that is given one runs it, with what is handed along."""
        if function.name not in _SPINS:
            return False
        run_in_thread(self, function, Call(place, arguments))
        return True

    def assumption(self, fact: str, value: Mystery) -> str:
        """The rule by which ``fact`` is assumed to be the default of ``value``."""
        return assumption(fact, value)

    def objects_made(self) -> int:
        """How many nodes there are."""
        return len(self.world.nodes)

    def doubt_objects(self, since: int, reason: str, place: Place) -> None:
        """A node that was made since then may be an older one."""
        for node in self.world.nodes[since:]:
            assert isinstance(node.state, NodeState)
            node.state.doubt(reason, place)

    def doubt_calls(self, since: int, why: str, place: Place) -> None:
        """What code that is not scanned has kept is a node of an earlier call."""
        self.doubt_objects(since, f'{why} and may give the node of an earlier call', place)

    def future(self, place: Place, kind: str, of: Value | None = None) -> Instance:
        """A new future of ``kind``."""
        made = Instance(Library('rclpy.task.Future'), place)
        made.state, made.born = PlainState(kind, of=of, place=place), self.world.effects
        return made

    def add_task(self, future: Instance, callback: Value, place: Place) -> None:
        """An executor runs it when it has taken the answer."""
        state = future.state
        source = state.of.state if isinstance(state.of, Instance) else None
        node = source.node if isinstance(source, EntityState) else None
        key = source.key if isinstance(source, EntityState) else None
        task = add_task(self, node, callback, place, EntityKind.DONE_CALLBACK, key)
        if task is not None:
            task.argument = future

    @property
    def runs_on_loop(self) -> bool:
        """Whether a loop of asyncio runs what is followed, as it runs callbacks."""
        return loop_node(self.world) is not None

    def task_of_loop(
        self, coroutine: Value, place: Place, loop: Value | None = None
    ) -> Value | None:
        """A task of the loop that runs nodes."""
        node = loop_node(self.world) if loop is None else node_of_loop(self.world, loop)
        if node is None:
            return None
        inside = coroutine.slots if isinstance(coroutine, Instance) else {}
        beside = inside.get(IN_TASK)
        if isinstance(beside, Native):
            self.call(beside, Call(place))
            # As long as the program is meant to run, it is awaited.
            task = coroutine_of('task', lambda machine, receiver, call: NONE, Call(place))
            task.slots[STARTED] = NONE
            return task
        add_task(self, node, inside.get(AWAITED, coroutine), place)
        task = self.future(place, OF_LOOP if loop is None else OF_POOL)
        note_its_end(self, task, place)
        return task

    def note_held(self, owner: Value, name: str, value: Value) -> None:
        """``node.executor = executor`` adds the node (``node.py``, the setter of ``executor``)."""
        super().note_held(owner, name, value)
        is_node = isinstance(owner, Instance) and isinstance(owner.state, NodeState)
        if is_node and name == 'executor' and isinstance(value, Instance):
            assert isinstance(owner, Instance)
            if isinstance(value.state, ExecutorState):
                add_node(self, value, owner)

    def is_over(self, node: ast.While, frame: Frame) -> bool:
        """A callback may be made only behind a loop that its method comes to again."""
        return is_over_before(self.world, node, frame.place(node).file)

    def note_discarded(self, value: Value, place: Place) -> None:
        """A coroutine or a task may be lost."""
        lost_tasks.note_discarded(self.world, value, place)

    def note_raised(self, error: ast.expr, place: Place) -> None:
        """What a callback raises may end the spin that runs it."""
        super().note_raised(error, place)
        end_operations.note_raised(self, error, place)

    def note_call(self, function: Value, node: ast.Call, frame: Frame) -> None:
        """``goal_handle.abort()`` of an unknown goal: it stops one that runs."""
        super().note_call(function, node, frame)
        effects, called = self.world.effects, node.func
        is_abort = isinstance(called, ast.Attribute) and called.attr == ABORTS
        if effects is not None and is_abort and isinstance(function, Mystery):
            act = Act(name=ABORTS, source=frame.place(node), chain=self.world.chain[1:])
            note_once(effects.changes, act)

    def note_clock_call(self, call: Call) -> bool:
        """The clock of a node is not followed: its methods wait by their names."""
        clock = CLOCKS.get(called_name(call))
        if clock is not None:
            self.note_blocking(clock, None, slept(call), call.place)
        return clock is not None

    def note_messages(
        self, name: str, brings: Doer, place: Place, on: DataRef | None = None
    ) -> None:
        """Note a wait for what ``brings`` takes, or for data beside it."""
        if isinstance(brings, EntityState) and brings.builtin:
            serve(self.world, brings)
        if self.world.effects is None or is_main(self.world.activity):
            outside_waits.note_messages(self.world, name, brings, place)
        if self.world.effects is None:
            return
        reference = MessageRef(brings.topic)
        reference.number, reference.data = id(brings), on
        self.note_loop_on_data(name, reference, None, place)

    def note_publish(self, publisher: Value, place: Place) -> None:
        """A message is published."""
        effects = self.world.effects
        if effects is None or not isinstance(publisher, Instance):
            return
        key = publisher.state.key if isinstance(publisher.state, PlainState) else None
        name: str | Unknown = Unknown('topic that could not be followed', place)
        if isinstance(key, Const):
            name = str(key.value)
        elif isinstance(key, Mystery):
            name = key.unknown
        self.world.note_done(name, place)
        cleared_events.note_sent(effects, str(name))
        lost_notifications.note_begun(self.world, place)
        note_once(effects.publishes, Act(name=name, source=place, chain=self.world.chain[1:]))

    def note_change(self, what: str, node: Instance, place: Place) -> None:
        """A callback changes which executor serves ``node``."""
        if self.world.effects is not None:
            act = Act(name=what, source=place, chain=self.world.chain[1:])
            note_once(self.world.effects.changes, act)

    def note_nested_spin(
        self,
        how: str,
        node: Instance | None,
        executor: Value,
        future: tuple[Value | None, Value | None],
        place: Place,
        change: str = '',
    ) -> bool:
        """Whether a spin stands in a callback; then it is noted there and is no set-up."""
        if not self.world.in_callback:
            return False
        awaited, timeout = future
        spun = executor if node is None else node
        self.note_blocking(how, spun, timeout if awaited is None else None, place)
        if awaited is not None:
            self.note_blocking('spin for future', awaited, timeout, place)
        if node is not None:
            self.note_change(change, node, place)
        return True


def _is_no_node(value: Mystery) -> bool:
    """Mocks of tests and clients of other frameworks have methods of the same names."""
    text = f'{value.text} {value.unknown.reason}'.lower()
    return any(word in text for word in ('mock', 'simplenamespace', 'boto', 'session', 'requests'))
