"""A line that asks for an attribute which nothing assigns raises; nothing behind it happens."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

DIG = """
import threading
import rclpy
from example_interfaces.action import Fibonacci
from rclpy.action import ActionServer
from rclpy.node import Node
from std_srvs.srv import Trigger
{imports}


{decorator}
class Dig({bases}):
    def __init__(self):
        super().__init__('dig')
        self.server = ActionServer(self, Fibonacci, 'dig', self.execute)
        self.screw = self.create_client(Trigger, 'screw')
        self.done = threading.Event()
        {begin}

    {more}

    def execute(self, goal_handle):
        {body}
        return Fibonacci.Result()


def main():
    rclpy.init()
    {main}


if __name__ == '__main__':
    main()
"""
WAITS = '; self.done.wait()'
ASKED = f'self.lift.stop(){WAITS}'


def _waits(body: str, **parts: str) -> tuple[list[str], list[str]]:
    given = {'imports': '', 'decorator': '', 'bases': 'Node', 'begin': 'pass', 'more': 'pass'}
    text = DIG.format(**{**given, 'main': 'rclpy.spin(Dig())', 'body': body, **parts})
    units = scan_text(text).units
    reasons = [fact.reason for unit in units for fact in unit.unresolved]
    waits = [wait for unit in units for each in unit.callbacks for wait in each.blocking]
    return [wait.call for wait in waits], reasons


@pytest.mark.parametrize(
    'body',
    [
        ASKED,
        f'print(self.lift.state){WAITS}',
        'if self.lift:\n            pass\n        self.done.wait()',
        f'self.level = self.lift{WAITS}',
        f'self.lift and self.done{WAITS}',
        f'self.lift.stop() if goal_handle else 1; self.lift.stop(){WAITS}',
        'return self.lift.wait(self.done.wait())',
        f'(lambda: self.stop())(); self.lift.stop(){WAITS}',
    ],
)
def test_what_comes_behind_it_does_not_happen(body: str) -> None:
    waits, reasons = _waits(body)

    assert not waits
    assert "'lift' is assigned nowhere, so that this raises AttributeError" in reasons


@pytest.mark.parametrize(
    ('body', 'parts'),
    [
        (ASKED, {'begin': 'self.lift = None'}),
        (ASKED, {'begin': "setattr(self, 'lift', self.screw)"}),
        (ASKED, {'begin': "for name in ('lift',): setattr(self, name, self.screw)"}),
        (ASKED, {'begin': 'self.__dict__.update(lift=self.screw)'}),
        (ASKED, {'begin': "vars(self)['lift'] = self.screw"}),
        (ASKED, {'more': 'lift = Trigger'}),
        (ASKED, {'more': 'lift: Trigger'}),
        (ASKED, {'more': 'def __getattr__(self, name): return self.screw'}),
        (ASKED, {'bases': 'parts.Lifts, Node', 'imports': 'import parts'}),
        (ASKED, {'decorator': '@parts.with_lift', 'imports': 'import parts'}),
        (ASKED, {'bases': 'Node, metaclass=parts.Meta', 'imports': 'import parts'}),
        (ASKED, {'begin': 'parts.fill(self)', 'imports': 'import parts'}),
        (ASKED, {'main': 'node = Dig(); node.lift = 1; rclpy.spin(node)'}),
        (ASKED, {'main': 'Dig.lift = Trigger(); rclpy.spin(Dig())'}),
        (ASKED.replace('lift', 'get_lift'), {}),
        (ASKED.replace('lift', 'executor'), {}),
        (f'goal_handle and self.lift.stop(){WAITS}', {}),
        (f'self.lift.stop() if goal_handle.request.order else 1{WAITS}', {}),
        (f'print([self.lift for _ in goal_handle.request.order]){WAITS}', {}),
        (f'print(lambda: self.lift){WAITS}', {}),
        (f'goal_handle.lift.stop(){WAITS}', {}),
        (
            'try:\n            self.lift.stop()\n        except AttributeError:\n'
            '            self.done.wait()',
            {},
        ),
        (
            'if goal_handle.request.order:\n            self.lift.stop()\n'
            '        self.done.wait()',
            {},
        ),
        (
            'if goal_handle.request.order:\n            pass\n'
            '        elif self.lift:\n            pass\n        self.done.wait()',
            {},
        ),
    ],
)
def test_what_may_be_there_or_may_not_be_asked_for_stops_nothing(
    body: str, parts: dict[str, str]
) -> None:
    waits, _ = _waits(body, **parts)

    assert waits == ['Event.wait']
