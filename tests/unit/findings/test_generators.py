"""The body of a generator runs in the code that takes items from it, wherever it was made."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.spec.effects import AWAIT, TURN
from ros2cc_extract.spec.model import Callback, Spec

TOUR = """
import itertools
import threading
import rclpy
from rclpy.node import Node
from std_msgs.msg import Empty

class Runner:
    def __init__(self, steps):
        self.steps = steps

    def step(self):
        next(self.steps, None)

class Tour(Node):
    def __init__(self):
        super().__init__('tour')
        self.gone = threading.Event()
        MADE
        self.create_subscription(Empty, 'tick', self.on_tick, 10)
        self.create_subscription(Empty, 'gone', self.on_gone, 10)

    def script(self):
        yield 'begin'
        yield from self.legs()

    def legs(self):
        self.gone.wait()
        self.legs_done = True
        yield 'end'

    def on_tick(self, msg):
        TAKEN

    def on_gone(self, msg):
        self.gone.set()

rclpy.init()
rclpy.spin(Tour())
"""


def unit_of(made: str, taken: str) -> Spec:
    (unit,) = scan_text(TOUR.replace('MADE', made).replace('TAKEN', taken)).units
    return unit


def on_tick(unit: Spec) -> Callback:
    return next(each for each in unit.callbacks if each.function_name == 'on_tick')


@pytest.mark.parametrize(
    ('made', 'taken'),
    [
        ('self.steps = self.script()', 'next(self.steps)'),
        ('self.steps = iter(self.script())', 'next(self.steps, None)'),
        ('self.steps = self.script()', 'self.steps.send(None)'),
        ('self.steps = self.script()', 'for step in self.steps:\n            break'),
        ('self.steps = [self.script()]', 'next(self.steps[0])'),
        ('self.steps = []\n        self.steps.append(self.script())', 'next(self.steps[0])'),
        ("self.steps = {'tour': self.script()}", "next(self.steps['tour'])"),
        ('self.runner = Runner(self.script())', 'self.runner.step()'),
        ('pass', 'list(self.script())'),
        ('pass', 'any(step for step in self.script())'),
        ('pass', 'a, *others = self.script()'),
    ],
)
def test_the_code_that_takes_items_waits(made: str, taken: str) -> None:
    unit = unit_of(made, taken)
    tick = on_tick(unit)
    assert [block.call for block in tick.blocking] == ['Event.wait']
    assert 'Tour.legs_done' in [write.name for write in tick.writes]
    assert not unit.set_up


def test_a_generator_of_which_nothing_is_taken_does_nothing_there() -> None:
    unit = unit_of('pass', 'self.script()')
    assert on_tick(unit).blocking == ()


def test_the_set_up_waits_where_it_takes_the_items_itself() -> None:
    unit = unit_of('self.steps = self.script(); list(self.steps)', 'print(self.gone)')
    assert [block.call for block in unit.set_up] == ['Event.wait']
    assert on_tick(unit).blocking == ()


FEED = """
import time
import rclpy
from rclpy.node import Node
from std_msgs.msg import Empty

class Feed(Node):
    def __init__(self):
        super().__init__('feed')
        self.items = []
        self.create_subscription(Empty, 'tick', self.on_tick, 10)
        self.create_subscription(Empty, 'gone', self.on_gone, 10)

    def readings(self):
        LOOP
            yield 1

    def on_tick(self, msg):
        for item in self.readings():
            ROUND

    def on_gone(self, msg):
        self.items.append(0)

