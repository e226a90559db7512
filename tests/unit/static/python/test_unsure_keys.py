"""A dictionary filled under keys that nobody can follow stays small, and loses no value."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.extract.static.python.language.assignments import MOST_UNSURE, drawn_together
from ros2cc_extract.extract.static.python.values.containers import Mapping
from ros2cc_extract.extract.static.python.values.values import Const, Mystery, Value, options_of
from ros2cc_extract.source_locations import Unknown

ONE, OTHER = Const('one'), Const('other')


def unsure(number: int) -> Mystery:
    return Mystery(Unknown(f'key {number}'))


@pytest.mark.parametrize('number', [0, 1, MOST_UNSURE - 1, MOST_UNSURE, 3 * MOST_UNSURE])
def test_values_of_too_many_unsure_keys_are_held_together(number: int) -> None:
    entries: dict[Value, Value] = {Const('sure'): ONE}
    entries |= {unsure(n): OTHER if n == 0 else ONE for n in range(number)}
    drawn = drawn_together(Mapping(entries), unsure(number))
    assert len(drawn) == 1 + min(number, MOST_UNSURE)
    assert drawn[Const('sure')] == ONE
    held = {option for value in drawn.values() for option in options_of(value)}
    assert held == ({ONE, OTHER} if number else {ONE})


def test_nodes_under_many_unsure_keys_are_all_served() -> None:
    stores = ''.join(f'nodes[input()] = {name}\n' for name in 'ab' * MOST_UNSURE)
    (unit,) = scan_text(
        'import rclpy\nfrom rclpy.executors import MultiThreadedExecutor\n'
        "rclpy.init()\na, b = rclpy.create_node('a'), rclpy.create_node('b')\nnodes = {}\n"
        f'{stores}executor = MultiThreadedExecutor(2)\n'
        'for node in nodes.values():\n    executor.add_node(node)\n'
        'executor.spin()\n'
    ).units
    assert sorted(unit.nodes) == ['a', 'b']
