"""A process of its own has a memory of its own: what it sets there, nobody else sees."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """
import multiprocessing
import queue
import threading
import time
import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger

CONTEXT = multiprocessing.get_context('fork')

class Planner(Node):
    def __init__(self):
        super().__init__('planner')
        self.done = MADE
        self.create_service(Trigger, 'plan', self.on_plan)

    def crunch(self):
        ENDED

    def on_plan(self, request, response):
        process = START(target=self.crunch, daemon=True)
        process.start()
        WAIT
        return response

rclpy.init()
rclpy.spin(Planner())
"""
EVENT = ('self.done.set()', 'self.done.wait()')
FLAG = ('self.done = True', 'while not self.done:\n            time.sleep(0.01)')
ITEM = ("self.done['a'] = True", "while not self.done['a']:\n            time.sleep(0.01)")
QUEUE = ('self.done.put(1)', 'self.done.get()')
PROCESS = 'multiprocessing.Process'


def wakers(made: str, ends: tuple[str, str], start: str) -> list[str]:
    """What ends the one wait of the callback."""
    text = PROGRAM.replace('MADE', made).replace('START', start)
    (unit,) = scan_text(text.replace('ENDED', ends[0]).replace('WAIT', ends[1])).units
    (callback,) = (each for each in unit.callbacks if each.function_name == 'on_plan')
    (wait,) = (each for each in callback.blocking if each.call != 'time.sleep')
    assert wait.escapes is None
    return [waker.by for waker in wait.wakers]


@pytest.mark.parametrize('start', [PROCESS, 'CONTEXT.Process'])
@pytest.mark.parametrize(
    ('made', 'ends'),
    [
        ('threading.Event()', EVENT),
        ('queue.Queue()', QUEUE),
        ('False', FLAG),
        ("{'a': False}", ITEM),
    ],
)
def test_what_a_process_does_in_its_memory_ends_no_wait(
    made: str, ends: tuple[str, str], start: str
) -> None:
    assert wakers(made, ends, start) == []


@pytest.mark.parametrize(
    ('made', 'ends', 'start'),
    [
        ('multiprocessing.Event()', EVENT, PROCESS),
        ('CONTEXT.Event()', EVENT, 'CONTEXT.Process'),
        ('multiprocessing.Queue()', QUEUE, PROCESS),
        ('multiprocessing.Manager().dict(a=False)', ITEM, PROCESS),
        ('threading.Event()', EVENT, 'threading.Thread'),
        ('False', FLAG, 'threading.Thread'),
    ],
)
def test_what_processes_share_does(made: str, ends: tuple[str, str], start: str) -> None:
    assert wakers(made, ends, start) == ['crunch']
