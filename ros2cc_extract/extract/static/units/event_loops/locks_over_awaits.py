"""
Plain locks that a task of an asyncio loop keeps over an ``await``, while others of its thread want
them.

Whatever waits for such a lock in the thread of the loop holds up the task that has it: another
task, another run of the same one, or a callback of a node that a task spins. An ``RLock`` is given
to all of one thread.
"""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Diagnostic, RelatedPlace, Severity
from ros2cc_extract.extract.static.concurrency.waits.loop_tasks import LoopTask
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import EntityState, RosWorld
from ros2cc_extract.extract.static.python.values.values import Bound, Function, Instance
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place


@dataclass(frozen=True)
class _Hold:
    """A task keeps a lock over an ``await``, at the step ``at``."""

    task: LoopTask
    lock: Instance
    name: str
    place: Place
    at: int


def note_locks_over_awaits(world: RosWorld) -> None:
    """Report each lock of a task once, with the first that may want it meanwhile."""
    tasks = [task for root in world.loop_roots.values() for task in root.all]
    reported: set[tuple[str, Instance]] = set()
    for hold in _holds(tasks) if world.nodes else ():
        key = hold.task.name, hold.lock
        told = None if key in reported else next(_told(hold, tasks, world), None)
        if told is not None:
            reported.add(key)
            world.diagnostics.append(told)


def _holds(tasks: list[LoopTask]) -> Iterator[_Hold]:
    for task in tasks:
        for (lock, name, place), at in task.holds.items():
            yield _Hold(task, lock, name, place, at)


def _told(hold: _Hold, tasks: list[LoopTask], world: RosWorld) -> Iterator[Diagnostic]:
    """What there is to say of it, the surest first."""
    of_loop = [task for task in tasks if task.makers[0].loop == hold.task.makers[0].loop]
    for is_other in (True, False):
        for task in of_loop:
            if (task is not hold.task) is is_other:
                yield from _by_task(hold, task, world)
    for entity in world.entities:
        yield from _by_callback(hold, entity, world)


def _by_task(hold: _Hold, task: LoopTask, world: RosWorld) -> Iterator[Diagnostic]:
    for (lock, place), at in task.takes.items():
        if lock is hold.lock and _may_meet(hold, task, at):
            is_same = task.name == hold.task.name
            who = 'another run of it in the same asyncio loop' if is_same else task.name
            who += '' if is_same else ', in the same asyncio loop,'
            is_sure = task is not hold.task and not (task.meets_itself or hold.task.meets_itself)
            yield _diagnostic(hold, who, place, world, is_sure=is_sure)


def _may_meet(hold: _Hold, task: LoopTask, at: int) -> bool:
    """Whether ``task`` may come to its step ``at`` while the lock is kept."""
    if task is hold.task:
        return any(each.meets_itself for each in task.makers)
    mine, other = hold.task.makers, task.makers
    common = sum(one is each for one, each in zip(mine, other, strict=False))
    if common and any(each.meets_itself for each in mine[:common]):
        return True
    of_mine, of_other = _life(mine[common:], hold.at), _life(other[common:], at)
    return of_mine[0] <= of_other[1] and of_other[0] <= of_mine[1]


def _life(made: list[LoopTask], at: int) -> tuple[float, float]:
    """The steps between which those tasks may do something; ``at`` alone for what made them."""
    if not made:
        return at, at
    ends = [float('inf') if each.ended is None else each.ended for each in made]
    return made[0].begun, max(ends)


def _by_callback(hold: _Hold, entity: EntityState, world: RosWorld) -> Iterator[Diagnostic]:
    """A callback that a task of the loop runs, by spinning its node."""
    run_at = hold.task.run_at
    if run_at is None or entity.effects is None or entity.node.state.loop != run_at:
        return
    if entity.is_on_loop or not _is_spun_on_loop(entity, world):
        return
    for act in entity.effects.locks:
        if act.name == hold.name and not act.tries and act.source is not None:
            who = f'{_called(entity)}, which is spun in the same asyncio loop,'
            yield _diagnostic(hold, who, act.source, world, is_sure=True)


def _is_spun_on_loop(entity: EntityState, world: RosWorld) -> bool:
    spins = [spin for spin in world.spins.values() if entity.node in spin.nodes]
    return bool(spins) and all(
        spin.may_have_loop and spin.executor.state.threads == 1 for spin in spins
    )


def _called(entity: EntityState) -> str:
    callback = entity.callback
    function = callback.function if isinstance(callback, Bound) else callback
    if not isinstance(function, Function):
        return 'a callback'
    owner = callback.receiver if isinstance(callback, Bound) else None
    return f'{owner.class_name}.{function.name}' if isinstance(owner, Instance) else function.name


def _diagnostic(
    hold: _Hold, who: str, taken: Place, world: RosWorld, *, is_sure: bool
) -> Diagnostic:
    own = [(at, place) for (lock, place), at in hold.task.takes.items() if lock is hold.lock]
    places = [max((each for each in own if each[0] < hold.at), default=(0, taken))[1], taken]
    return Diagnostic(
        severity=Severity.ERROR if is_sure else Severity.WARNING,
        slug='lock-over-wait',
        place=hold.place,
        message=f'{hold.task.name} holds {hold.name} while it awaits, and {who} may wait for '
        f'{hold.name} meanwhile: that holds up the thread of both, and they wait forever',
        help=f'give {hold.name} back before the await, or use an asyncio.Lock by "async with"',
        related=(
            *(RelatedPlace(each, f'{hold.name} is taken here') for each in dict.fromkeys(places)),
            *_callbacks_too(hold, taken, world),
        ),
    )


def _callbacks_too(hold: _Hold, taken: Place, world: RosWorld) -> Iterator[RelatedPlace]:
    """Callbacks of other threads that want the lock, and then wait too."""
    for entity in world.entities:
        acts = entity.effects.locks if entity.effects is not None else ()
        act = next((each for each in acts if each.name == hold.name and not each.tries), None)
        if act is not None and act.source is not None and act.source != taken:
            yield RelatedPlace(act.source, f'{_called(entity)} waits for it as well, from then on')
