"""A flag that is asked for by a method which gives it keeps others out as the attribute does."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.spec.effects import FLAG

PROGRAM = """
import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger

class Asker:
    def __init__(self, node):
        self.asking = False
        self.client = node.create_client(Trigger, 'place')

    def is_asking(self):
        '''Whether an answer is to come.'''
        {gives}

    def ask(self):
        self.asking = True
        self.client.call_async(Trigger.Request()).add_done_callback(self.on_answer)

    def on_answer(self, future):
        self.asking = False

class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.asker = Asker(self)
        self.create_timer(1.0, self.tick)

    def tick(self):
        if {test}:
            return
        self.asker.ask()

rclpy.init()
rclpy.spin(Arm())
"""
GIVES = 'return self.asking'


@pytest.mark.parametrize(
    ('test', 'gives', 'is_flag'),
    [
        ('self.asker.asking', GIVES, True),
        ('self.asker.is_asking()', GIVES, True),
        ('not self.asker or self.asker.is_asking()', GIVES, True),
        ('not self.asker.is_asking()', GIVES, False),
        ('self.asker.is_asking()', 'return self.asking and self.client', False),
        ('self.asker.is_asking()', 'self.asking = False; return self.asking', False),
    ],
)
def test_it_is_held_until_the_answer_has_come(test: str, gives: str, is_flag: bool) -> None:
    (unit,) = scan_text(PROGRAM.format(test=test, gives=gives)).units
    writes = [
        access
        for callback in unit.callbacks
        for access in callback.writes
        if access.name == 'Asker.asking' and access.source and access.source.line in (16, 20)
    ]
    assert len(writes) == 2
    assert all(f'Asker.asking{FLAG}' in write.locks for write in writes) is is_flag
