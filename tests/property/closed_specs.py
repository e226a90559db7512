"""Random units for the generator: every mix of types, groups and threads."""

from __future__ import annotations

from dataclasses import replace
from random import Random

from hypothesis import strategies

from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.close import ClosedSpec, close
from ros2cc_extract.spec.effects import RE_ENTRANT, Act, Blocking, Needs, Waker
from ros2cc_extract.spec.model import (
    OF_LOOP,
    Activity,
    ActivityKind,
    Callback,
    CallbackGroup,
    CallbackType,
    EntityKind,
    Executor,
    GroupType,
    Spec,
)


def random_unit(random: Random, *, callbacks: int, groups: int, threads: int) -> ClosedSpec:
    """Draw a unit of at most so many callbacks, groups and threads."""
    kinds = [random.choice(list(GroupType)) for _ in range(random.randint(1, groups))]
    return close(
        Spec(
            name='unit',
            callbacks=tuple(
                Callback(
                    name=f'c{index}',
                    type=random.choice(list(CallbackType)),
                    group=f'g{random.randrange(len(kinds))}',
                )
                for index in range(random.randint(1, callbacks))
            ),
            groups=tuple(
                CallbackGroup(name=f'g{index}', type=kind) for index, kind in enumerate(kinds)
            ),
            executor=Executor(
                name='executor',
                threads=tuple(f't{index}' for index in range(random.randint(1, threads))),
            ),
        )
    )


def closed_specs(
    *, callbacks: int = 6, groups: int = 4, threads: int = 5
) -> strategies.SearchStrategy[ClosedSpec]:
    """Units of at most so many callbacks, groups and threads."""
    return strategies.randoms(use_true_random=False).map(
        lambda random: random_unit(random, callbacks=callbacks, groups=groups, threads=threads)
    )


_ENTITY = {CallbackType.SRV: EntityKind.SERVICE, CallbackType.CLT: EntityKind.CLIENT}
_EXECUTORS = ('SingleThreadedExecutor', 'MultiThreadedExecutor', 'EventsExecutor')


def random_rclpy_unit(random: Random, *, callbacks: int, groups: int, threads: int) -> ClosedSpec:
    """Draw a unit of up to two nodes, whose callbacks call, wait for and await each other."""
    unit = random_unit(random, callbacks=callbacks, groups=groups, threads=threads)
    names = [callback.name for callback in unit.spec.callbacks]
    served = tuple(_enrich(callback, names, random) for callback in unit.spec.callbacks)
    executor = replace(unit.spec.executor, kind=random.choice(_EXECUTORS))
    return replace(unit, spec=replace(unit.spec, callbacks=served, executor=executor))


def _enrich(callback: Callback, names: list[str], random: Random) -> Callback:
    waits = random.choice((0, 0, 0, 1))
    return replace(
        callback,
        node=random.choice(('left', 'left', 'right')),
        entity=_ENTITY.get(callback.type),
        key=random.choice(('plan', 'home')) if callback.type in _ENTITY else None,
        blocking=tuple(
            Blocking(call=random.choice(('client.call', 'await')), on=random.choice(names))
            for _ in range(waits)
        ),
    )


def random_spinning_unit(
    random: Random, *, callbacks: int, groups: int, threads: int
) -> ClosedSpec:
    """Draw a unit in which some also spin an executor, or wait for what no callback gives."""
    unit = random_rclpy_unit(random, callbacks=callbacks, groups=groups, threads=threads)
    spec = unit.spec
    kind = random.choice(_EXECUTORS[:2])
    spun = random.choice(('rclpy.spin', 'spin')) if kind == _EXECUTORS[0] else 'spin'
    rclpy = random.choice(('7.1.6', '7.1.6', '7.1.6', '7.1.9'))
    served = [_with_spin(callback, spec, random) for callback in spec.callbacks]
    return replace(
        unit,
        spec=replace(
            spec,
            callbacks=tuple(served),
            executor=replace(spec.executor, kind=kind, spun=spun),
            rclpy=rclpy,
        ),
    )


def _with_spin(callback: Callback, spec: Spec, random: Random) -> Callback:
    """One of two callbacks does so, at most once."""
    source = Place(f'{callback.name}.py', 1)
    other = random.choice(spec.callbacks)
    seconds = random.choice((None, 0.5))
    spun = random.choice((('rclpy', callback.node), ('executor', spec.executor.name)))
    how, on = f'{spun[0]}.', spun[1]
    until = Blocking(call=f'{how}spin_until_future_complete', on=on, source=source)
    choices = (
        (until, Blocking(call='spin for future', on=other.name, seconds=seconds, source=source)),
        (until, Blocking(call='spin for future', on=other.name, seconds=seconds, source=source)),
        (Blocking(call=f'{how}spin_once', on=on, seconds=seconds, source=source),),
        (Blocking(call=f'{how}spin', on=on, source=source),),
        (Blocking(call='wait_for_service', on=other.name, source=source),),
        (Blocking(call='await', on='future', foreign=True, source=source),),
    )
    if random.random() < 0.5:
        return callback
    return replace(callback, blocking=random.choice(choices))


def random_locking_unit(
    random: Random, *, callbacks: int, groups: int, threads: int
) -> ClosedSpec:
    """Draw a unit in which some hold locks while they wait or spin, and others take them."""
    draw = random.choice((random_rclpy_unit, random_rclpy_unit, random_spinning_unit))
    unit = draw(random, callbacks=callbacks, groups=groups, threads=threads)
    served = tuple(_with_locks(callback, random) for callback in unit.spec.callbacks)
    return replace(unit, spec=replace(unit.spec, callbacks=served))


_LOCKS = ('lock', 'lock', 'other', 'again (re-entrant)')


