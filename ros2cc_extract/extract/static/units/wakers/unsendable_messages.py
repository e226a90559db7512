"""
Messages that no known code can send before the wait that they end is over.

A program that publishes a topic itself, and only from callbacks that the waiting one keeps out of
their group, goes on by a message that was on its way when the wait began, or by one of another
process. Neither is known. A topic that no known code publishes is another matter: its
messages are taken to come by themselves. Measured with rclpy 7.1.6 and 9.1.2.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import ResourceRef, Waking
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import EntityState, RosWorld
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog, way_of
from ros2cc_extract.extract.static.units.wakers.lost_events import heard_on, published_by
from ros2cc_extract.extract.static.units.wakers.mutual_exclusion import keeps_out
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import EntityKind

Doer = EntityState | ActivityState
# They are there only if they were made in the same run.
_OF_A_RUN = (EntityKind.TASK, EntityKind.DONE_CALLBACK)


def unsent_before_end(
    raw: Blocking, sent: Collection[str], wakers: Sequence[object], doer: Doer, world: RosWorld
) -> str | None:
    """
    The topics whose messages end a wait, if no known code can publish one meanwhile.

    :param sent: topics on which ``doer`` itself has published before; these are on their way.
    :param wakers: callbacks and activities that end it.
    """
    needed = {root: topic for waker in wakers for root, topic in _needs(waker, doer)}
    doers: tuple[Doer, ...] = (*world.entities, *world.activities)
    published = {topic for each in doers for topic in published_by(each)}
    if raw.seconds is not None or published.isdisjoint(needed.values()) or None in wakers:
        return None
    free = [each for each in doers if not keeps_out(doer, each, raw)]
    if any(not isinstance(act.name, str) for each in free for act in _effects(each).publishes):
        return None
    runs = _running(doer, free, published, sent)
    is_ended = any(waker in runs or (waker is doer and doer in free) for waker in wakers)
    topics = {topic for root, topic in needed.items() if root in free}
    return ', '.join(sorted(topics)) if topics and not is_ended else None


def comes_unasked(waking: Waking, reference: ResourceRef) -> bool:
    """Whether it comes without a wait of its own for the same thing."""
    if not isinstance(waking.by, EntityState | ActivityState):
        return True
    blocks = _effects(waking.by).blocking
    ways = [way_of(block) for block in blocks]
    behind = ways.index(waking.behind) + 1 if waking.behind in ways else 0
    return not any(_is_for(block, reference) for block in blocks[:behind])


def is_first(raw: Blocking, reference: ResourceRef, doer: Doer) -> bool:
    """Whether ``doer`` has not waited for the same thing before."""
    before = (block for block in _effects(doer).blocking if _is_for(block, reference))
    first = next(before, None)
    return first is None or way_of(first) == way_of(raw)


def sent_in_hold(reference: ResourceRef, doer: Doer) -> frozenset[str]:
    """The topics published on while the notifying code had to wait for the lock."""
    begun = reference.guard.begun if reference.guard is not None else frozenset()
    acts = (act for act in _effects(doer).publishes if act.source in begun)
    return frozenset(str(act.name).strip('/') for act in acts)


def _is_for(block: Blocking, reference: ResourceRef) -> bool:
    other = block.resource
    return isinstance(other, ResourceRef) and other.number == reference.number


def _effects(doer: Doer) -> EffectLog:
    return doer.effects or EffectLog()


def _needs(waker: object, doer: Doer) -> Iterator[tuple[Doer, str]]:
    """The subscription that sets off ``waker``, or is it, and its topic."""
    root = waker
    while isinstance(root, EntityState) and _is_made(root) and root.maker is not doer:
        root = root.maker
    topic = heard_on(root)
    if topic is not None and isinstance(root, EntityState):
        yield root, topic


def _is_made(entity: EntityState) -> bool:
    return entity.kind in _OF_A_RUN and isinstance(entity.maker, EntityState)


def _running(
    doer: Doer, free: Sequence[Doer], published: Collection[str], sent: Collection[str]
) -> set[Doer]:
    """Those of ``free`` that run by themselves or because of ``doer``, and those they start."""
    runs: set[Doer] = set()
    on_its_way = set(sent)

    def starts(each: Doer) -> bool:
        if isinstance(each, EntityState) and _is_made(each):
            return each.maker is doer or each.maker in runs
        topic = heard_on(each)
        return topic is None or topic in on_its_way or topic not in published

    while more := {each for each in free if each not in runs and starts(each)}:
        runs |= more
        on_its_way.update(topic for each in more for topic in published_by(each))
    return runs
