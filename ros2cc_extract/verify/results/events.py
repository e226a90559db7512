"""
Events of a run: what one process does in a step, with fields, and the words for it.

The templates say which event an edge is (``generator.events``); the words stand here and nowhere
else. What classifies a run reads the fields.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from ros2cc_extract.light_dataclasses import dataclass

#: Words of each kind and form; what stands in brackets is said where all its fields are known.
WORDS = {
    # Callbacks and groups.
    'due': 'timer {who} is due',
    'arrival': 'data arrives for {who}',
    'arrival again': 'data arrives for {who}',
    'done outside': 'a thread outside {executor} completes what {who} awaits',
    'done unseen': 'a thread outside {executor} completes what {who} awaits, which wakes no '
    'thread',
    'close': '{group} closes',
    'open': '{group} opens',
    'ready': '{who} becomes ready',
    'ready unseen': '{who} becomes ready and unready again, unseen',
    'unready': '{who} is no longer ready',
    # Threads.
    'take': '{thread} takes {who} from the queue',
    'refuse': '{thread} is refused {who}: its group is closed',
    'start': '{who} starts[ on {thread}][, inside {inside}]',
    'end': '{who} ends[ on {thread}]',
    'answer': '{who} answers',
    'raise': '{who} spins {executor}, which refuses because it is already spinning, and raises '
    'on {thread}',
    # Waits.
    'wait': '{who} waits [on {thread} ]for {needed}',
    'wait lock': '{who} waits [on {thread} ]for the lock of {needed}',
    'wait service': '{who} waits [on {thread} ]for the service of {needed}, which nothing here '
    'offers',
    'wait signal': '{who} waits [on {thread} ]for {awaited}',
    'await': '{who} awaits {awaited} and leaves {thread}',
    'await outside': '{who} awaits what a thread outside {executor} completes, and leaves '
    '{thread}',
    'spin': '{who} spins {executor} on {thread}[ for {needed}]',
    'spin taken': '{who} removes its node from {executor} and spins it on {thread}[ for {needed}]',
    'found': '{who} finds that {needed} has run',
    'signal': '{who} signals {resource}',
    'silence': '{who} does not signal {resource}',
    'go_on': '{who} goes on',
    'go_on resumed': '{who} goes on, on {thread}',
    'go_on served': '{who} has served one callback and goes on',
    'go_on timeout': '{who} has spun long enough and goes on',
    # Executors.
    'wake': '{executor} wakes up: something is ready',
    'wake task': '{executor} wakes up: a task is ready',
    'queue': '{by} queues {who}',
    'queue last': '{by} queues {who} and stops: its spin raises what a callback raised',
    'leave': '{executor} leaves {who}: its group is closed',
    'stop': '{executor} stops: its spin raises what the callback raised',
    # The published executor.
    'poll': '{executor} polls which callbacks are ready',
    'poll seen': '{executor} polls and sees {who} ready',
    'full': '{executor} waits: all threads are busy',
    'free': '{executor} goes on: {thread} is idle',
    'assign': '{executor} assigns {who} to {thread}',
    'pass': '{executor} passes over {who}: not ready, or its group is closed',
    'pass unready': '{executor} passes over {who}: it is not ready',
    'pass closed': '{executor} passes over {who}: its group is closed',
}
_OPTIONAL = re.compile(r'\[([^\[\]]*)\]')
#: Fields that are names of callbacks, activities and groups.
_NAMES = ('who', 'by', 'group', 'needed', 'inside')
_FIELD = re.compile(r'\{(\w+)\}')


@dataclass(frozen=True, kw_only=True)
class Event:
    """
    What a process does in a step; fields that its kind has not are ``None``.

    :param kind: first word of a key of ``WORDS``; ``form`` is the rest.
    :param who: name of the callback it is about.
    :param by: what hands it to the pool.
    :param group: that opens or closes.
    :param needed: name of the callback that must run before a wait ends, or that has the lock.
    :param resource: that is waited for, or gets a signal.
    :param wakers: names of those that end a wait for ``resource``.
    :param inside: the callback in whose nested spin ``who`` runs.
    :param wait: which of the waits of ``who`` in the model, from 0.
    """

    kind: str
    form: str = ''
    who: str | None = None
    by: str | None = None
    thread: str | None = None
    group: str | None = None
    executor: str | None = None
    needed: str | None = None
    resource: str | None = None
    wakers: tuple[str, ...] = ()
    inside: str | None = None
    wait: int | None = None

    @property
    def is_wait(self) -> bool:
        """True where ``who`` begins to wait for others."""
        return self.kind in ('wait', 'await', 'spin')

    @property
    def is_spin(self) -> bool:
        """True for a wait that serves others meanwhile."""
        return self.kind == 'spin'

    @property
    def is_for_lock(self) -> bool:
        """True for a wait for a lock, which ``needed`` holds."""
        return (self.kind, self.form) == ('wait', 'lock')

    @property
    def is_for_service(self) -> bool:
        """True for a wait for a service that nobody in the unit offers."""
        return (self.kind, self.form) == ('wait', 'service')

    @property
    def awaited(self) -> str | None:
        """What a wait is for, in words."""
        return self.awaited_in({})

    @property
    def enders(self) -> tuple[str, ...]:
        """Names of those that can end a wait."""
        return self.wakers or (() if self.needed is None else (self.needed,))

    @property
    def words(self) -> str:
        """Say it in a sentence, with the names of the model."""
        return self.said({})

    def said(self, names: Mapping[str, str]) -> str:
        """
        Say it in a sentence.

        :param names: words for names of the model; a name without stays as it is.
        """
        return _FIELD.sub(lambda match: self._said(match[1], names), self._pattern)

    def awaited_in(self, names: Mapping[str, str]) -> str | None:
        """``awaited``, with words for names."""
        wakers = ' or '.join(names.get(waker, waker) for waker in self.wakers)
        return wakers or self.resource or (self.needed and names.get(self.needed, self.needed))

    @property
    def mentions(self) -> tuple[str, ...]:
        """Names in the order of the sentence."""
        named: list[str] = []
        for name in _FIELD.findall(self._pattern):
            is_of_many = name == 'awaited' and self.wakers
            named.extend(self.wakers if is_of_many else (self._field(name),))
        return tuple(named)

    @property
    def _pattern(self) -> str:
        return _OPTIONAL.sub(
            lambda match: match[1] if all(self._known(match[1])) else '',
            # A cache may hold what no template says: that has no words.
            WORDS.get(f'{self.kind} {self.form}'.strip(), ''),
        )

    def _known(self, part: str) -> Iterator[bool]:
        return (getattr(self, name) is not None for name in _FIELD.findall(part))

    def _said(self, name: str, names: Mapping[str, str]) -> str:
        if name == 'awaited':
            return str(self.awaited_in(names))
        value = self._field(name)
        unnamed = f'group {value}' if name == 'group' else value
        return names.get(value, unnamed) if name in _NAMES else value

    def _field(self, name: str) -> str:
        return str(getattr(self, name))