def _with_locks(callback: Callback, random: Random) -> Callback:
    held = tuple(random.sample(_LOCKS[1:], random.choice((0, 1, 1, 2))))
    taken = random.choice(_LOCKS) if random.random() < 0.5 else None
    name = None if taken is None else taken.removesuffix(RE_ENTRANT)
    return replace(
        callback,
        blocking=tuple(replace(block, held=held) for block in callback.blocking),
        locks=() if name is None else (Act(name=name, tries=random.random() < 0.1),),
    )


def random_entity_unit(random: Random, *, callbacks: int, groups: int, threads: int) -> ClosedSpec:
    """Draw a unit as any of the others, with every kind of entity, of any release."""
    draw = random.choice((random_rclpy_unit, random_spinning_unit, random_locking_unit))
    spec = draw(random, callbacks=callbacks, groups=groups, threads=threads).spec
    served = tuple(_as_some_entity(callback, random) for callback in spec.callbacks)
    rclpy = random.choice((None, '7.1.6', '7.1.9', '9.1.2'))
    return close(replace(spec, callbacks=served, rclpy=rclpy))


#: What runs otherwise than a timer, a message, a request or an answer, more often than these.
_RARE = (EntityKind.GUARD_CONDITION, EntityKind.TASK, EntityKind.DONE_CALLBACK)


def _as_some_entity(callback: Callback, random: Random) -> Callback:
    entity = random.choice((None, *EntityKind, *_RARE))
    if entity is None:
        return callback
    return replace(
        callback,
        entity=entity,
        type=entity.published_type,
        key=random.choice(('plan', 'home')) if entity.key_name else None,
    )


def random_waking_unit(random: Random, *, callbacks: int, groups: int, threads: int) -> ClosedSpec:
    """Draw a unit in which callbacks wait for what others signal, with locks and doubts."""
    draw = random.choice((random_rclpy_unit, random_rclpy_unit, random_locking_unit))
    unit = draw(random, callbacks=callbacks, groups=groups, threads=threads)
    names = [callback.name for callback in unit.spec.callbacks]
    threads_of_its_own = [f'w{number}' for number in range(random.choice((0, 0, 1, 1, 2)))]
    names += threads_of_its_own
    served = tuple(_with_signals(callback, names, random) for callback in unit.spec.callbacks)
    activities = tuple(_activity(name, names, random) for name in threads_of_its_own)
    return replace(unit, spec=replace(unit.spec, callbacks=served, activities=activities))


def _activity(name: str, names: list[str], random: Random) -> Activity:
    """A thread that waits, signals, takes locks, calls, is started by some or from the start."""
    starters = [Waker(by=random.choice(names), after=random.choice((None, 0)))]
    blocking = [
        random.choice(
            (
                _signalled(names, random),
                Blocking(call='client.call', on=random.choice(names)),
                Blocking(call='Event.wait', held=random.choice(((), ('other',)))),
            )
        )
        for _ in range(random.choice((0, 1, 1, 2)))
    ]
    return Activity(
        name=name,
        kind=ActivityKind.THREAD,
        node=random.choice(('left', 'right')),
        starts=tuple(starters) if random.random() < 0.5 else (),
        loops=random.random() < 0.5,
        blocking=tuple(blocking),
        locks=(Act(name='other'),) if random.random() < 0.3 else (),
    )


def _with_signals(callback: Callback, names: list[str], random: Random) -> Callback:
    waits = tuple(_signalled(names, random) for _ in range(random.choice((0, 0, 1, 2))))
    blocking = [*callback.blocking, *waits]
    random.shuffle(blocking)
    return replace(callback, blocking=tuple(blocking[:2]), one_shot=random.random() < 0.2)


def _signalled(names: list[str], random: Random) -> Blocking:
    resource = random.choice(('done', 'queue'))
    needs = Needs.EACH if resource == 'queue' else random.choice((Needs.ONCE, Needs.ALL))
    wakers = tuple(_waker(names, random) for _ in range(random.choice((1, 1, 2))))
    return Blocking(
        call=random.choice(('Event.wait', 'Event.wait', 'await')),
        resource=resource,
        needs=needs,
        wakers=wakers,
        initial=random.choice((0, 0, 1)),
        forgets=random.random() < 0.3,
        escapes=Unknown('given away') if random.random() < 0.15 else None,
        conditional=random.random() < 0.15,
        held=random.choice(((), (), ('other',))),
    )


def _waker(names: list[str], random: Random) -> Waker:
    after, is_skipped = random.choice((None, 0, 1)), random.random() < 0.15
    return Waker(
        by=random.choice(names),
        after=after,
        conditional=is_skipped,
        until=random.choice((None, 1, 2)) if is_skipped and after is not None else None,
        held=random.choice(((), (), ('other',))),
    )


def random_loop_unit(random: Random, *, callbacks: int, threads: int = 1) -> ClosedSpec:
    """Draw a unit that a loop of asyncio runs: each callback serial, or concurrent with itself."""
    draw = random.choice((random_rclpy_unit, random_locking_unit, random_waking_unit))
    spec = draw(random, callbacks=callbacks, groups=2, threads=threads).spec
    groups = tuple(
        CallbackGroup(
            name=f'{callback.name}_group',
            type=random.choice((GroupType.EXCLUSIVE, GroupType.EXCLUSIVE, GroupType.REENTRANT)),
            library=OF_LOOP,
        )
        for callback in spec.callbacks
    )
    served = tuple(
        replace(callback, group=group.name)
        for callback, group in zip(spec.callbacks, groups, strict=True)
    )
    executor = replace(spec.executor, kind='AsyncNode')
    return close(replace(spec, callbacks=served, groups=groups, executor=executor))
