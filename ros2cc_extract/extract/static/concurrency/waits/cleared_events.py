"""
Events that are cleared after the message whose answer sets them.

``publish(); event.clear(); event.wait()``: what the message brings may have come before the
``clear``, comes once for each message, and is wiped out. Measured with rclpy 7.1.6 and 9.1.2.
So may be what a thread does for an item that is put before the ``clear``.
"""

from __future__ import annotations

from ros2cc_extract.extract.static.concurrency.machine.wake_operations import ResourceRef
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog, Hold

CLEAR, WAIT = 'clear', 'wait'
_SEND, _GIVE = 'send', 'give'


def note_sent(effects: EffectLog, topic: str) -> None:
    """A message is published."""
    effects.order.append((_SEND, topic.strip('/')))


def note_cleared(effects: EffectLog | None, event: object) -> None:
    """An event is cleared."""
    if effects is not None:
        effects.order.append((CLEAR, id(event)))


def note_given(effects: EffectLog | None, thing: object, holds: frozenset[Hold]) -> None:
    """Something is given for which others may wait, in some holds of locks."""
    if effects is not None:
        effects.order.append((_GIVE, (id(thing), holds)))


def begin_wait(reference: ResourceRef, effects: EffectLog, thing: object) -> None:
    """A wait for ``thing`` begins: keep what came since the last one, and before a clear."""
    before = _since_last_wait(effects, thing)
    reference.sent = frozenset(str(what) for kind, what in before if kind == _SEND)
    clears = [n for n, each in enumerate(before) if each == (CLEAR, id(thing))]
    early = before[: clears[-1]] if clears else []
    if reference.is_kept:
        later = before[len(early) :]
        early = [each for each in early if each not in later]
        reference.answered = frozenset(str(what) for kind, what in early if kind == _SEND)
    given = early if reference.is_kept else before
    reference.given = frozenset(what for kind, what in given if kind == _GIVE)  # type: ignore[misc]
    effects.order.append((WAIT, id(thing)))


def _since_last_wait(effects: EffectLog, thing: object) -> list[tuple[str, object]]:
    waits = [n for n, each in enumerate(effects.order) if each == (WAIT, id(thing))]
    return effects.order[waits[-1] + 1 :] if waits else list(effects.order)


def sent_up_to(effects: EffectLog, number: int) -> frozenset[str]:
    """The topics on which was published by then, where nothing is behind that."""
    is_last = all(kind != _SEND for kind, _ in effects.order[number:])
    sent = (str(what) for kind, what in effects.order[:number] if kind == _SEND)
    return frozenset(sent) if is_last else frozenset()


def sent_by_now(effects: EffectLog) -> frozenset[str]:
    """The topics on which the run that is followed has published so far."""
    return frozenset(str(what) for kind, what in effects.order if kind == _SEND)
