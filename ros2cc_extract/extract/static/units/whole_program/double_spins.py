"""
One executor that is spun at two places at the same time: by two threads, or by two callbacks.

Sources: rclpy 7.1.6 and 9.1.2, ``executors.py`` (``wait_for_ready_callbacks`` goes on with one
generator while its arguments stay the same), ``__init__.py`` (``rclpy.spin…`` without an executor
spins the global one for every node). Measured on both: with equal time-outs one of the two
ends by ``ValueError: generator already executing``; with others each waits for itself, now and
then with an ``IndexError``. Newer releases refuse (ros2/rclpy pull request 1510).
``EventsExecutor`` is no such executor.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState, process_of
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import ResourceRef
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    EntityState,
    ExecutorState,
    GroupState,
    InsideSpin,
    RosWorld,
    Spin,
)
from ros2cc_extract.extract.static.python.machine.recorded_effects import Doer
from ros2cc_extract.extract.static.python.values.exclusive_paths import exclusive
from ros2cc_extract.extract.static.python.values.values import Const, Instance, Value, options_of
from ros2cc_extract.extract.static.units.whole_program.threads_in_turn import go_in_turn
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.model import GroupType

_EVENTS = 'EventsExecutor'


def are_concurrent(world: RosWorld, first: Spin, second: Spin) -> bool:
    """Whether ``first`` goes on while ``second``, of the same executor, is begun after it."""
    if first.executor is not second.executor or exclusive(first.path, second.path):
        return False
    if process_of(first.by) is not process_of(second.by):  # each has an executor of its own
        return False
    if first.thread == second.thread or go_in_turn(world, first.by, second.by):
        return False
    # A text without a known caller is followed by itself, and where a thread runs it.
    is_one = None in (first.by, second.by) or first.by is second.by
    if first.place == second.place and first.nodes == second.nodes and is_one:
        return False
    if list(world.spins.values()).index(first) < second.over:
        return False
    if first.thread == 0:
        return first.for_ever and second.from_callback
    if first.for_ever or first.repeated or (second.thread == 0 and second.for_ever):
        return True
    return _lasts(first) and _lasts(second)


def _lasts(spin: Spin) -> bool:
    """Whether it ends with what comes, and not at once."""
    return spin.how.endswith('spin_until_future_complete')


def note_spun_twice(world: RosWorld) -> None:
    """Report, after all was followed, the worst spin beside another spin of its executor."""
    by_place: dict[Place, Diagnostic] = {}
    for each in (*_by_threads(world), *_by_callbacks(world)):
        known = by_place.setdefault(each.place, each)
        if known.severity is not Severity.ERROR:
            by_place[each.place] = each if each.severity is Severity.ERROR else known
    world.diagnostics.extend(by_place.values())


def _by_threads(world: RosWorld) -> Iterator[Diagnostic]:
    for first, second in combinations(world.spins.values(), 2):
        if are_concurrent(world, first, second) and _is_ordinary(first.executor):
            yield _by_two_threads(first, second)
    for spin in world.spins.values():
        if _is_ordinary(spin.executor) and _comes_again(world, spin):
            by_same = 'another thread comes to the same call'
            yield _spun_twice(spin.executor, spin.how, spin.place, by_same, is_same=False)


def _comes_again(world: RosWorld, spin: Spin) -> bool:
    """Whether several threads run one text that spins, and none of them is waited for before."""
    by = spin.by
    if not spin.in_thread or by is None or not (spin.for_ever or spin.repeated or _lasts(spin)):
        return False
    process = process_of(by)
    if process is by:
        return False
    near = [other for other in spin.beside if process_of(other) is process]
    others = [other for other in near if not go_in_turn(world, by, other)]
    if any(by.turns is None or by.turns is not other.turns for other in others):
        return True
    if by.count == 1 or by.turns is not None or go_in_turn(world, by, by):
        return False
    return by.overlaps or (isinstance(by.count, Unknown) and not _is_joined(world, by))


def _is_joined(world: RosWorld, thread: ActivityState) -> bool:
    """Whether the code that starts it waits for its end without a limit."""
    runners = {id(runner) for runner in thread.runners}
    logs = (start.by.effects for start in thread.starts if isinstance(start.by, Doer))
    blocks = [block for log in logs if log is not None for block in log.blocking]
    resources = (block.resource for block in blocks if block.seconds is None)
    in_callback = any(isinstance(r, ResourceRef) and r.number in runners for r in resources)
    waits = (*world.outside, *(each.outside for each in world.set_up.values()))
    awaited = (*(over.what for over in world.over), *(wait.client for wait in waits))
    return in_callback or any(id(what) in runners for what in awaited)


def _by_two_threads(first: Spin, second: Spin) -> Diagnostic:
    """The thread that spins for a while is told, and else the second one."""
    is_same = _asks_the_same((first.how, first.timeout), (second.how, second.timeout))
    is_short = not (first.for_ever or first.repeated)
    told, rival = (first, second) if is_short else (second, first)
    where = f'({rival.place})'
    if first.place == second.place:
        where = 'by the same call'
        where += '' if first.nodes == second.nodes else ', with another node'
    other = f'another thread spins it {"too" if is_short else "already"} {where}'
    return _spun_twice(told.executor, told.how, told.place, other, is_same)


def _by_callbacks(world: RosWorld) -> Iterator[Diagnostic]:
    inside = [each for each in world.inside_spins if _is_of_another(each)]
    for each in inside:
        for spin in world.spins.values():
            goes_on = spin.executor is each.executor and (spin.for_ever or spin.repeated)
            goes_on = goes_on and _runs_beside(world, each.entity, spin)
            if goes_on and not exclusive(spin.path, each.entity.path):
                is_same = _asks_the_same((spin.how, spin.timeout), (each.how, each.timeout))
                other = f'it is spun by {spin.how} as well ({spin.place})'
                yield _spun_twice(each.executor, each.how, each.place, other, is_same)
    reported: set[int] = set()
    for one, rival in (*combinations(inside, 2), *zip(inside, inside, strict=True)):
        is_reported = id(one.entity) in reported and id(rival.entity) in reported
        if one.executor is rival.executor and not is_reported and may_overlap(one, rival):
            reported |= {id(one.entity), id(rival.entity)}
            is_same = _asks_the_same((one.how, one.timeout), (rival.how, rival.timeout))
            words = f'another callback, which may run at the same time, does too ({rival.place})'
            if one is rival:
                words = 'another run of the same callback, which may coincide with it, does too'
            yield _spun_twice(one.executor, one.how, one.place, words, is_same)


def _is_ordinary(executor: Instance) -> bool:
    state = executor.state
    return isinstance(state, ExecutorState) and state.kind != _EVENTS and state.unknown is None


def _is_of_another(spin: InsideSpin) -> bool:
    """Whether it spins another executor than the one that runs the callback."""
    return spin.executor not in _owners(spin.entity) and _is_ordinary(spin.executor)


def _owners(entity: EntityState) -> tuple[Instance, ...]:
    owner = entity.node.slots.get('__owner__')
    known = options_of(owner) if isinstance(owner, Value) else ()
    return tuple(each for each in known if isinstance(each, Instance))


def _runs_beside(world: RosWorld, entity: EntityState, spin: Spin) -> bool:
    """Whether the callback may run meanwhile: one thread ends a spin before it begins another."""
    owners = _owners(entity)
    serving = [each for each in world.spins.values() if each.executor in owners]
    return not serving or any(each.thread != spin.thread for each in serving)


def may_overlap(one: InsideSpin, other: InsideSpin) -> bool:
    """Whether two callbacks, or two runs of one, may spin one executor at the same time."""
    is_one = one.entity is other.entity
    if set(one.held) & set(other.held) or (is_one and one is not other):
        return False
    if exclusive(one.entity.path, other.entity.path):
        return False
    mine, theirs = _owners(one.entity), _owners(other.entity)
    if len(mine) != 1 or len(theirs) != 1:
        return False
    if mine != theirs:
        return True
    state, group = mine[0].state, one.entity.group.state
    if state.threads == 1 or state.unknown or state.unresolved or state.threads_unresolved:
        return False
    is_open = isinstance(group, GroupState) and group.type is GroupType.REENTRANT
    return is_open or (not is_one and one.entity.group is not other.entity.group)


def _asks_the_same(one: tuple[str, Value | None], other: tuple[str, Value | None]) -> bool:
    """Whether both go on with one generator: both step with equal time-outs, or none."""
    steps = all(how.rpartition('.')[2] in ('spin', 'spin_once') for how, _ in (one, other))
    return steps and _seconds(one[1]) == _seconds(other[1])


def _seconds(timeout: Value | None) -> object:
    if timeout is None:
        return None
    return timeout.value if isinstance(timeout, Const) else id(timeout)


def _spun_twice(
    executor: Instance, how: str, place: Place, other: str, is_same: bool
) -> Diagnostic:
    state = executor.state
    name = 'the global executor' if state.is_global else executor.hint or 'an executor'
    before = (
        'one of the two may end by ValueError: generator already executing'
        if is_same
        else 'each takes what the other waits for'
    )
    return Diagnostic(
        severity=Severity.ERROR if is_same else Severity.WARNING,
        slug='executor-spun-twice',
        place=place,
        message=f'{how} spins {name} while {other}: {before}, and from rclpy 7.1.9 on the second '
        'raises RuntimeError',
        help='spin an executor in one thread, and wait for what comes there in the others'
        if not state.is_global
        else 'give each thread an executor of its own, or one executor all nodes',
    )
