"""Random units for the generator: every mix of types, groups and threads."""

from __future__ import annotations

from random import Random

from hypothesis import strategies

from ros2cc_extract.spec.close import ClosedSpec, close
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    CallbackType,
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
