"""CC301: a loop over a parameter or variable that stands for an attribute that is replaced too."""

from __future__ import annotations

from textwrap import indent

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

PROGRAM = """\
import threading
import time
import rclpy
from rclpy.node import Node
from std_msgs.msg import String

def show(table):
    for name in table:
        print(name)

class Log(Node):
    def __init__(self):
        super().__init__('log')
        self.seen = {{}}
        self.lock = threading.Lock()
        self.create_subscription(String, 'x', self.on_x, 10)
        threading.Thread(target=self.loop, daemon=True).start()

    def on_x(self, msg):
        with self.lock:
            self.seen[msg.data] = 1

    def loop(self):
        while True:
            time.sleep(1.0)
{loop}

rclpy.init()
rclpy.spin(Log())
"""
RESET = 'with self.lock:\n    self.seen = {}'
BAD = {
    'parameter': f'show(self.seen)\n{RESET}',
    'variable': f'seen = self.seen\nfor name in seen.items():\n    print(name)\n{RESET}',
    'variable, replaced behind': f'seen = self.seen\nfor name in seen:\n    print(name)\n{RESET}',
}
RIGHT = {
    'swapped': 'with self.lock:\n    seen, self.seen = self.seen, {}\nshow(seen)',
    'swapped in two': 'with self.lock:\n    seen = self.seen\n    self.seen = {}\nshow(seen)',
    'copied': f'with self.lock:\n    seen = dict(self.seen)\nshow(seen)\n{RESET}',
    'locked': 'with self.lock:\n    show(self.seen)\n    self.seen = {}',
}


def told(loop: str) -> list[str]:
    units = scan_text(PROGRAM.format(loop=indent(loop, ' ' * 12))).units
    found = findings_of(units, [], [None] * len(units))
    return [each.code for each in found if each.code.startswith('CC3')]


@pytest.mark.parametrize('loop', BAD.values(), ids=BAD)
def test_the_collection_that_the_attribute_still_holds_may_change(loop: str) -> None:
    assert told(loop) == ['CC301']


@pytest.mark.parametrize('loop', RIGHT.values(), ids=RIGHT)
def test_what_has_been_taken_away_is_nobody_elses(loop: str) -> None:
    assert told(loop) == []
