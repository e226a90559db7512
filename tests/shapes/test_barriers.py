"""
Barriers are used again: a round that not all come to does not end.

Each node was run on rclpy 7.1.6. Those that are *clean* went on; those that are found or undecided
stopped, but for callbacks that come unequally often and again and again.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.shapes.variants import node, said_of_waits

_CALLBACKS = """
self.gate = threading.Barrier({parties})
self.create_timer(0.2, self.tick, callback_group=self.own)
self.create_timer(0.3, self.tock, callback_group=self.other)
"""
_ONCE = """
def {name}(self):
    self.gate.wait()
"""
_TICK, _TOCK, _TUCK, _WORK = (_ONCE.format(name=n) for n in ('tick', 'tock', 'tuck', 'work'))
_TWICE = _TICK + '    self.gate.wait()\n'
_WITH_A_THREAD = """
self.gate = threading.Barrier(2)
threading.Thread(target=self.work, daemon=True).start()
self.create_timer(0.2, self.tick, callback_group=self.own)
"""
_ALONE = """
self.gate = threading.Barrier({parties})
self.create_timer(0.2, self.tick, callback_group={group})
"""
_STARTS = """
def tick(self):
    worker = threading.Thread(target=self.work)
    worker.start()
{meets}
    worker.join()
"""
_MEETS = '    self.gate.wait()\n'
_FOREVER = """
def work(self):
    while True:
        self.gate.wait()
"""
_THIRD = 'self.create_timer(0.3, self.tuck, callback_group=MutuallyExclusiveCallbackGroup())\n'
_TWO, _THREE = (_CALLBACKS.format(parties=parties) for parties in (2, 3))
_SELF = _ALONE.format(parties=2, group='self.own')

NODES = {
    'two come': (_TWO, _TICK + _TOCK, 'clean'),
    'three must come': (_THREE, _TICK + _TOCK, 'CC109'),
    'three come': (_THREE + _THIRD, _TICK + _TOCK + _TUCK, 'clean'),
    'three come where two must': (_TWO + _THIRD, _TICK + _TOCK + _TUCK, 'undecided'),
    'one comes twice': (_TWO, _TWICE + _TOCK, 'undecided'),
    'a thread comes once': (_WITH_A_THREAD, _TICK + _WORK, 'undecided'),
    'a thread comes for ever': (_WITH_A_THREAD, _TICK + _FOREVER, 'clean'),
    'a thread of each run': (_SELF, _STARTS.format(meets=_MEETS) + _WORK, 'clean'),
    'two rounds with it': (_SELF, _STARTS.format(meets=_MEETS * 2) + _WORK + _MEETS, 'clean'),
    'one round more than it': (_SELF, _STARTS.format(meets=_MEETS * 2) + _WORK, 'undecided'),
    'it comes alone': (_SELF, _TICK, 'CC109'),
    'one must come': (_ALONE.format(parties=1, group='self.own'), _TICK, 'clean'),
    'runs that meet': (
        'from rclpy.callback_groups import ReentrantCallbackGroup\n'
        + _ALONE.format(parties=2, group='ReentrantCallbackGroup()'),
        _TICK,
        'undecided',
    ),
    'it is broken off': (_THREE, _TICK + '    self.gate.abort()\n' + _TOCK, 'undecided'),
}


@pytest.mark.parametrize(('init', 'methods', 'said'), NODES.values(), ids=list(NODES))
def test_barrier(init: str, methods: str, said: str, tmp_path: Path) -> None:
    assert said_of_waits(node(init, methods), tmp_path) == said
