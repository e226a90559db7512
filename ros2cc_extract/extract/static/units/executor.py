"""The executor of a unit as a value of the specification."""

from __future__ import annotations

import ast
from dataclasses import field

from ros2cc_extract.extract.static.concurrency.machine.state import SetUpWait
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    LOOP_KIND,
    ExecutorState,
    RosWorld,
    Spin,
)
from ros2cc_extract.extract.static.program.text_queries import noted_on, walk
from ros2cc_extract.extract.static.python.values.exclusive_paths import NO_MARK, Mark, beyond
from ros2cc_extract.extract.static.python.values.values import Class, Instance, Library
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.model import NO_EXECUTOR, Executor

ASSUMED_THREADS = 2


@dataclass(eq=False)
class Unit:
    """
    An executor and the nodes it serves in the end.

    :param spin: the call that spins it, ``None`` if no such call is known.
    :param mark: distinguishes units if a program only ever runs one of them.
    :param is_only: the program has no other.
    :param set_up: waits of the code that sets it up or ends it.
    """

    executor: Instance | None
    nodes: list[Instance]
    spin: Spin | None
    mark: Mark = NO_MARK
    is_only: bool = False
    set_up: list[SetUpWait] = field(default_factory=list)

    @property
    def state(self) -> ExecutorState | None:
        """What is known of the executor."""
        state = self.executor.state if self.executor else None
        return state if isinstance(state, ExecutorState) else None

    @property
    def number_of_threads(self) -> int:
        """As many worker threads as the models get."""
        number = self.state.threads if self.state else 1
        return ASSUMED_THREADS if number is None else number

    @property
    def thread_names(self) -> tuple[str, ...]:
        """What those threads are called; that of a loop of asyncio is the loop."""
        if self.state is not None and self.state.kind == LOOP_KIND:
            return ('loop',)
        return tuple(f'thread_{number}' for number in range(self.number_of_threads))

    @property
    def executor_label(self) -> str:
        """What the program calls the executor."""
        return (self.executor.hint if self.executor and self.state else None) or 'executor'


def executor_of(
    unit: Unit, name: str, threads: tuple[str, ...], entry: str | None, world: RosWorld
) -> Executor:
    """The executor of ``unit``, which ``entry`` starts if any does."""
    state, spin = unit.state, unit.spin
    if state is None or unit.executor is None:
        why = _nested_spin(unit) or _own_wait_set(world)
        why = why or Unknown(NO_EXECUTOR, unit.nodes[0].place)
        return Executor(name=name, threads=threads, kind=why)
    unresolved = state.unknown or state.unresolved or state.threads_unresolved
    elsewhere = _spun_elsewhere(unit) if entry is None else None
    if spin is None and unresolved is None:
        reason = 'no call that spins this executor is known'
        unresolved = _nested_spin(unit) or Unknown(reason, unit.executor.place)
    return Executor(
        name=name,
        threads=threads,
        kind=state.unknown or elsewhere or state.kind,
        import_caught=unit.mark[0] is not None and _is_import_caught(unit.executor, world),
        threads_source=_threads_source(state),
        in_thread=spin.in_thread and state.kind != LOOP_KIND if spin else False,
        spun=spin.how if spin else None,
        alternative=unit.mark[0],
        branch=unit.mark[1],
        unresolved=unresolved,
        assumed=_assumed_threads(state),
        source=spin.place if state.is_global and spin else unit.executor.place,
    )


def _is_import_caught(executor: Instance, world: RosWorld) -> bool:
    """Whether the program goes on where a release lacks the class of its executor."""
    names = [cls.name for cls in executor.mro if isinstance(cls, Library)]
    return any(world.caught_imports.get(name, False) for name in names)


def _nested_spin(unit: Unit) -> Unknown | None:
    """Why the executor is not followed where only callbacks spin the nodes."""
    for node in unit.nodes:
        if node.state.nested is not None:
            how, place = node.state.nested
            return Unknown(f'only {how} inside a callback serves this node', place)
    return None


def _own_wait_set(world: RosWorld) -> Unknown | None:
    """
    Why it is unknown what serves a node if the program waits for entities itself.

    Source: rclpy 9.1.2, ``executors.py``, where an executor makes a ``WaitSet`` for each wait.
    """
    for tree, file in world.files:
        for line, column in noted_on(tree, 'wait_sets', _wait_sets):
            reason = 'the program has a WaitSet of its own; what it serves is not followed'
            return Unknown(reason, Place(file, line, column))
    return None


def _wait_sets(tree: ast.Module) -> tuple[tuple[int, int], ...]:
    calls = (part for part in walk(tree) if isinstance(part, ast.Call))
    made = (call for call in calls if getattr(call.func, 'attr', '') == 'WaitSet')
    return tuple((call.lineno, call.col_offset + 1) for call in made)


def _spun_elsewhere(unit: Unit) -> Unknown | None:
    """Why unknown code may serve the nodes by another executor."""
    spin = unit.spin
    if spin is None:
        return None
    if not spin.for_ever and any(is_handed_over(node) for node in unit.nodes):
        reason = f'{spin.how} serves this node in passing; what else serves it is not known'
        return Unknown(reason, spin.place)
    if spin.for_ever and any(i >= 0 for _, i in beyond(spin.path, unit.nodes[0].path)):
        reason = f'{spin.how} stands under a condition; what else serves it is not known'
        return Unknown(reason, spin.place)
    return None


def is_handed_over(node: Instance) -> bool:
    """Whether the node comes from, or goes to, unknown code."""
    made_for_nobody = isinstance(node.cls, Class) and node.place == node.cls.place
    return node.state.ghost is not None or made_for_nobody


def _threads_source(state: ExecutorState) -> str | None:
    if state.threads_unresolved is not None:
        return 'unresolved'
    if state.threads is None:
        return 'default_cpu_count'
    return str(state.threads_at) if state.threads_at else None


def _assumed_threads(state: ExecutorState) -> str | None:
    if state.threads is None:
        return (
            f'{ASSUMED_THREADS} threads: rclpy takes the number of CPUs at run time, and '
            f'{ASSUMED_THREADS} where it cannot be had'
        )
    return state.assumed
