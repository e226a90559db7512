"""A method that nobody in a whole program names ends no wait."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """\
import threading
import rclpy
from rclpy.node import Node

class Gate(BASE):
    def __init__(self):
        self.open = threading.Event()

    def pass_through(self):
        self.open.wait()

    def unlock(self):
        self.open.set()

class Keeper(Node):
    def __init__(self):
        super().__init__('keeper')
        self.gate = Gate()
        self.create_timer(1.0, self.gate.pass_through)
REST

rclpy.init()
rclpy.spin(Keeper())
"""


def is_open(rest: str = '', base: str = 'object', program: str = PROGRAM) -> bool:
    text = program.replace('REST', rest).replace('(BASE)', base and f'({base})')
    (unit,) = scan_text(text).units
    (blocking,) = unit.callbacks[0].blocking
    return blocking.escapes is not None


def test_a_method_that_no_text_of_the_program_names_is_not_called() -> None:
    assert not is_open(base='')


@pytest.mark.parametrize(
    ('rest', 'base'),
    [
        ("        self.todo = {'unlock': 1}", ''),
        ('        self.todo = what_is_to_be_done().unlock', ''),
        ('        getattr(self.gate, input())()', ''),
        ('', 'threading.Thread'),
    ],
    ids=['spelled', 'named', 'any name', 'a base class may call it'],
)
def test_else_somebody_may_call_it(rest: str, base: str) -> None:
    assert is_open(rest, base)
