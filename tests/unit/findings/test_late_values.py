"""*No data race* is open where callbacks may use an attribute before ``main`` has filled it."""

from __future__ import annotations

from textwrap import indent

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.promises import Promise, judge
from ros2cc_extract.generator.build import Profile
from ros2cc_extract.spec.close import close
from ros2cc_extract.spec.yaml.yaml_io import read_specs, write_specs
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.unit import verify_unit

PROGRAM = """\
import threading
import time
import rclpy
from rclpy.node import Node
from std_msgs.msg import String

class Engine:
    def say(self, text):
        print(text)

class Speech(Node):
    def __init__(self):
        super().__init__('speech')
        self.engine = {first}
        self.create_subscription(String, 'text', self.on_text, 10)

    def on_text(self, msg):
        {use}

def main():
    rclpy.init()
    node = Speech()
    spin = threading.Thread(target=rclpy.spin, args=(node,))
{rest}

main()
"""
USE, TEST = 'self.engine.say(msg.data)', 'if self.engine is not None: self.engine.say(msg.data)'
FILL = 'node.engine = Engine()\n'
START, JOIN = 'spin.start()\ntime.sleep(5)\n', 'spin.join()\n'
WORDS = (
    'Speech.on_text uses Speech.engine without a test, which is None until main comes to '
    'speech.py:{line}'
)


@pytest.mark.parametrize(
    ('first', 'use', 'rest', 'lines'),
    [
        ('None', USE, START + FILL + JOIN, [26]),
        ('None', USE, START + 'time.sleep(1)\n' + FILL + JOIN, [27]),
        ('None', USE, FILL + START + JOIN, []),
        ('None', TEST, START + FILL + JOIN, []),
        ('Engine()', USE, START + FILL + JOIN, []),
        ('None', USE, FILL + 'rclpy.spin(node)\n', []),
        ('None', 'print(self.engine)', START + FILL + JOIN, []),
    ],
)
def test_a_callback_that_uses_what_main_gives_late(
    first: str, use: str, rest: str, lines: list[int]
) -> None:
    text = PROGRAM.format(first=first, use=use, rest=indent(rest, ' ' * 4))
    [unit] = scan_text(text, 'speech.py').units
    assert read_specs(write_specs([unit]), 'speech.yaml') == (unit,)
    verification = verify_unit(close(unit), Options(profile=Profile.RCLPY))
    judged = {each.promise: each.reason for each in judge(unit, verification, [])}
    assert judged[Promise.RACES] == ''.join(WORDS.format(line=line) for line in lines)
