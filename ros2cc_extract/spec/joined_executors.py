"""
Executors of one program that run at the same time and wait for each other, as one unit.

An executor with one thread serves one callback at a time: its thread is a mutually exclusive group
of all its callbacks. A pool is taken to have threads enough. So what stands still in the joined
unit stands still in the program; what a pool of few threads holds up is judged in its own unit.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace

from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.client_server_pairs import asked_by, reachable, servers_of
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import (
    Activity,
    Callback,
    CallbackGroup,
    Executor,
    GroupType,
    Spec,
    collect_unresolved,
)

MOST_THREADS = 32
"""What has more that may wait at a time takes longer to judge than it is worth."""
_ONE_THREAD, _POOL = 'SingleThreadedExecutor', 'MultiThreadedExecutor'
KINDS = (_ONE_THREAD, _POOL)
BETWEEN_EXECUTORS = '; they are on executors that run at the same time'
_Part = int | str
"""The number of an executor, or the name of a thread of the program's own."""


@dataclass(frozen=True, kw_only=True)
class Joined:
    """
    Several units as one.

    :param spec: without the callbacks that neither wait nor are waited for.
    :param parts: names of the callbacks of each executor, or of each process.
    :param between: what a message says of the parts.
    """

    spec: Spec
    parts: tuple[tuple[str, ...], ...]
    between: str = BETWEEN_EXECUTORS

    @property
    def is_of_processes(self) -> bool:
        """Whether its parts are processes of a system."""
        return self.between != BETWEEN_EXECUTORS

    def executors_of(self, names: Iterable[str]) -> int:
        """How many executors have some of the callbacks of these names."""
        wanted = set(names)
        return sum(not wanted.isdisjoint(part) for part in self.parts)


def joined(whole: Spec, units: Sequence[Spec]) -> Joined | None:
    """
    Join units that wait for each other; ``None`` where they do not, or it is not known how.

    :param whole: all nodes of ``units``, in their order, with the names that they have together.
    """
    part_of = _parts(whole, units)
    if isinstance(part_of, str) or not _wait_for_each_other(whole, part_of):
        return None
    spec = _as_one(without_idle(whole), units, part_of)
    if spec is None:
        return None
    parts = (
        tuple(c.name for c in spec.callbacks if part_of[c.name] == number)
        for number in range(len(units))
    )
    return Joined(spec=spec, parts=tuple(parts))


def put_together(whole: Spec, units: Sequence[Spec]) -> Spec | None:
    """
    All of them as one unit, whether they wait for each other or not.

    It is the program exactly where each has one thread, or as many as can be at work in it.
    """
    part_of = _parts(whole, units)
    return None if isinstance(part_of, str) else _as_one(without_idle(whole), units, part_of)


def has_threads_enough(unit: Spec) -> bool:
    """Whether a pool has a thread for each callback that may wait, and one for all others."""
    return len(unit.executor.threads) >= enough_threads(unit.callbacks, unit.groups)


def why_not_joined(whole: Spec, units: Sequence[Spec]) -> str:
    """Why ``joined`` gives nothing; empty where they do not wait for each other."""
    part_of = _parts(whole, units)
    if isinstance(part_of, str):
        return part_of
    if not _wait_for_each_other(whole, part_of):
        return ''
    return f'more than {MOST_THREADS} of their callbacks may wait at a time'


def _parts(whole: Spec, units: Sequence[Spec]) -> dict[str, _Part] | str:
    """Which executor has which callback, or why that is not known."""
    owners = [number for number, unit in enumerate(units) for _ in unit.nodes]
    if len(owners) != len(whole.nodes):
        return 'not all of their nodes are known'
    by_node = dict(zip(whole.nodes, owners, strict=True))
    if not all(isinstance(c.node, str) and c.node in by_node for c in whole.callbacks):
        return 'it is not known which node a callback belongs to'
    if _spins(whole.callbacks):
        return 'a callback spins an executor while it waits'
    return {c.name: by_node[str(c.node)] for c in whole.callbacks}


def _spins(callbacks: Iterable[Callback]) -> bool:
    """Whether one of them serves others while it waits, of any executor."""
    blocks = (block for callback in callbacks for block in callback.blocking)
    return any(block.call.rpartition('.')[2].startswith('spin') for block in blocks)


def _wait_for_each_other(spec: Spec, part_of: Mapping[str, _Part]) -> bool:
    ahead: dict[_Part, set[_Part]] = {}
    for one, other in _needs(spec, part_of):
        ahead.setdefault(one, set()).add(other)
    executors = [part for part in ahead if isinstance(part, int)]
    reached = {part: reachable(part, ahead) for part in executors}
    return any(
        one != other and other in reached[one] and one in reached[other]
        for one in executors
        for other in executors
    )


