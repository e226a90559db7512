"""
Events that are cleared after the message whose answer sets them.

What the message brings may have come before the ``clear``, see ``cleared_events.py``.
"""

from __future__ import annotations

from collections.abc import Sequence

from ros2cc_extract.extract.static.concurrency.accesses.lost_notifications import is_heard
from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import ResourceRef, Waking
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import EntityState, RosWorld
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog, way_of
from ros2cc_extract.extract.static.python.values.values import Const
from ros2cc_extract.extract.static.units.wakers.uncertain_wakers import notifier_of
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


def why_early(reference: ResourceRef, mine: Sequence[Waking]) -> Unknown | None:
    """
    Why threads that end a wait may do so before it, or before the event is cleared, and not again.

    Each does it for what the code that waits has given before: ``jobs.put(); done.clear()``.
    """
    guard = reference.guard
    if guard is None and not reference.is_kept:
        return None  # a queue keeps what comes early
    if guard is not None and is_heard(guard, list(map(notifier_of, mine))):
        return None
    held = guard.hold if guard is not None else None
    given = {number for number, holds in reference.given if held not in holds}
    found = [_asked_for(waking, given) for waking in mine]
    if None in found or not found:
        return None
    when = 'before the clear' if reference.is_kept else 'before the wait'
    return Unknown(f'what ends it may come for what {found[0]} gets {when}', mine[0].place)


def _asked_for(waking: Waking, given: set[int]) -> str | None:
    """The queue, or whatever it is, from which a thread takes something before it ends a wait."""
    if not isinstance(waking.by, ActivityState):
        return None
    for block in waking.by.effects.blocking:
        if way_of(block) == waking.behind and isinstance(block.resource, ResourceRef):
            return str(block.resource) if block.resource.number in given else None
    return None


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
