"""
Semaphores and bounded queues of a few places, where runs take more than there is.

Each node was run on rclpy 7.1.6: those that are *clean* went on, all others stopped, some of them
after a few runs.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.shapes.variants import node, said_of_waits

_TIMER = 'self.create_timer(0.2, self.tick, callback_group=self.own)\n'
_QUEUE = 'self.jobs = queue.Queue(maxsize={size})\n' + _TIMER
_TOKENS = 'self.tokens = threading.Semaphore({tokens})\n'
_OTHER = 'self.create_timer(0.3, self.tock, callback_group=self.other)\n'
_PUT, _GET = '    self.jobs.put(1)\n', '    self.jobs.get()\n'
_TAKE, _GIVE = '    self.tokens.acquire()\n', '    self.tokens.release()\n'
_TICK, _TOCK = '\ndef tick(self):\n', '\ndef tock(self):\n'
_SERVICE = """
self.client = self.create_client(Trigger, 'go', callback_group=self.other)
self.create_service(Trigger, 'go', self.answer, callback_group=MutuallyExclusiveCallbackGroup())
"""
_CALLS = '        self.client.call(Trigger.Request())\n'
_OVER_A_CALL = _TICK + '    with self.tokens:\n' + _CALLS
_IN_FULL = _TICK + _TAKE + '    try:\n' + _CALLS + '    finally:\n    ' + _GIVE
_AT_TIMES = _TICK + '    if rclpy.ok():\n        with self.tokens:\n    ' + _CALLS
_ANSWERS = """
def answer(self, request, response):
    with self.tokens:
        return response
"""
_ANSWERS_AT_ONCE = """
def answer(self, request, response):
    return response
"""
_ONE, _TWO = (_TOKENS.format(tokens=tokens) + _TIMER for tokens in (1, 2))
_DROPS = '    if self.jobs.full():\n        self.jobs.get_nowait()\n'

NODES = {
    'two put where one fits': (_QUEUE.format(size=1), _TICK + _PUT * 2 + _GET * 2, 'CC109'),
    'two put where two fit': (_QUEUE.format(size=2), _TICK + _PUT * 2 + _GET * 2, 'clean'),
    'one after the other': (_QUEUE.format(size=1), _TICK + (_PUT + _GET) * 2, 'clean'),
    'one more is put than got': (_QUEUE.format(size=1), _TICK + _PUT * 2 + _GET, 'CC109'),
    'room is made before': (_QUEUE.format(size=1), _TICK + _DROPS + _PUT, 'clean'),
    'another one puts too': (
        _QUEUE.format(size=2) + _OTHER,
        _TICK + _PUT * 2 + _GET * 2 + _TOCK + _PUT,
        'CC109',
    ),
    'two taken of one': (_ONE, _TICK + _TAKE * 2 + _GIVE * 2, 'CC109'),
    'two taken of two': (_TWO, _TICK + _TAKE * 2 + _GIVE * 2, 'clean'),
    'one of two lies with each': (
        _TWO + _OTHER,
        (_TICK + _TAKE + '    time.sleep(0.01)\n' + _TAKE + _GIVE * 2)
        + (_TOCK + _TAKE + '    time.sleep(0.01)\n' + _TAKE + _GIVE * 2),
        'CC109',
    ),
    'less is given than taken': (
        _ONE + _OTHER,
        _TICK + _TAKE * 2 + _GIVE + _TOCK + _TAKE + _GIVE,
        'CC109',
    ),
    'the only one kept over a call': (_ONE + _SERVICE, _OVER_A_CALL + _ANSWERS, 'CC109'),
    'it is given back at last': (_ONE + _SERVICE, _IN_FULL + _ANSWERS, 'CC109'),
    'it is kept at times': (_ONE + _SERVICE, _AT_TIMES + _ANSWERS, 'CC109'),
    'one of two kept over a call': (_TWO + _SERVICE, _OVER_A_CALL + _ANSWERS, 'clean'),
    'nobody else takes one': (_ONE + _SERVICE, _OVER_A_CALL + _ANSWERS_AT_ONCE, 'clean'),
}


@pytest.mark.parametrize(('init', 'methods', 'said'), NODES.values(), ids=list(NODES))
def test_stock(init: str, methods: str, said: str, tmp_path: Path) -> None:
    assert said_of_waits(node(init, methods), tmp_path) == said
