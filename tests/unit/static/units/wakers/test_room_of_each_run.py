"""A bounded queue that each run makes anew: what is put in once finds room."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """
import queue
import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger

class Asker(Node):
    def __init__(self):
        super().__init__('asker')
        self.client = self.create_client(Trigger, 'ask')
        self.box = queue.Queue(1)
        self.create_timer(1.0, self.tick)

    def tick(self):
        box = {box}
        {ask}
        box.get()

def main():
    rclpy.init()
    rclpy.spin(Asker())
"""
ASK = 'self.client.call_async(Trigger.Request()).add_done_callback(lambda f: box.put(f.result()))'


@pytest.mark.parametrize(
    ('box', 'ask', 'may_wait'),
    [
        ('queue.Queue(1)', ASK, False),
        ('queue.Queue(2)', f'{ASK}; {ASK}', False),
        ('queue.Queue(1)', f'{ASK}; {ASK}', True),
        ('self.box', ASK, True),
    ],
)
def test_who_puts_once_for_each_run_finds_room(box: str, ask: str, may_wait: bool) -> None:
    (unit,) = scan_text(PROGRAM.format(box=box, ask=ask)).units
    puts = [b for each in unit.callbacks for b in each.blocking if b.call == 'Queue.put']
    assert bool(puts) is may_wait
