"""Kinds of waits that random programs draw: how each is made, waited for, and ended."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Kind:
    """
    What a program waits for.

    :param made: what ``__init__`` stores; ``{0}`` is its name.
    :param waits: lines that wait; ``ends`` are lines that end one wait, or all.
    :param in_coroutines: it is awaited.
    """

    made: str
    waits: str
    ends: str
    in_coroutines: bool = False


KINDS = {
    'event': Kind('threading.Event()', 'self.{0}.wait()', 'self.{0}.set()'),
    'queue': Kind('queue.Queue()', 'self.{0}.get()', 'self.{0}.put(1)'),
    'semaphore': Kind('threading.Semaphore(0)', 'self.{0}.acquire()', 'self.{0}.release()'),
    'condition': Kind(
        'threading.Condition()',
        'with self.{0}:\n    self.{0}.wait()',
        'with self.{0}:\n    self.{0}.notify_all()',
    ),
    'flag': Kind('False', 'while not self.{0}:\n    time.sleep(0.01)', 'self.{0} = True'),
    'promise': Kind(
        'Future()',
        'await self.{0}',
        'if not self.{0}.done():\n    self.{0}.set_result(None)',
        in_coroutines=True,
    ),
    'predicate': Kind(
        '0',
        'with self.changed:\n    self.changed.wait_for(lambda: self.{0} > 0)',
        'with self.changed:\n    self.{0} += 1\n    self.changed.notify_all()',
    ),
    'count': Kind('0', 'while self.{0} < 2:\n    time.sleep(0.01)', 'self.{0} += 1'),
    'barrier': Kind('threading.Barrier(2)', 'self.{0}.wait()', 'self.{0}.wait()'),
    'polled': Kind(
        'Future()',
        'while not self.{0}.done():\n    time.sleep(0.01)',
        'if not self.{0}.done():\n    self.{0}.set_result(None)',
    ),
    'result': Kind(
        'concurrent.futures.Future()',
        'self.{0}.result()',
        'if not self.{0}.done():\n    self.{0}.set_result(None)',
    ),
}
#: Bounded ones, by the places that they have: room is waited for.
for _places in (1, 2, 3):
    KINDS[f'room_{_places}'] = Kind(
        f'queue.Queue(maxsize={_places})',
        'self.{0}.put(1)',
        'if not self.{0}.empty():\n    self.{0}.get()',
    )
    KINDS[f'permits_{_places}'] = Kind(
        f'threading.Semaphore({_places})', 'self.{0}.acquire()', 'self.{0}.release()'
    )
