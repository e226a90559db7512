"""Branches inside of a branch exclude each other, too."""

from __future__ import annotations

from itertools import combinations

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.spec.model import exclude_each_other

HEAD = """\
import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Scale(Node):
    def __init__(self):
        super().__init__('scale')
        for name in ('a', 'b', 'c'):
            self.declare_parameter(name, True)
        a, b, c = (self.get_parameter(name).value for name in ('a', 'b', 'c'))
"""
TAIL = """
    def on_text(self, msg):
        print(msg.data)


rclpy.init()
rclpy.spin(Scale())
"""


def excluded(*lines: str) -> set[str]:
    """The topics that are never subscribed to together."""
    listens = "self.create_subscription(String, '{}', self.on_text, 10)"
    body = [
        line if line.endswith(':') else line.replace(line.strip(), listens.format(line.strip()))
        for line in lines
    ]
    text = HEAD + ''.join(f'        {line}\n' for line in body) + TAIL
    (unit,) = scan_text(text).units
    pairs = combinations(sorted(unit.callbacks, key=lambda each: str(each.key)), 2)
    return {f'{one.key} {other.key}' for one, other in pairs if exclude_each_other(one, other)}


def test_an_inner_statement_divides_all_of_a_branch() -> None:
    inner = ('if a:', '    if b:', '        x', '    else:', '        y', 'else:', '    z')
    assert excluded(*inner) == {'x y', 'x z', 'y z'}


def test_two_inner_statements() -> None:
    first = ('if a:', '    if b:', '        w', '    else:', '        x')
    second = ('else:', '    if c:', '        y', '    else:', '        z')
    assert excluded(*first, *second) == {'w x', 'w y', 'w z', 'x y', 'x z', 'y z'}


def test_an_inner_statement_beside_something_else_of_its_branch() -> None:
    inner = ('if a:', '    w', '    if b:', '        x', '    else:', '        y')
    assert excluded(*inner, 'else:', '    z') == {'w z', 'x z', 'y z'}


def test_one_statement() -> None:
    assert excluded('if a:', '    x', 'else:', '    y') == {'x y'}
    assert excluded('if a:', '    x', 'z') == set()
