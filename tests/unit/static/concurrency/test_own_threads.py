"""A thread that starts threads of its own kind: what starts itself anew is one activity."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

HEAD = """
import threading
import rclpy
from rclpy.node import Node
"""

ITSELF = """
class Again(Node):
    def __init__(self):
        super().__init__('again')
        threading.Thread(target=self.one).start()

    def one(self):
        self.node = Node('other')
        threading.Thread(target=self.one).start()

rclpy.init()
rclpy.spin(Again())
"""

BY_TURNS = """
class Again(Node):
    def __init__(self):
        super().__init__('again')
        threading.Thread(target=self.one).start()

    def one(self):
        threading.Thread(target=self.other).start()

    def other(self):
        threading.Thread(target=self.one).start()

rclpy.init()
rclpy.spin(Again())
"""


@pytest.mark.parametrize(
    ('text', 'functions'),
    # A start by another line is another one.
    [(ITSELF, ['one', 'one']), (BY_TURNS, ['one', 'other', 'one'])],
)
def test_a_thread_that_starts_itself_anew_is_one(text: str, functions: list[str]) -> None:
    found = scan_text(HEAD + text)
    assert not any('too long' in each.message for each in found.diagnostics)
    told = [one.function.rpartition('.')[2] for unit in found.units for one in unit.activities]
    assert told == functions