def _needs(spec: Spec, part_of: Mapping[str, _Part]) -> Iterator[tuple[_Part, _Part]]:
    """Which needs which: to be answered or woken, or to release a lock."""
    doers = _doers(spec)
    for doer in doers:
        mine = part_of.get(doer.name, doer.name)
        for block in doer.blocking:
            for name in enders_of(block, spec):
                yield mine, part_of.get(name, name)
        for other in doers:
            if _locks_of(doer) & _kept_by(other):
                yield mine, part_of.get(other.name, other.name)


def _doers(spec: Spec) -> tuple[Callback | Activity, ...]:
    return (*spec.callbacks, *spec.activities)


def enders_of(block: Blocking, spec: Spec) -> Iterator[str]:
    """What has to run before a wait without a time-out is over, as far as the unit has it."""
    if block.seconds is not None:
        return
    yield from (waker.by for waker in block.wakers)
    yield from (each.name for each in spec.callbacks if each.name == block.on)
    for client in asked_by(block, spec.callbacks):
        yield client.name
        yield from (each.name for each in servers_of(client, spec.callbacks))


def _locks_of(doer: Callback | Activity) -> set[object]:
    return {act.name for act in doer.locks if not act.tries}


def _kept_by(doer: Callback | Activity) -> set[object]:
    """Locks that it holds while it waits, for another one too."""
    over = (lock for block in doer.blocking for lock in block.held)
    return {*over, *(lock for act in doer.locks for lock in act.held)}


def without_idle(spec: Spec) -> Spec:
    """Remove what neither waits nor is waited for: it comes to its end, and keeps nothing."""
    needed = {
        name for doer in _doers(spec) for block in doer.blocking for name in enders_of(block, spec)
    }
    needed |= {start.by for activity in spec.activities for start in activity.starts}
    callbacks = tuple(
        each for each in spec.callbacks if each.blocking or each.locks or each.name in needed
    )
    used = {each.group for each in callbacks}
    return replace(
        spec, callbacks=callbacks, groups=tuple(each for each in spec.groups if each.name in used)
    )


def _as_one(spec: Spec, units: Sequence[Spec], part_of: Mapping[str, _Part]) -> Spec | None:
    taken = set(spec.names()) - {spec.executor.name, *spec.executor.threads}
    groups: dict[str, CallbackGroup] = {group.name: group for group in spec.groups}
    callbacks = list(spec.callbacks)
    for number, unit in enumerate(units):
        mine = [each for each in callbacks if part_of[each.name] == number]
        if len(unit.executor.threads) > 1 or _awaits(mine):
            continue
        name = _free(f'only_thread_of_{unit.executor.name}', taken)
        groups[name] = CallbackGroup(
            name=name, type=GroupType.EXCLUSIVE, source=unit.executor.source
        )
        own = {each.name for each in mine if not each.groupless}
        callbacks = [replace(each, group=name) if each.name in own else each for each in callbacks]
    used = {each.group for each in callbacks}
    kept = tuple(group for group in groups.values() if group.name in used)
    threads = enough_threads(callbacks, kept)
    if threads > MOST_THREADS:
        return None
    executor = Executor(
        name=_free(spec.executor.name, taken),
        threads=tuple(_free(f'thread_{n}', taken) for n in range(threads)),
        kind=_POOL,
        threads_source='as many as can be at work',
        spun='spin',
        source=units[0].executor.source,
    )
    spec = replace(spec, callbacks=tuple(callbacks), groups=kept, executor=executor)
    return replace(spec, unresolved=(*collect_unresolved(spec), *spec.unresolved))


def _awaits(callbacks: Iterable[Callback]) -> bool:
    """Whether one gives its thread back while its own group stays closed."""
    return any(block.suspends for each in callbacks for block in each.blocking)


def _free(name: str, taken: set[str]) -> str:
    while name in taken:
        name += '_'
    taken.add(name)
    return name


def enough_threads(callbacks: Sequence[Callback], groups: Iterable[CallbackGroup]) -> int:
    """
    Count one for each run that may wait, one of a group, and one for all others.

    A callback in no exclusive group runs for what arrives by itself, and for each caller.
    """
    exclusive = {group.name for group in groups if group.type is GroupType.EXCLUSIVE}
    runs: dict[object, int] = {}
    for each in (each for each in callbacks if each.blocking or each.locks):
        is_one = each.group in exclusive and not each.groupless
        runs[(each.group,) if is_one else each.name] = 1 if is_one else _runs(each, callbacks)
    return max(2, sum(runs.values()) + 1)


def _runs(callback: Callback, callbacks: Sequence[Callback]) -> int:
    """How often it may run at once, up to what is too much; one that asks itself does so once."""
    number = 0
    left = [(callback, frozenset[str]())]
    while left and number <= MOST_THREADS:
        each, above = left.pop()
        number += 1
        above |= {each.name}
        left += [(c, above) for c in _callers(each, callbacks) if c.name not in above]
    return number


def _callers(callback: Callback, callbacks: Sequence[Callback]) -> Iterator[Callback]:
    for caller in callbacks:
        for client in (c for block in caller.blocking for c in asked_by(block, callbacks)):
            if callback in servers_of(client, callbacks):
                yield caller
