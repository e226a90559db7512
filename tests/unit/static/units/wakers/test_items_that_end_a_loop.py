"""A loop that takes from a queue until one certain item comes is not ended by the others."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """
import asyncio
import queue
import threading
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger

STOP = object()

class Line(Node):
    def __init__(self):
        super().__init__('line')
        self.items = queue.Queue()
        self.end = object()
        self.is_late = False
        self.is_asked = self.declare_parameter('asked', False).value
        self.worker = threading.Thread(target=self.work)
        self.worker.start()
        self.create_subscription(String, 'parts', self.on_part, 10)
        group = MutuallyExclusiveCallbackGroup()
        self.create_service(Trigger, 'finish', self.on_finish, callback_group=group)

    def on_part(self, msg):
        self.is_late = True
        {put}

    def work(self):
        {work}

    def on_finish(self, request, response):
        {finish}
        return response

rclpy.init()
node = Line()
executor = rclpy.executors.MultiThreadedExecutor(3)
executor.add_node(node)
executor.spin()
"""
UNTIL = """while True:
            item = self.items.get()
            if {test}:
                break"""
LOOPS = {
    'inside': UNTIL.format(test="item == 'stop'"),
    'outside': "item = None\n        while item != 'stop':\n            item = self.items.get()",
    'walrus': "while (item := self.items.get()) != 'stop':\n            print(item)",
    'iter': "for item in iter(self.items.get, 'stop'):\n            print(item)",
    'return': UNTIL.format(test="'stop' == item").replace('break', 'return response'),
}
NOT_ENDED = 'nothing that is put into it ends the loop'
UNSURE = 'whether what is put there ends the loop'


def put(*items: str) -> str:
    return '; '.join(f'self.items.put({item})' for item in items)


def ends_of(actor: str, **parts: str) -> object:
    """Who ends the last wait of ``actor``, or why that is not known."""
    texts = {'put': "self.items.put('part')", 'work': 'pass', 'finish': 'pass', **parts}
    (unit,) = scan_text(PROGRAM.format(**texts)).units
    actors = (*unit.callbacks, *unit.activities)
    wait = next(each for each in actors if each.name == actor).blocking[-1]
    return wait.escapes.reason if wait.escapes is not None else [w.by for w in wait.wakers]


@pytest.mark.parametrize('loop', LOOPS.values(), ids=LOOPS)
def test_an_item_that_is_not_the_one_ends_no_loop(loop: str) -> None:
    assert ends_of('on_finish', finish=loop) == NOT_ENDED
    assert ends_of('on_finish', finish=loop, put=put("'part'", "'stop'")) == ['on_part']
    assert ends_of('on_finish', finish=loop, put=put('msg.data')) == UNSURE


TESTS = [
    ('item is None', 'msg', NOT_ENDED),
    ('item is None', 'msg.data', NOT_ENDED),
    ('item is None', 'None', ['on_part']),
    ('item == None', 'msg.data', NOT_ENDED),
    ('not item', 'None', ['on_part']),
    ('not item', "'part'", NOT_ENDED),
    ('not item', 'msg.data', UNSURE),
    ('item is STOP', 'self.end', NOT_ENDED),
    ('item is self.end', 'self.end', ['on_part']),
    ('item is STOP', 'STOP', ['on_part']),
    ("item[0] == 'stop'", "('stop', msg)", ['on_part']),
    ("item[0] == 'stop'", "('part', msg)", NOT_ENDED),
    ("item['kind'] == 'stop'", "{'kind': 'part'}", NOT_ENDED),
    ("item.kind == 'stop'", 'msg', UNSURE),
    ("item is None or item == 'stop'", "'stop'", ['on_part']),
    ("item is None or item == 'stop'", "'part'", NOT_ENDED),
    ("item is None or self.is_last(item)", "'part'", UNSURE),
    ("item is None or self.is_late", "'part'", UNSURE),
    ("item is None or self.is_asked", "'part'", UNSURE),
    ("item is None or self.is_asked", 'None', ['on_part']),
]  # fmt: skip


@pytest.mark.parametrize(('test', 'item', 'ends'), TESTS)
def test_what_is_put_is_held_against_the_test(test: str, item: str, ends: object) -> None:
    loop = UNTIL.format(test=test)
    assert ends_of('on_finish', finish=loop, put=put(item)) == ends


def test_names_of_the_parts_of_an_item() -> None:
    loop = UNTIL.format(test="kind == 'stop'").replace('item =', 'kind, data =')
    assert ends_of('on_finish', finish=loop, put=put("('part', msg)")) == NOT_ENDED
    assert ends_of('on_finish', finish=loop, put=put("('stop', None)")) == ['on_part']


def test_who_joins_a_thread_waits_for_the_item_that_ends_it() -> None:
    work = UNTIL.format(test='item is None')
    assert ends_of('work', work=work, finish='self.worker.join()') == []
    finish = 'self.items.put(None); self.worker.join()'
    assert ends_of('work', work=work, finish=finish) == ['on_finish']


def test_a_loop_that_also_ends_otherwise_is_left_as_it_is() -> None:
    loop = (
        UNTIL.format(test="item == 'stop'")
        + '\n            if self.count > 3:\n                break'
    )
    assert ends_of('on_finish', finish=loop) == ['on_part']


def test_an_item_that_a_helper_puts_is_each_of_those_that_it_is_given() -> None:
    loop = UNTIL.format(test='item is None')
    pushes = 'self.push(msg); self.push(None)'
    helper = f'{pushes}\n\n    def push(self, item):\n        self.items.put(item)'
    assert ends_of('on_finish', finish=loop, put=helper) == UNSURE
