"""Properties and operators: the code behind them waits, reads and writes as any other."""

from __future__ import annotations

import textwrap

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of
from ros2cc_extract.spec.model import Callback

VALVE = """
import threading
import rclpy
from rclpy.node import Node
from std_msgs.msg import Bool

class Valve:
    def __init__(self):
        self.done = threading.Event()
        self._open, self.moves = False, 0

    @property
    def open(self):
        return self._open

    @open.setter
    def open(self, value):
        self._open = value
        self.done.wait()

class Counted(Valve):
    @Valve.open.setter
    def open(self, value):
        self.moves += 1

class ValveNode(Node):
    def __init__(self):
        super().__init__('valve_node')
        self.valve = VALVE()
        self.create_subscription(Bool, 'open', self.on_open, 10)
        self.create_subscription(Bool, 'state', self.on_state, 10)

    def on_open(self, msg):
        STATEMENT

    def on_state(self, msg):
        self.valve.done.set()

rclpy.init()
rclpy.spin(ValveNode())
"""


def opening(statement: str = 'self.valve.open = msg.data', valve: str = 'Valve') -> Callback:
    text = VALVE.replace('STATEMENT', statement).replace('VALVE', valve)
    (unit,) = scan_text(text).units
    return next(each for each in unit.callbacks if each.function_name == 'on_open')


@pytest.mark.parametrize(
    'statement',
    ['self.valve.open = msg.data', 'self.valve.open |= msg.data', 'a = self.valve.open = True'],
)
def test_a_wait_behind_an_assignment_is_one_of_the_callback(statement: str) -> None:
    callback = opening(statement)
    assert [block.call for block in callback.blocking] == ['Event.wait']
    assert [write.name for write in callback.writes] == ['Valve._open']


def test_the_setter_of_a_derived_class_stands_for_that_of_the_base() -> None:
    callback = opening(valve='Counted')
    assert callback.blocking == ()
    assert [write.name for write in callback.writes] == ['Counted.moves']


def test_an_update_through_a_property_rests_on_what_was_read() -> None:
    callback = opening('self.valve.open += 1')
    assert [(read.name, read.rests) for read in callback.reads if '_open' in read.name]
    assert [write.rests for write in callback.writes] == [True]


BUDGET = """
import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger

class Account:
    def __init__(self):
        self._left = 1000

    @property
    def left(self):
        return self._left

    @left.setter
    def left(self, value):
        self._left = max(0, value)

class Budget(Node):
    def __init__(self):
        super().__init__('budget')
        self.account = Account()
        self.left = 1000
        group = ReentrantCallbackGroup()
        self.prices = self.create_client(Trigger, 'price', callback_group=group)
        self.create_subscription(String, 'job', self.on_job, 50, callback_group=group)

    async def price(self):
        answer = await self.prices.call_async(Trigger.Request())
        return len(answer.message)

    async def less(self, left):
        return left - await self.price()

    def take(self, before, price):
        self.left = before - price

    async def on_job(self, msg):
        STATEMENTS

rclpy.init()
rclpy.spin(Budget())
"""


def of_budget(statements: str) -> list[str]:
    text = BUDGET.replace('STATEMENTS', textwrap.indent(statements, ' ' * 8).strip())
    found = findings_of(scan_text(text).units, [], [None])
    return [each.code for each in found if each.code.startswith('CC3')]


@pytest.mark.parametrize(
    'statements',
    [
        'self.left = self.left - await self.price()',
        'self.left -= await self.price()',
        'self.left = self.left - (\n    await self.price()\n)',
        'before = self.left\nself.left = before - await self.price()',
        'before: int = self.left\nself.left: int = before - await self.price()',
        'self.take(self.left, await self.price())',
        'self.left = await self.less(self.left)',
        'self.left = self.left if msg.data else await self.less(self.left)',
        'left = await self.less(self.left)\nself.left = left',
        'self.account.left = await self.less(self.account.left)',
        'self.account.left = self.account.left - await self.price()',
        'self.account.left -= await self.price()',
        'before = self.account.left\nself.account.left = before - await self.price()',
    ],
)
def test_what_was_read_before_an_await_of_the_same_statement_is_old(statements: str) -> None:
    assert of_budget(statements) == ['CC304']


@pytest.mark.parametrize(
    'statements',
    [
        'price = await self.price()\nself.left = self.left - price',
        'price = await self.price()\nself.left -= price',
        'price = await self.price()\nself.account.left -= price',
        'self.left = await self.price()',
        'self.take(await self.price(), self.left)',
        'self.left = await self.price() + self.left',
        'self.take(self.left, 1)\nawait self.price()',
    ],
)
def test_what_is_read_behind_the_await_is_new(statements: str) -> None:
    assert of_budget(statements) == []


