"""What the model of a unit leaves out or changes, in words beside its verdicts."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.generator.executor_kinds import ExecutorKind, executor_kind
from ros2cc_extract.generator.nested_spins import is_part_of_spin, is_spin
from ros2cc_extract.generator.program_steps import NamedWait
from ros2cc_extract.generator.resources import Actor, ends_outside, is_left_open
from ros2cc_extract.generator.template_files import Profile
from ros2cc_extract.generator.waits import is_unknown, is_unseen, unknown_ends, waits_of
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import Activity, Callback, Spec

_TASK_WAKES_NOBODY = (
    'before rclpy 3.3.21, 7.1.9 and 9.1.4 the end of a task wakes no executor: it goes on once '
    'something else does so'
)

_GOES_BY_DATA = 'data decides whether it waits, and whether anybody notifies it'


def caveats_of(unit: Spec, profile: Profile) -> Iterator[str]:
    """Say what the reader of all verdicts should know."""
    yield from _threads_of_no_use(unit, profile)
    blocking = any(callback.blocking for callback in unit.callbacks)
    if profile is Profile.PAPER and blocking:
        yield 'the published model has no blocking calls; the findings report them'


def left_out_of_deadlocks(unit: Spec, profile: Profile) -> str:
    """
    Begin the words on deadlocks where the model leaves waits out; empty where it does not.

    A report must not say that there is no deadlock beside a finding that shows one.
    """
    waits = any(any(waits_of(callback, unit)) for callback in unit.callbacks)
    return 'blocking calls left out, ' if profile is Profile.PAPER and waits else ''


def _threads_of_no_use(unit: Spec, profile: Profile) -> Iterator[str]:
    """Say what becomes of threads that were asked for an executor without a pool."""
    executor = unit.executor
    has_pool = executor_kind(unit) is ExecutorKind.MULTI_THREADED
    if has_pool or len(executor.threads) == 1:
        return
    if profile is Profile.RCLPY:
        yield (
            f'{executor.kind} runs callbacks on one thread, for any number given; to try a '
            'pool, write kind: MultiThreadedExecutor into the specification'
        )
    else:
        yield (
            f'{executor.kind} runs callbacks on one thread; the published model has a pool of '
            'as many as asked'
        )


@dataclass(frozen=True)
class OpenEnd:
    """
    A wait whose end no model knows.

    :param why: in words; empty where the wait itself says it.
    """

    block: Blocking
    why: str = ''


def open_ends(unit: Spec) -> dict[str, tuple[OpenEnd, ...]]:
    """
    Return, for each doer of the user, the waits whose ends no model knows.

    Those that code outside the unit ends are among them: models assume that it does.
    """
    written = tuple(callback for callback in unit.callbacks if not callback.builtin)
    doers: tuple[Actor, ...] = (*written, *unit.activities)
    return {doer.name: tuple(_open_ends_of(doer, unit)) for doer in doers}


def _open_ends_of(doer: Actor, unit: Spec) -> Iterator[OpenEnd]:
    unknown = () if isinstance(doer, Activity) else unknown_ends(doer, unit)
    known = {id(block) for block in unknown}
    for block in doer.blocking:
        if _is_open(block, doer, unit):
            is_by_data = block.escapes is None and block.goes_by_data
            yield OpenEnd(block, _GOES_BY_DATA if is_by_data else '')
        elif id(block) in known:
            is_late = isinstance(doer, Callback) and is_unseen(block, doer, unit)
            yield OpenEnd(block, _TASK_WAKES_NOBODY if is_late else '')


def _is_open(block: Blocking, doer: Actor, unit: Spec) -> bool:
    if isinstance(doer, Activity):
        if is_spin(block):
            return False  # it serves others, as an executor does
        if is_unknown(block, doer, unit):
            return True
    elif is_part_of_spin(block, doer):
        return False
    return is_left_open(block, unit) or ends_outside(block, unit)


def block_at(unit: Spec, doer: Actor, wait: int | None) -> Blocking | None:
    """Give the wait of a doer that a model numbers ``wait``, as an event of a run does."""
    step = _step_at(unit, doer, wait)
    return step.block if step is not None else None


def taking_at(unit: Spec, doer: Actor, wait: int | None) -> Blocking | None:
    """Give the taking of the lock that is waited for there, as a wait."""
    step = _step_at(unit, doer, wait)
    if step is None or step.lock is None:
        return None
    acts = (act for act in doer.locks if act.name == step.lock.name and not act.tries)
    act = next(acts, None)
    if act is None:
        return None
    return Blocking(
        call='Lock.acquire', source=act.source, chain=act.chain, resource=step.lock.name
    )


def _step_at(unit: Spec, doer: Actor, wait: int | None) -> NamedWait | None:
    steps = tuple(waits_of(doer, unit))
    return steps[wait] if wait is not None and wait < len(steps) else None
