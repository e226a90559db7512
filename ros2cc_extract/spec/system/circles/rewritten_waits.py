"""Waits of units as others, one or several for each, with all that refers to their numbers."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from itertools import accumulate

from ros2cc_extract.spec.effects import Act, Blocking, Waker
from ros2cc_extract.spec.model import Activity, Callback, Spec

Doer = Callback | Activity
Rewrite = Callable[[Doer, Blocking], Sequence[Blocking]]


def with_waits(parts: Sequence[Spec], rewrite: Rewrite) -> list[Spec]:
    """
    Put what ``rewrite`` gives in the place of each wait.

    What a callback does behind a wait, it does behind all that stand for it.
    """
    found: dict[str, tuple[Blocking, ...]] = {}
    numbers: dict[str, list[int]] = {}
    for doer in (each for part in parts for each in _doers(part)):
        new = [tuple(rewrite(doer, block)) for block in doer.blocking]
        found[doer.name] = tuple(block for blocks in new for block in blocks)
        numbers[doer.name] = [0, *accumulate(map(len, new))]
    changed = {name: of for name, of in numbers.items() if of != list(range(len(of)))}
    return [_rewritten(part, found, changed) for part in parts]


def _doers(part: Spec) -> tuple[Doer, ...]:
    return (*part.callbacks, *part.activities)


def _rewritten(
    part: Spec, found: Mapping[str, tuple[Blocking, ...]], numbers: Mapping[str, list[int]]
) -> Spec:
    def behind(name: str, after: int) -> int:
        of = numbers.get(name)
        return after if of is None else of[min(after, len(of) - 1)]

    def waker(each: Waker) -> Waker:
        if each.after is None:
            return each
        until = None if each.until is None else behind(each.by, each.until)
        return replace(each, after=behind(each.by, each.after), until=until)

    def blocking(name: str) -> tuple[Blocking, ...]:
        return tuple(
            replace(block, wakers=tuple(map(waker, block.wakers))) for block in found[name]
        )

    def publishes(doer: Doer) -> tuple[Act, ...]:
        return tuple(replace(act, after=behind(doer.name, act.after)) for act in doer.publishes)

    return replace(
        part,
        callbacks=tuple(
            replace(each, blocking=blocking(each.name), publishes=publishes(each))
            for each in part.callbacks
        ),
        activities=tuple(
            replace(
                each,
                blocking=blocking(each.name),
                publishes=publishes(each),
                starts=tuple(map(waker, each.starts)),
            )
            for each in part.activities
        ),
    )
