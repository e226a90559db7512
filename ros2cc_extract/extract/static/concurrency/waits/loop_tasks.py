"""
Tasks of loops of asyncio, and the plain locks that they take and keep while they wait.

All tasks of a loop have one thread. One that waits for a ``threading.Lock`` holds that thread, so
that the task which keeps the lock over an ``await`` never gets to the line that gives it back.
Source: CPython 3.12, ``asyncio/events.py`` (``Handle._run``), library reference, *Developing with
asyncio*; run on 3.12.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import field

from ros2cc_extract.extract.static.concurrency.accesses.held_locks import lock_of, locks_named
from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState, ConcurrentWorld
from ros2cc_extract.extract.static.python.values.values import Instance, Mystery, Value, options_of
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place

_PLAIN = 'lock'
TASK = 'a task of asyncio'
"""What is not known of a task that is awaited later."""


@dataclass(eq=False)
class LoopTask:
    """
    A coroutine that a loop runs beside others.

    :param loop: equal for those of one loop.
    :param parent: the task that has made it.
    :param many: so many are made of it at once; ``is_left`` where the next round of a loop makes
        one before it has ended.
    :param begun: the number of the step that made it; ``ended`` that behind which it is over.
    :param run_at: where the call stands that runs the loop.
    :param rounds: how many loops were open then, and ``around`` the locks that its maker held.
    :param is_again: it is followed for what it does, see ``World.second_pass``.
    :param takes: the locks it takes, and where, with the first step of that.
    :param holds: the locks that it keeps over an ``await``, by name, and where that stands.
    """

    name: str
    loop: object
    parent: LoopTask | None = None
    many: bool = False
    begun: int = 0
    ended: int | None = None
    run_at: Place | None = None
    rounds: int = 0
    around: frozenset[str] = frozenset()
    is_again: bool = False
    is_left: bool = False
    takes: dict[tuple[Instance, Place], int] = field(default_factory=dict)
    holds: dict[tuple[Instance, str, Place], int] = field(default_factory=dict)
    children: list[LoopTask] = field(default_factory=list)

    @property
    def all(self) -> Iterator[LoopTask]:
        """Itself, and all that it has made, and these."""
        yield self
        for child in self.children:
            yield from child.all

    @property
    def meets_itself(self) -> bool:
        """Whether it may run several times at once."""
        return self.many or self.is_left

    @property
    def makers(self) -> list[LoopTask]:
        """Those that have led to it, the first one first, and itself."""
        return [*(self.parent.makers if self.parent is not None else ()), self]


@contextmanager
def as_root(world: ConcurrentWorld, key: object, task: LoopTask) -> Iterator[None]:
    """What is followed inside is a task that no other one has made."""
    world.loop_steps += 1
    task.begun, task.rounds = world.loop_steps, world.open_loops
    world.loop_roots[key] = task
    with _as_current(world, task):
        yield


def child_of(world: ConcurrentWorld, name: str, *, many: bool = False) -> LoopTask | None:
    """A new task of the loop that runs the one that is followed."""
    parent = current_task(world)
    if parent is None:
        return None
    world.loop_steps += 1
    made = LoopTask(name, parent.loop, parent, many, world.loop_steps)
    made.run_at, made.rounds = parent.run_at, world.open_loops
    made.is_left = world.open_loops > parent.rounds
    parent.children.append(made)
    return made


@contextmanager
def followed_as(world: ConcurrentWorld, task: LoopTask | None) -> Iterator[None]:
    """What is followed inside is that task, if it is one."""
    with _as_current(world, task if task is not None else world.loop_task):
        yield


@contextmanager
def _as_current(world: ConcurrentWorld, task: LoopTask | None) -> Iterator[None]:
    before, world.loop_task = world.loop_task, task
    if task is not None and task is not before:
        task.around = frozenset(world.held)
    try:
        yield
    finally:
        world.loop_task = before


def end(world: ConcurrentWorld, task: LoopTask | None) -> None:
    """Whoever goes on has waited for its end."""
    if task is not None and task.ended is None:
        world.loop_steps += 1
        task.ended = world.loop_steps
        task.is_left = task.is_left and world.open_loops < task.rounds


def current_task(world: ConcurrentWorld) -> LoopTask | None:
    """The task that is followed; what another thread hands over to a loop is one."""
    current, activity = world.loop_task, world.activity
    if isinstance(current, LoopTask):
        return current
    if not isinstance(activity, ActivityState) or not activity.on_loop:
        return None
    known = world.loop_roots.get(id(activity))
    if not isinstance(known, LoopTask) or known.is_again is not world.second_pass:
        known = LoopTask(_name_of(activity), activity.loop, many=activity.count != 1)
        known.is_again = world.second_pass
        world.loop_roots[id(activity)] = known
    return known


def _name_of(activity: ActivityState) -> str:
    function = getattr(activity.target, 'function', activity.target)
    return getattr(function, 'name', 'a coroutine')


def note_taken(world: ConcurrentWorld, lock: Value, place: Place) -> None:
    """A lock is waited for, without a limit."""
    task = current_task(world)
    if task is not None:
        for option in map(lock_of, options_of(lock)):
            if isinstance(option, Instance) and getattr(option.state, 'kind', '') == _PLAIN:
                world.loop_steps += 1
                task.takes.setdefault((option, place), world.loop_steps)


def note_suspended(world: ConcurrentWorld, place: Place) -> None:
    """The task that is followed lets others run, and keeps its locks."""
    task = current_task(world) if world.held else None
    if task is not None:
        for name in dict.fromkeys(world.held):
            for lock, kind in locks_named(name, world):
                if kind == _PLAIN and name not in task.around:
                    world.loop_steps += 1
                    task.holds.setdefault((lock, name, place), world.loop_steps)


def note_awaited(world: ConcurrentWorld, value: Value) -> None:
    """A task that was made before is awaited: it is taken to be any of them."""
    if isinstance(value, Mystery) and value.unknown.reason == TASK:
        end_all(world)


def end_all(world: ConcurrentWorld) -> None:
    """All that the task that is followed has made are over."""
    task = current_task(world)
    for child in task.children if task is not None else ():
        end(world, child)
