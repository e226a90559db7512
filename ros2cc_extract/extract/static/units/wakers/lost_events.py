"""
Events that are cleared after the message whose answer sets them.

What the message brings may have come before the ``clear``, see ``cleared_events.py``.
"""

from __future__ import annotations

from collections.abc import Sequence

from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import ResourceRef, Waking
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import EntityState, RosWorld
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog
from ros2cc_extract.extract.static.python.values.values import Const
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.model import EntityKind

Doer = EntityState | ActivityState


def answer_from_outside(
    sent: frozenset[str], wakers: Sequence[object], world: RosWorld
) -> str | None:
    """
    The topics of the messages whose answers a wait is for, if another process gives them.

    They come by subscriptions whose topics no known code publishes. Code that sends nothing
    before it waits expects messages that come by themselves.
    """
    heard = {heard_on(waker) for waker in wakers}
    doers: tuple[Doer, ...] = (*world.entities, *world.activities)
    acts = (act for doer in doers for act in (doer.effects or EffectLog()).publishes)
    published = {act.name.strip('/') if isinstance(act.name, str) else None for act in acts}
    is_open = None in heard or None in published or not heard.isdisjoint(published)
    return ', '.join(sorted(sent)) if sent and heard and not is_open else None


def sent_before_clear(
    reference: ResourceRef, mine: Sequence[Waking], doer: Doer, doers: Sequence[Doer]
) -> str | None:
    """The topics of the messages sent before an event is cleared, if only they set it again."""
    answers = _answers(reference.answered, doers)
    heard = [heard_on(waking.by) for waking in mine]
    if not answers or not heard or not all(_is_answer(t, answers, doer, doers) for t in heard):
        return None
    return ', '.join(sorted(reference.answered))


def why_wiped_out(
    reference: ResourceRef, mine: Sequence[Waking], doer: Doer, doers: Sequence[Doer]
) -> Unknown | None:
    """Why all that ends a wait may come before the event is cleared, and not again."""
    topics = sent_before_clear(reference, mine, doer, doers)
    if topics is None:
        return None
    reason = f'what ends it may come for the message on {topics} that is sent before the clear'
    return Unknown(reason, mine[0].place)


def _answers(sent: frozenset[str], doers: Sequence[Doer]) -> frozenset[str]:
    """The topics of messages that come because of what was ``sent``, itself among them."""
    found = set(sent)
    while more := {
        topic
        for doer in doers
        if heard_on(doer) in found
        for topic in published_by(doer)
        if topic not in found
    }:
        found |= more
    return frozenset(found)


def _is_answer(
    topic: str | None, answers: frozenset[str], doer: Doer, doers: Sequence[Doer]
) -> bool:
    """Whether known code publishes ``topic`` only because of a message that was sent."""
    if topic is None:
        return False
    senders = [each for each in doers if topic in published_by(each)]
    return all(each is doer or heard_on(each) in answers for each in senders)


def heard_on(doer: object) -> str | None:
    """The topic of a subscription, where that is known."""
    if not isinstance(doer, EntityState) or doer.kind is not EntityKind.SUBSCRIPTION:
        return None
    return str(doer.key.value).strip('/') if isinstance(doer.key, Const) else None


def published_by(doer: Doer) -> frozenset[str]:
    """The topics on which ``doer`` publishes, as far as they are known."""
    acts = (doer.effects or EffectLog()).publishes
    return frozenset(act.name.strip('/') for act in acts if isinstance(act.name, str))
