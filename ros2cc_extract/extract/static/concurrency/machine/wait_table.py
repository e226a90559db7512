"""
What waits, and what ends it: the form of such tables, and the one of Python's own libraries.

Source: CPython 3.12, ``threading.py``, ``queue.py``, ``concurrent/futures/``.
"""

from __future__ import annotations

from ros2cc_extract.extract.static.concurrency.machine.outside_names import CALLS, READS_OF_CAMERAS
from ros2cc_extract.extract.static.python.machine.path_facts import Word
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.effects import (
    ANSWER_LOOP,
    AWAIT,
    BUSY_LOOP,
    NOT_FOLLOWED,
    OUTSIDE,
    TIME,
    TURN,
    UNKNOWN_WAIT,
    WORKING_LOOP,
    Needs,
)

SPIN_UNTIL = 'spin_until_future_complete'
"""How code that no callback runs waits for a future, and spins meanwhile."""


@dataclass(frozen=True)
class WaitRow:
    """
    One kind of wait.

    :param ended_by: operations on the object that end it.
    :param always: who may always end it, in addition to others.
    :param unless_asked: it does not wait where it was asked before whether it would.
    :param rival: what others do that makes the answer to that question false.
    :param raises: by which exception it says that its time is over, on some release.
    """

    ended_by: frozenset[Word] = frozenset()
    needs: Needs = Needs.ONCE
    always: tuple[str, ...] = ()
    unless_asked: bool = False
    rival: Word | None = None
    raises: type[Exception] | None = None


def _row(
    *words: Word,
    needs: Needs = Needs.ONCE,
    unless_asked: bool = False,
    rival: Word | None = None,
) -> WaitRow:
    return WaitRow(frozenset(words), needs, unless_asked=unless_asked, rival=rival)


SLEEP = WaitRow(always=(TIME,))
OF_OUTSIDE = WaitRow(always=(OUTSIDE,))
_FUTURE = _row(Word.SET, Word.END, unless_asked=True)

WAITS: dict[str, WaitRow] = {
    'Event.wait': _row(Word.SET),
    'Condition.wait': _row(Word.SET, needs=Needs.EACH),
    'Condition.wait_for': _row(Word.SET, needs=Needs.EACH),
    'Queue.get': _row(Word.PUT, needs=Needs.EACH, unless_asked=True, rival=Word.GET),
    'Queue.put': _row(Word.GET, needs=Needs.EACH, unless_asked=True, rival=Word.PUT),
    'Queue.join': _row(Word.DONE, needs=Needs.EACH),
    'asyncio.Queue.get': _row(Word.PUT, needs=Needs.EACH, unless_asked=True, rival=Word.GET),
    'asyncio.Queue.put': _row(Word.GET, needs=Needs.EACH, unless_asked=True, rival=Word.PUT),
    'asyncio.Queue.join': _row(Word.DONE, needs=Needs.EACH),
    'asyncio.Event.wait': _row(Word.SET),
    'asyncio.Lock.acquire': _row(Word.RELEASE, needs=Needs.EACH),
    'Barrier.wait': _row(Word.ARRIVE, needs=Needs.ALL),
    'Lock.acquire': _row(Word.RELEASE, needs=Needs.EACH),
    'Semaphore.acquire': _row(Word.RELEASE, needs=Needs.EACH),
    'Thread.join': _row(Word.END),
    'Process.join': _row(Word.END),
    'Future.result': _FUTURE,
    'Future.exception': _FUTURE,
    'futures.wait': _FUTURE,
    'futures.as_completed': _FUTURE,
    'Executor.map': _FUTURE,
    'Executor.shutdown': _row(Word.SET, Word.END),
    'asyncio await': _FUTURE,
    UNKNOWN_WAIT: _row(Word.END),
    NOT_FOLLOWED: _row(Word.END),
    'await': _FUTURE,
    'busy wait': _FUTURE,
    SPIN_UNTIL: _FUTURE,
    WORKING_LOOP: _FUTURE,
    'time.sleep': SLEEP,
    'asyncio.sleep': SLEEP,
    BUSY_LOOP: SLEEP,
    TURN: SLEEP,
    ANSWER_LOOP: OF_OUTSIDE,
    **dict.fromkeys(CALLS, OF_OUTSIDE),
    **dict.fromkeys(READS_OF_CAMERAS, SLEEP),
}
# What a coroutine awaits in the loop that runs it holds no thread.
WAITS |= {f'{AWAIT} {name}': row for name, row in WAITS.items() if name.startswith('asyncio.')}
WAITS[f'{AWAIT} Clock.sleep'] = SLEEP
WAITS[f'{AWAIT} AsyncClient.wait_for_service'] = OF_OUTSIDE
WAITS[f'{AWAIT} AsyncNode.wait_for_node'] = OF_OUTSIDE

TAKES_PERMIT = frozenset(
    {'Semaphore.acquire', 'Lock.acquire', 'asyncio.Lock.acquire', f'{AWAIT} asyncio.Lock.acquire'}
)
"""Waits for something of which there is a number, and that is given back."""

NO_ROW = WaitRow()
