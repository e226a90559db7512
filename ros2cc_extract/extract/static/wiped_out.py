"""
Events that are cleared behind the message that brings who sets them.

``publish(); event.clear(); event.wait()``: what the message brings may have come before the
``clear``, comes once for each message, and is wiped out. Measured with rclpy 7.1.6 and 9.1.2.
"""

from __future__ import annotations

from collections.abc import Sequence

from ros2cc_extract.extract.static.doing import ActivityState, Deeds
from ros2cc_extract.extract.static.values import Const
from ros2cc_extract.extract.static.wakings import ResourceRef, Waking
from ros2cc_extract.extract.static.world import EntityState
from ros2cc_extract.places import Unknown
from ros2cc_extract.spec.model import EntityKind

Doer = EntityState | ActivityState
CLEAR, WAIT = 'clear', 'wait'
_SEND = 'send'


def note_sent(deeds: Deeds, topic: str) -> None:
    """A message is published."""
    deeds.order.append((_SEND, topic.strip('/')))


def note_cleared(deeds: Deeds | None, event: object) -> None:
    """An event is cleared."""
    if deeds is not None:
        deeds.order.append((CLEAR, id(event)))


def sent_before_clear(deeds: Deeds, event: object) -> frozenset[str]:
    """The topics on which was published before the last clear, and not again; a wait begins."""
    sent: dict[bool, set[str]] = {False: set(), True: set()}
    is_before = False
    for kind, what in reversed(deeds.order):
        if kind == _SEND:
            sent[is_before].add(str(what))
        elif what == id(event):
            if kind == WAIT:
                break
            is_before = True
    deeds.order.append((WAIT, id(event)))
    return frozenset(sent[True] - sent[False])


def why_wiped_out(
    reference: ResourceRef, mine: Sequence[Waking], doer: Doer, doers: Sequence[Doer]
) -> Unknown | None:
    """Why all that ends a wait may come before the event is cleared, and not again."""
    answers = _answers(reference.answered, doers)
    heard = [_topic(waking.by) for waking in mine]
    if not answers or not heard or not all(_is_answer(t, answers, doer, doers) for t in heard):
        return None
    topics = ', '.join(sorted(reference.answered))
    reason = f'what ends it may come for the message on {topics} that is sent before the clear'
    return Unknown(reason, mine[0].place)


def _answers(sent: frozenset[str], doers: Sequence[Doer]) -> frozenset[str]:
    """The topics of messages that come because of what was ``sent``, itself among them."""
    found = set(sent)
    while more := {
        topic
        for doer in doers
        if _topic(doer) in found
        for topic in _published(doer)
        if topic not in found
    }:
        found |= more
    return frozenset(found)


def _is_answer(
    topic: str | None, answers: frozenset[str], doer: Doer, doers: Sequence[Doer]
) -> bool:
    """Whether nobody in sight publishes ``topic`` but because of a message that was sent."""
    if topic is None:
        return False
    senders = [each for each in doers if topic in _published(each)]
    return all(each is doer or _topic(each) in answers for each in senders)


def _topic(doer: object) -> str | None:
    if not isinstance(doer, EntityState) or doer.kind is not EntityKind.SUBSCRIPTION:
        return None
    return str(doer.key.value).strip('/') if isinstance(doer.key, Const) else None


def _published(doer: Doer) -> frozenset[str]:
    acts = (doer.deeds or Deeds()).publishes
    return frozenset(act.name.strip('/') for act in acts if isinstance(act.name, str))
