"""
Nested spins: what a callback that spins an executor waits for, and what it serves meanwhile.

Sources: rclpy 7.1.6 and 9.1.2, ``__init__.py`` (``spin_until_future_complete`` adds the node to
the global executor and takes it out afterwards), ``node.py`` (the setter of ``executor`` takes a
node out of the executor it is in), ``executors.py`` (``spin_until_future_complete``,
``wait_for_ready_callbacks``, ``_spin_once_impl``).
"""

from __future__ import annotations

from collections.abc import Iterator
from enum import Enum

from ros2cc_extract.generator.executor_kinds import ExecutorKind, executor_kind
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.client_server_pairs import client_before
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import Callback, Spec
from ros2cc_extract.spec.node_moves import named_executor
from ros2cc_extract.spec.releases.table import NODE_STAYS, SPIN_REFUSED_TWICE

_BUSY_WAIT, _FOR_FUTURE = 'busy wait', 'spin for future'


class Spun(Enum):
    """
    Which executor is spun, by its number in the model.

    Another one that is single-threaded and has no node does as the global one.
    """

    OWN = 1
    GLOBAL = 2


class SpinEnd(Enum):
    """What ends a nested spin, by its number in the model."""

    ANSWER = 0
    ONE_CALLBACK = 1
    NOTHING = 2


class Refusal(Enum):
    """Whether an executor that spins already lets itself be spun, by its number in the model."""

    NEVER = 0
    SOMETIMES = 1
    ALWAYS = 2


@dataclass(frozen=True, kw_only=True)
class NestedSpin:
    """
    One nested spin that the model has.

    :param node: the node that the global executor gets.
    :param needed: name of the callback that must run before it ends; ``None`` where it ends
        otherwise, or it is unknown.
    :param is_timed: it also ends by itself, or for a reason that is not known.
    """

    spun: Spun
    node: str | None
    end: SpinEnd
    needed: str | None
    is_timed: bool
    refusal: Refusal


def is_spin(block: Blocking) -> bool:
    """True for a nested spin: others run inside the callback."""
    return block.call.rpartition('.')[2].startswith('spin')


def is_aside(block: Blocking) -> bool:
    """Return whether only a nested spin serves its nodes: only then it has wakers."""
    return is_spin(block) and bool(block.wakers)


def is_part_of_spin(block: Blocking, callback: Callback) -> bool:
    """True for the waits that a nested spin stands for; a loop that spins waits by spinning."""
    if is_aside(block):
        return False
    return is_spin(block) or (block.call == _BUSY_WAIT and any(_steps(callback)))


def nested_spins(callback: Callback, spec: Spec) -> Iterator[tuple[Blocking, NestedSpin | None]]:
    """
    Give the nested spins of a callback in their order, and what the model has of each.

    There is nothing where another executor, or a node of another one, is spun; one that serves
    nothing here, and whose end is known, is left out.
    """
    loops = [block for block in callback.blocking if block.call == _BUSY_WAIT]
    for block in callback.blocking:
        if not is_spin(block) or is_aside(block) or _is_of_another(block, callback):
            continue
        futures = loops if _is_step(block) else _futures_of(block, callback)
        for future in futures or (None,):
            yield block, _nested_spin(block, future, callback, spec)


def is_open(spin: NestedSpin | None) -> bool:
    """True if it is unknown whether it comes to an end."""
    return spin is None or (spin.end is SpinEnd.NOTHING and spin.is_timed)


def _steps(callback: Callback) -> Iterator[Blocking]:
    return (each for each in callback.blocking if _is_step(each) and not is_aside(each))


def _is_step(block: Blocking) -> bool:
    return is_spin(block) and block.call.endswith('.spin_once')


def _is_of_another(future: Blocking, callback: Callback) -> bool:
    """Return whether the wait for a future is part of a spin, another wait of its place."""
    return future.call == _FOR_FUTURE and any(
        block.call != _FOR_FUTURE and future in _futures_of(block, callback)
        for block in callback.blocking
        if is_spin(block)
    )


def _futures_of(spin: Blocking, callback: Callback) -> list[Blocking]:
    at = spin.source, spin.chain
    blocks = (block for block in callback.blocking if block.call == _FOR_FUTURE)
    return [block for block in blocks if (block.source, block.chain) == at]


def _nested_spin(
    block: Blocking, future: Blocking | None, callback: Callback, spec: Spec
) -> NestedSpin | None:
    spun = _spun(block, callback, spec)
    how = block.call.rpartition('.')[2]
    if spun is None or how not in ('spin', 'spin_once', 'spin_until_future_complete'):
        return None
    needed = None if future is None else _setter(future, callback, spec)
    end, is_timed = SpinEnd.ANSWER, future is not None and future.seconds is not None
    if how == 'spin':
        end = SpinEnd.NOTHING
    elif how == 'spin_once' and future is None:
        end, is_timed = SpinEnd.ONE_CALLBACK, block.seconds is not None
    elif needed is None:
        end, is_timed = SpinEnd.NOTHING, True
    return NestedSpin(
        spun=spun,
        node=block.on if spun is Spun.GLOBAL and isinstance(block.on, str) else None,
        end=end,
        needed=needed,
        is_timed=is_timed,
        refusal=_refusal(block, how, spun, spec),
    )


def _setter(future: Blocking, callback: Callback, spec: Spec) -> str | None:
    """The one callback that makes a future done; not a done-callback, which waits itself."""
    found = next((c for c in spec.callbacks if c.name == future.on), None)
    is_other = found is not None and found.name != callback.name
    return found.name if found and is_other and not client_before(found, spec.callbacks) else None


def _spun(block: Blocking, callback: Callback, spec: Spec) -> Spun | None:
    executor = spec.executor
    if executor.kind not in (
        ExecutorKind.SINGLE_THREADED.value,
        ExecutorKind.MULTI_THREADED.value,
    ):
        return None
    if block.call.startswith('executor.'):
        return Spun.OWN if block.on == executor.name else None
    if block.on not in {callback.node for callback in spec.callbacks}:
        return None
    moves_to = named_executor(block, callback)
    if moves_to not in (None, ExecutorKind.SINGLE_THREADED.value):
        return None
    if moves_to or not _is_global(spec):
        # Which executor goes on with a coroutine of a node that moves is not modelled.
        awaits = any(b.suspends for c in spec.callbacks for b in c.blocking)
        return None if awaits else Spun.GLOBAL
    return None if NODE_STAYS.holds(spec.rclpy) is False else Spun.OWN


def _is_global(spec: Spec) -> bool:
    """True when the unit is run by ``rclpy.spin(node)``, by the executor of nested spins."""
    is_single = executor_kind(spec) is ExecutorKind.SINGLE_THREADED
    return is_single and (spec.executor.spun or '').startswith('rclpy.')


def _refusal(block: Blocking, how: str, spun: Spun, spec: Spec) -> Refusal:
    """
    Return whether the executor, which spins already, lets itself be spun.

    Measured on 7.1.6: where the thread that spins a pool and a worker ask for the same, both
    resume one generator, and one of them gets ``ValueError: generator already executing``.
    """
    if spun is Spun.GLOBAL:
        return Refusal.NEVER
    if SPIN_REFUSED_TWICE.holds(spec.rclpy):
        return Refusal.ALWAYS
    has_pool = executor_kind(spec) is ExecutorKind.MULTI_THREADED
    asks_the_same = how in ('spin', 'spin_once') and block.seconds is None
    return Refusal.SOMETIMES if has_pool and asks_the_same else Refusal.NEVER
