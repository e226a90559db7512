"""
Semaphores that begin with nothing to take are no locks: somebody else must give first.

Each node was run on rclpy 7.1.6.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.shapes.variants import node, said_of_waits

_INIT = """
self.tokens = threading.Semaphore({tokens})
self.create_timer(0.2, self.tick, callback_group=self.own)
self.create_timer(0.3, self.tock, callback_group=self.{group})
"""
_GIVES = """
def tock(self):
    self.tokens.release()
"""
_TAKES = """
def tick(self):
    self.tokens.acquire()
"""
_GIVES_BACK = _TAKES + '    self.tokens.release()\n'
_BY_WITH = """
def tick(self):
    with self.tokens:
        time.sleep(0.01)
"""


@pytest.mark.parametrize('takes', [_TAKES, _GIVES_BACK, _BY_WITH], ids=['', 'gives', 'with'])
def test_whoever_takes_waits_for_others(takes: str, tmp_path: Path) -> None:
    for group, said in (('own', 'CC109'), ('other', 'clean')):
        init = _INIT.format(tokens=0, group=group)
        folder = tmp_path / group
        folder.mkdir()
        assert said_of_waits(node(init, takes + _GIVES), folder) == said


def test_two_who_give_only_what_they_took(tmp_path: Path) -> None:
    other = _BY_WITH.replace('tick', 'tock')
    for tokens, said in ((0, 'CC109'), (1, 'clean')):
        init = _INIT.format(tokens=tokens, group='other')
        folder = tmp_path / str(tokens)
        folder.mkdir()
        assert said_of_waits(node(init, _BY_WITH + other), folder) == said


def test_what_the_set_up_gives_makes_it_a_lock(tmp_path: Path) -> None:
    init = _INIT.format(tokens=0, group='own') + 'self.tokens.release()\n'
    both = _BY_WITH + _BY_WITH.replace('tick', 'tock')
    assert said_of_waits(node(init, both), tmp_path) == 'clean'


def test_who_gives_first_has_something_to_take(tmp_path: Path) -> None:
    first = """
def tick(self):
    self.tokens.release()
    self.tokens.acquire()

def tock(self):
    if self.tokens.acquire(blocking=False):
        self.tokens.release()
"""
    assert said_of_waits(node(_INIT.format(tokens=0, group='own'), first), tmp_path) == 'clean'


def test_a_lock_that_the_set_up_takes_is_for_others_to_give_back(tmp_path: Path) -> None:
    taken = _INIT.replace('Semaphore({tokens})', 'Lock()') + 'self.tokens.acquire()\n'
    both = _BY_WITH + _BY_WITH.replace('tick', 'tock')
    nodes = {
        'own': (node(taken.format(group='own'), _TAKES + _GIVES), 'CC109'),
        'other': (node(taken.format(group='other'), _TAKES + _GIVES), 'clean'),
        'nobody': (node(taken.format(group='other'), both), 'CC109'),
        'given': (node(taken.format(group='own') + 'self.tokens.release()\n', both), 'clean'),
    }
    for name, (text, said) in nodes.items():
        folder = tmp_path / name
        folder.mkdir()
        assert said_of_waits(text, folder) == said
