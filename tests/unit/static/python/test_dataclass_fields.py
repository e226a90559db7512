"""Fields of data classes hold what their factories make, for each object anew."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """
import threading
from dataclasses import KW_ONLY, dataclass, field
import rclpy
from rclpy.node import Node
from std_msgs.msg import Empty

EARLIER = threading.Event()

@dataclass
class Base:
    number: int

{fields}

class Press(Node):
    def __init__(self):
        super().__init__('press')
        self.job = Job({given})
        self.create_subscription(Empty, 'done', self.on_done, 10)
        self.create_timer(1.0, self.tick)

    def on_done(self, msg):
        self.job.done.set()

    def tick(self):
        self.job.done.wait()

rclpy.init()
rclpy.spin(Press())
"""
FACTORY = 'field(default_factory=threading.Event)'
DATACLASS = f"""
@dataclass
class Job(Base):
    label: str = ''
    done: threading.Event = {FACTORY}
"""
INIT = DATACLASS.replace('label: str', 'label: str = field(init=False)\n    other: str')
BY_NAME = DATACLASS.replace('label: str', '_: KW_ONLY\n    label: str')
ATTRS = """
import attr

@attr.s
class Job:
    number = attr.ib(default=0)
    label = attr.ib(default='')
    done = attr.ib(factory=threading.Event)
"""


@pytest.mark.parametrize(
    ('fields', 'given', 'waited'),
    [
        (DATACLASS, '1', 'done'),
        (DATACLASS, "1, 'a'", 'done'),
        (DATACLASS, "1, 'a', EARLIER", 'EARLIER'),
        (INIT, "1, 'a', EARLIER", 'EARLIER'),
        (BY_NAME, "1, label='a', done=EARLIER", 'EARLIER'),
        (ATTRS, '1', 'done'),
        (ATTRS, "1, 'a', EARLIER", 'EARLIER'),
    ],
)
def test_a_field_holds_what_its_factory_makes(fields: str, given: str, waited: str) -> None:
    (unit,) = scan_text(PROGRAM.format(fields=fields, given=given)).units
    tick = next(each for each in unit.callbacks if each.name == 'tick')
    assert [(block.call, block.resource) for block in tick.blocking] == [('Event.wait', waited)]
    assert [waker.by for block in tick.blocking for waker in block.wakers] == ['on_done']
