"""Locks that are taken in the order of ``sorted``, or of ``id``, come in one order everywhere."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """
import threading
import rclpy
from rclpy.node import Node

class Rack:
    def __init__(self, name, lock):
        self.name, self.lock = name, lock

def move(one, other):
    {order}
    with first.lock, second.lock:
        pass

class Store(Node):
    def __init__(self):
        super().__init__('store')
        self.lock_a, self.lock_b = threading.Lock(), threading.Lock()
        self.a, self.b = Rack({a}, self.lock_a), Rack({b}, self.lock_b)
        self.create_timer(0.1, self.there)
        self.create_timer(0.1, self.back)

    def there(self):
        move(self.a, self.b)

    def back(self):
        move(self.b, self.a)

rclpy.init()
rclpy.spin(Store())
"""
BY_NAME = 'first, second = sorted((one, other), key=lambda each: each.name)'
BY_ID = 'first, second = sorted([one, other], key=id)'
ID = 'first, second = (one, other) if id(one) < id(other) else (other, one)'
FIRST_A, FIRST_B = ['lock_a', 'lock_b'], ['lock_b', 'lock_a']


@pytest.mark.parametrize(
    ('order', 'names', 'there', 'back'),
    [
        ('first, second = one, other', ('a', 'b'), FIRST_A, FIRST_B),
        (BY_NAME, ('a', 'b'), FIRST_A, FIRST_A),
        (BY_NAME, ('b', 'a'), FIRST_B, FIRST_B),
        (BY_NAME[:-1] + ', reverse=True)', ('a', 'b'), FIRST_B, FIRST_B),
        (BY_NAME.replace('each.name', '(1, each.name)'), ('b', 'a'), FIRST_B, FIRST_B),
        (BY_ID, ('a', 'b'), FIRST_A, FIRST_A),
        (ID, ('a', 'b'), FIRST_A, FIRST_A),
        (BY_NAME, (None, None), FIRST_A, FIRST_A),
    ],
)
def test_one_order_of_locks(
    order: str, names: tuple[str | None, str | None], there: list[str], back: list[str]
) -> None:
    a, b = (repr(name) if name is not None else 'input()' for name in names)
    (unit,) = scan_text(PROGRAM.format(order=order, a=a, b=b)).units
    taken = {each.name: [act.name for act in each.locks] for each in unit.callbacks}
    assert taken == {'there': there, 'back': back}
