"""A branch that skips a signal skips the waits as well that stand behind it on the same branch."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.generator.waits import waits_of
from ros2cc_extract.spec.model import Spec

PROGRAM = """
import threading
import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger

class Patrol(Node):
    def __init__(self):
        super().__init__('patrol')
        self.stop, self.ready = threading.Event(), threading.Event()
        self.thread = None
        self.create_service(Trigger, 'start', self.on_start)
        self.create_service(Trigger, 'stop', self.on_stop)

    def on_start(self, request, response):
        self.thread = threading.Thread(target=self.patrol, daemon=True)
        self.thread.start()
        return response

    def end(self):
        self.stop.set()
        self.thread.join()

    def on_stop(self, request, response):
        BODY
        return response

    def patrol(self):
        while not self.stop.is_set():
            self.stop.wait(0.1)

rclpy.init()
rclpy.spin(Patrol())
"""
LEAVES = 'if self.thread is None:\n            return response\n        '
INSIDE = 'if self.thread is not None:\n            self.stop.set()\n            '


def unit_of(body: str) -> Spec:
    (unit,) = scan_text(PROGRAM.replace('BODY', body)).units
    return unit


@pytest.mark.parametrize(
    ('body', 'untils'),
    [
        (f'{LEAVES}self.stop.set()\n        self.thread.join()', {1}),
        (f'{LEAVES}self.end()', {1}),
        (f'{INSIDE}self.thread.join()', {1}),
        (f'{INSIDE}if request:\n                self.thread.join()', {1}),
        (f'{LEAVES}self.stop.set()\n        self.thread.join()\n        self.ready.wait()', {2}),
        # The wait comes on another way, too, or before, or the signal always comes.
        (f'{INSIDE}pass\n        self.thread.join()', {None}),
        (f'{LEAVES}self.thread.join()\n        self.stop.set()', {None}),
        ('self.stop.set()\n        self.thread.join()', {None}),
        (
            f'{INSIDE}pass\n        if request:\n            self.stop.set()\n'
            '            self.thread.join()',
            {None, 1},
        ),
        (f'if request:\n            self.end()\n        {LEAVES}self.end()', {None}),
    ],
)
def test_how_many_waits_come_only_behind_the_signal(body: str, untils: set[int | None]) -> None:
    unit = unit_of(body)
    (patrol,) = (each for each in unit.activities if each.name.startswith('patrol'))
    wakers = [waker for block in patrol.blocking for waker in block.wakers]
    assert {waker.until for waker in wakers if waker.by == 'on_stop'} == untils


def test_the_model_skips_both() -> None:
    unit = unit_of(f'{LEAVES}self.stop.set()\n        self.thread.join()')
    (stop,) = (each for each in unit.callbacks if each.name == 'on_stop')
    steps = waits_of(stop, unit)
    assert [(step.is_signal, step.may_skip, step.past) for step in steps] == [
        (True, True, 2),
        (False, True, None),
    ]
