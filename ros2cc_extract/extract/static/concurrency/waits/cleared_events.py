"""
Events that are cleared after the message whose answer sets them.

``publish(); event.clear(); event.wait()``: what the message brings may have come before the
``clear``, comes once for each message, and is wiped out. Measured with rclpy 7.1.6 and 9.1.2.
"""

from __future__ import annotations

from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog

CLEAR, WAIT = 'clear', 'wait'
_SEND = 'send'


def note_sent(effects: EffectLog, topic: str) -> None:
    """A message is published."""
    effects.order.append((_SEND, topic.strip('/')))


def note_cleared(effects: EffectLog | None, event: object) -> None:
    """An event is cleared."""
    if effects is not None:
        effects.order.append((CLEAR, id(event)))


def sent_before(effects: EffectLog, thing: object) -> frozenset[str]:
    """The topics on which was published since the last wait for ``thing``; a wait begins."""
    sent = set[str]()
    for kind, what in reversed(effects.order):
        if (kind, what) == (WAIT, id(thing)):
            break
        if kind == _SEND:
            sent.add(str(what))
    return frozenset(sent)


def sent_up_to(effects: EffectLog, number: int) -> frozenset[str]:
    """The topics on which was published by then, where nothing is behind that."""
    is_last = all(kind != _SEND for kind, _ in effects.order[number:])
    sent = (str(what) for kind, what in effects.order[:number] if kind == _SEND)
    return frozenset(sent) if is_last else frozenset()


def sent_by_now(effects: EffectLog) -> frozenset[str]:
    """The topics on which the run that is followed has published so far."""
    return frozenset(str(what) for kind, what in effects.order if kind == _SEND)


def sent_before_clear(effects: EffectLog, event: object) -> frozenset[str]:
    """The topics on which was published before the last clear, and not again; a wait begins."""
    sent: dict[bool, set[str]] = {False: set(), True: set()}
    is_before = False
    for kind, what in reversed(effects.order):
        if kind == _SEND:
            sent[is_before].add(str(what))
        elif what == id(event):
            if kind == WAIT:
                break
            is_before = True
    effects.order.append((WAIT, id(event)))
    return frozenset(sent[True] - sent[False])