rclpy.init()
rclpy.spin(Feed())
"""


@pytest.mark.parametrize(
    ('loop', 'round_', 'waits'),
    [
        ('while True:', 'time.sleep(1)', [('endless loop', 'the end of the program', None)]),
        ('while True:', 'break', []),
        (
            'while len(self.items) < 5:',
            'self.items.append(item)',
            [('polling loop', None, 'what takes the items may change what the loop reads')],
        ),
    ],
)
def test_a_loop_over_a_generator_ends_where_both_do(
    loop: str, round_: str, waits: list[tuple[str, str | None, str | None]]
) -> None:
    (unit,) = scan_text(FEED.replace('LOOP', loop).replace('ROUND', round_)).units
    blocks = [each for each in on_tick(unit).blocking if each.call != 'time.sleep']
    found = [(b.call, b.resource, b.escapes.reason if b.escapes else None) for b in blocks]
    assert found == waits


PRIMED = TOUR.replace("yield 'begin'\n        yield from self.legs()", 'BODY')


def found_of(body: str, made: str, taken: str) -> tuple[list[str], list[str]]:
    """What the set-up waits for, and what ``on_tick`` does."""
    text = PRIMED.replace('BODY', body).replace('MADE', made).replace('TAKEN', taken)
    (unit,) = scan_text(text).units
    blocks = on_tick(unit).blocking
    return [each.call for each in unit.set_up], [each.call for each in blocks]


@pytest.mark.parametrize(
    ('body', 'in_tick'),
    [
        ("yield 'begin'\n        self.gone.wait()", ['Event.wait']),
        ('while True:\n            got = yield\n            self.gone.wait()', ['Event.wait']),
        ('while not self.gone.is_set():\n            yield 1', []),
        ('while not self.is_done:\n            yield 1', []),
        ('while rclpy.ok():\n            yield from (1, 2)', []),
        ('while True:\n            yield from (1, 2)', []),
        ('for leg in self.others():\n            yield leg', []),
    ],
)
def test_a_generator_that_is_primed_stops_at_its_first_yield(
    body: str, in_tick: list[str]
) -> None:
    body += '\n\n    def others(self):\n        while not self.is_done:\n            yield 1'
    primed = 'self.is_done = False; self.steps = self.script(); next(self.steps)'
    assert found_of(body, primed, 'self.steps.send(1)') == ([], in_tick)


def test_what_stands_behind_the_first_yield_is_done_by_the_second_item() -> None:
    made = 'self.steps = self.script(); next(self.steps); next(self.steps)'
    assert found_of("yield 'begin'\n        self.gone.wait()", made, 'pass')[0] == ['Event.wait']
    made = 'self.steps = self.script()\n        while True:\n            next(self.steps)'
    assert found_of("yield 'begin'\n        self.gone.wait()", made, 'pass')[0] == ['Event.wait']


@pytest.mark.parametrize(
    'made',
    [
        'self.steps = (self.go() for _ in range(3))',
        'self.steps = iter(self.go() for _ in range(3))',
        'self.steps = map(self.go, range(3))',
        'self.steps = filter(self.go, range(3))',
        'self.steps = (i for i in range(3) if self.go())',
    ],
)
def test_generators_without_a_name_run_where_items_are_taken(made: str) -> None:
    body = 'yield 1\n\n    def go(self, *args):\n        self.gone.wait()\n'
    assert found_of(body, made, 'next(self.steps)') == ([], ['Event.wait'])
    assert found_of(body, made, 'pass')[1] == []
    assert found_of(body, made + '\n        next(self.steps)', 'pass') == (['Event.wait'], [])


AWAITED = """
import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from std_msgs.msg import Empty

class Until:
    def __init__(self, node):
        self.node = node

    def __await__(self):
        BODY

class Asker(Node):
    def __init__(self):
        super().__init__('asker')
        self.is_there = False
        self.create_subscription(Empty, 'tick', self.on_tick, 10)
        self.create_subscription(Empty, 'there', self.on_there, 10, callback_group=GROUP)

    async def on_tick(self, msg):
        ROUND

    def on_there(self, msg):
        self.is_there = True

rclpy.init()
rclpy.spin(Asker())
"""


@pytest.mark.parametrize('group', ['None', 'ReentrantCallbackGroup()'])
@pytest.mark.parametrize(
    ('body', 'round_'),
    [
        ('while not self.node.is_there:\n            yield', 'await Until(self)'),
        ('yield', 'while not self.is_there:\n            await Until(self)'),
        ('yield from (None, None)', 'while not self.is_there:\n            await Until(self)'),
    ],
)
def test_what_a_coroutine_yields_gives_its_thread_back(body: str, round_: str, group: str) -> None:
    text = AWAITED.replace('BODY', body).replace('ROUND', round_).replace('GROUP', group)
    (unit,) = scan_text(text).units
    tick = next(each for each in unit.callbacks if each.function_name == 'on_tick')
    assert {block.call for block in tick.blocking} <= {AWAIT, TURN}
    assert [b.resource for b in tick.blocking if b.call == AWAIT] == ['Asker.is_there']
