"""Random units for the generator: every mix of types, groups and threads."""

from __future__ import annotations

from dataclasses import replace
from random import Random

from hypothesis import strategies

from ros2cc_extract.spec.close import ClosedSpec, close
from ros2cc_extract.spec.model import (
    Blocking,
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
