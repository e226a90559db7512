"""CC109, CC120: a loop that lowers the flag which ends it waits for who raises the flag."""

from __future__ import annotations

import pytest

from tests.help.cases import said

PROGRAM = """\
import time
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Winch(Node):
    def __init__(self):
        super().__init__('winch')
        self.down = False
        self.cancel = False
        self.runs = False
        self.steps = 0
        work, halt = MutuallyExclusiveCallbackGroup(), MutuallyExclusiveCallbackGroup()
        self.create_service(Trigger, 'lower', self.lower, callback_group=work)
        self.create_service(Trigger, 'stop', self.stop, callback_group=halt)

    def lower(self, request, response):
        self.runs = True
        LOOP
        self.runs = False
        return response

    def stop(self, request, response):
        STOP
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(4)
    executor.add_node(Winch())
    executor.spin()


main()
"""
LOWERS = [
    """while not self.down:
            if self.cancel:
                self.cancel = False
                break
            time.sleep(0.1)""",
    """while not self.down:
            time.sleep(0.1)
            if self.cancel:
                self.cancel = False
                return response""",
    """while True:
            if self.cancel or self.down:
                self.cancel = False
                break
            time.sleep(0.1)""",
]
NEVER, PERHAPS, ALWAYS = (
    'pass',
    'if self.runs:\n            self.cancel = True',
    'self.cancel = True',
)
WORKS = """while not self.down:
            if self.cancel:
                self.cancel = False
                self.steps += 1
            if self.steps > 3:
                self.down = True
            time.sleep(0.1)"""


def codes(loop: str, stop: str) -> set[str]:
    found = said(PROGRAM.replace('LOOP', loop).replace('STOP', stop))
    return {each.code for each in found} & {'CC109', 'CC120'}


@pytest.mark.parametrize('loop', LOWERS)
@pytest.mark.parametrize(
    ('stop', 'expected'), [(NEVER, {'CC109'}), (PERHAPS, {'CC120'}), (ALWAYS, set())]
)
def test_it_waits_for_who_raises_it(loop: str, stop: str, expected: set[str]) -> None:
    assert codes(loop, stop) == expected


def test_a_method_may_lower_it() -> None:
    text = PROGRAM.replace('LOOP', LOWERS[1].replace('self.cancel = False', 'self.clear()'))
    clear = 'def clear(self):\n        self.cancel = False\n\n    def stop('
    found = said(text.replace('def stop(', clear).replace('STOP', PERHAPS))
    assert [each.code for each in found if each.code in ('CC109', 'CC120')] == ['CC120']


@pytest.mark.parametrize('stop', [NEVER, PERHAPS, ALWAYS])
def test_what_goes_on_behind_it_may_end_itself(stop: str) -> None:
    assert codes(WORKS, stop) == set()
