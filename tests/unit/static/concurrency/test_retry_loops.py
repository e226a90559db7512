"""A loop that tries again until no error is raised waits for what makes the attempt succeed."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from tests.random_waits.suite import ENDS, FOUND, UNDECIDED, judge

PROGRAM = """\
import collections
import queue
import time
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String


class Shelf(Node):
    def __init__(self):
        super().__init__('shelf')
        self.own = MutuallyExclusiveCallbackGroup()
        self.other = MutuallyExclusiveCallbackGroup()
        self.items = {made}
        self.create_timer(1.0, self.take, callback_group=self.own)
        self.create_subscription(String, 'in', self.fill, 10, callback_group=self.{group})

    def take(self):
        while {test}:
            try:
                item = {attempt}
                {leaves}
            except {error}:
                {retries}

    def fill(self, message):
        {fills}


rclpy.init()
executor = MultiThreadedExecutor(num_threads=3)
executor.add_node(Shelf())
executor.spin()
"""
ITEMS = {'made': '{}', 'attempt': "self.items['a']", 'error': 'KeyError'}
ITEMS |= {'fills': "self.items['a'] = message"}
DEQUE = {'made': 'collections.deque()', 'attempt': 'self.items.popleft()', 'error': 'IndexError'}
DEQUE |= {'fills': 'self.items.append(message)'}
QUEUE = {'made': 'queue.Queue()', 'attempt': 'self.items.get(timeout=0.5)'}
QUEUE |= {'error': 'queue.Empty', 'fills': 'self.items.put(message)'}
AT_ONCE = QUEUE | {'attempt': 'self.items.get_nowait()'}


def program(**parts: str) -> str:
    given = {'test': 'True', 'leaves': 'break', 'retries': 'time.sleep(0.1)', 'group': 'own'}
    return PROGRAM.format(**given | parts)


def verdict(**parts: str) -> str:
    return judge(program(**parts)).get('take', ENDS)


NOT_YET = QUEUE | {'attempt': 'self.items.get(block=False)'}
NO_ROOM = {'made': 'queue.Queue(maxsize=1)', 'attempt': 'self.items.put_nowait(1)'}
NO_ROOM |= {'error': 'queue.Full', 'fills': 'self.items.get_nowait()'}
KINDS = {'items': ITEMS, 'deque': DEQUE, 'queue': QUEUE, 'at once': AT_ONCE, 'not yet': NOT_YET}


@pytest.mark.parametrize('kind', KINDS.values(), ids=KINDS)
@pytest.mark.parametrize('leaves', ['break', 'return'])
@pytest.mark.parametrize('test', ['True', 'rclpy.ok()'])
def test_it_waits_for_who_cannot_run(kind: dict[str, str], leaves: str, test: str) -> None:
    assert verdict(**kind, leaves=leaves, test=test) == FOUND
    assert verdict(**kind, leaves=leaves, test=test, group='other') == ENDS


def test_room_in_a_queue_is_waited_for_too() -> None:
    both = NO_ROOM | {'attempt': '(self.items.put_nowait(1), self.items.put_nowait(2))'}
    assert verdict(**NO_ROOM) == FOUND
    assert verdict(**NO_ROOM, group='other') != FOUND
    assert verdict(**both) == UNDECIDED


def test_what_no_data_tells_is_undecided() -> None:
    assert verdict(**ITEMS | {'attempt': 'plant.take()'}) == UNDECIDED


@pytest.mark.parametrize('kind', [ITEMS, DEQUE, QUEUE, AT_ONCE])
def test_an_error_that_leaves_the_loop_is_the_end_of_it(kind: dict[str, str]) -> None:
    assert verdict(**kind, retries='break') == ENDS
    assert verdict(**kind, retries='raise') == ENDS


def test_a_handler_that_makes_room_sees_to_it_itself() -> None:
    full = AT_ONCE | {'made': 'queue.Queue(maxsize=2)', 'error': 'queue.Full'}
    full |= {'attempt': 'self.items.put_nowait(1)', 'retries': 'self.items.get_nowait()'}
    assert verdict(**full) == ENDS


def test_what_a_person_types_again_and_again_is_that_wait_alone() -> None:
    typed = ITEMS | {'attempt': "float(input('x: '))", 'error': 'ValueError'}
    text = program(**typed)
    (unit,) = scan_text(text).units
    take = next(each for each in unit.callbacks if each.name == 'take')
    assert [block.call for block in take.blocking if block.call != 'time.sleep'] == ['input']