FLEET = """
import threading
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String

class Registry:
    def __init__(self):
        self._peers, self._lock = {}, threading.RLock()

    @property
    def peers(self):
        return self._peers

    @property
    def locked(self):
        with self._lock:
            return self._peers

    def all(self):
        'Who is known.'
        with self._lock:
            return self._peers

    def copied(self):
        with self._lock:
            return dict(self._peers)

    def touch(self, name):
        with self._lock:
            self._peers[name] = True

class Watcher(Node):
    def __init__(self):
        super().__init__('watcher')
        self.registry = Registry()
        group = MutuallyExclusiveCallbackGroup
        self.create_subscription(String, 'hello', self.on_hello, 5, callback_group=group())
        self.create_timer(0.1, self.tick, callback_group=group())

    def on_hello(self, msg):
        self.registry.touch(msg.data)

    def tick(self):
        STATEMENTS

rclpy.init()
executor = MultiThreadedExecutor(num_threads=2)
executor.add_node(Watcher())
executor.spin()
"""


def of_fleet(statements: str) -> list[str]:
    text = FLEET.replace('STATEMENTS', textwrap.indent(statements, ' ' * 8).strip())
    found = findings_of(scan_text(text).units, [], [None])
    return [each.message for each in found if each.code.startswith('CC3')]


@pytest.mark.parametrize(
    'statements',
    [
        'for name in self.registry.peers:\n    print(name)',
        'for name, known in self.registry.peers.items():\n    print(name)',
        'print([name for name in self.registry.locked])',
        'for name in self.registry.all():\n    print(name)',
        'for number, name in enumerate(self.registry.all().values()):\n    print(name)',
    ],
)
def test_a_loop_over_what_a_property_or_getter_gives_is_over_what_others_change(
    statements: str,
) -> None:
    (message,) = of_fleet(statements.replace('\\\n', '\n'))
    assert 'iterates over Registry._peers' in message


@pytest.mark.parametrize(
    'statements',
    [
        'for name in list(self.registry.peers):\n    print(name)',
        'for name in self.registry.copied():\n    print(name)',
        'with self.registry._lock:\n    for name in self.registry.peers:\n        print(name)',
    ],
)
def test_a_loop_over_a_copy_or_under_the_lock_is_not(statements: str) -> None:
    assert of_fleet(statements.replace('\\\n', '\n')) == []


def test_a_change_of_what_a_property_gives_is_one_of_the_attribute() -> None:
    text = FLEET.replace('STATEMENTS', "self.registry.peers['me'] = True")
    (unit,) = scan_text(text).units
    (tick,) = (each for each in unit.callbacks if each.function_name == 'tick')
    assert [(w.name, w.in_place, w.locks) for w in tick.writes] == [('Registry._peers', True, ())]


BOX = """
import threading
import rclpy
from rclpy.node import Node
from std_msgs.msg import Bool

class Box:
    def __init__(self):
        self.gate = threading.Event()

    def METHOD:
        self.gate.wait()
        return self

class BoxNode(Node):
    def __init__(self):
        super().__init__('box_node')
        self.box = Box()
        self.create_subscription(Bool, 'go', self.on_go, 10)
        self.create_subscription(Bool, 'set', self.on_set, 10)

    def on_go(self, msg):
        STATEMENT

    def on_set(self, msg):
        self.box.gate.set()

rclpy.init()
rclpy.spin(BoxNode())
"""


@pytest.mark.parametrize(
    ('method', 'statement'),
    [
        ('__lshift__(self, item)', 'self.box << msg.data'),
        ('__add__(self, item)', 'print(self.box + 1)'),
        ('__radd__(self, item)', 'print(1 + self.box)'),
        ('__iadd__(self, item)', 'self.box += msg.data'),
        ('__or__(self, item)', 'self.box |= msg.data'),
        ('__setitem__(self, key, item)', 'self.box[1] = msg.data'),
        ('__delitem__(self, key)', 'del self.box[msg.data]'),
        ('__contains__(self, key)', 'print(msg.data in self.box)'),
        ('__contains__(self, key)', 'if msg.data not in self.box:\n            print(1)'),
        ('__eq__(self, other)', 'print(self.box == msg.data)'),
        ('__lt__(self, other)', 'print(self.box < msg.data)'),
        ('__len__(self)', 'print(len(self.box))'),
    ],
)
def test_a_wait_behind_an_operator_is_one_of_the_callback(method: str, statement: str) -> None:
    text = BOX.replace('METHOD', method).replace('STATEMENT', statement)
    (unit,) = scan_text(text).units
    (callback,) = (each for each in unit.callbacks if each.function_name == 'on_go')
    assert [block.call for block in callback.blocking] == ['Event.wait']
