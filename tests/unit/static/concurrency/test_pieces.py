"""Objects that somebody publishes whole while somebody else changes them piece by piece."""

from __future__ import annotations

import textwrap

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """
import copy, threading, time
import rclpy
from rclpy.node import Node
from sensor_msgs.msg import JointState

def fill(state, value):
    state.position[0] = value
    state.velocity[0] = value

class Driver(Node):
    def __init__(self):
        super().__init__('driver')
        self.lock = threading.Lock()
        self.state = JointState()
        self.state.position = [0.0] * 4
        self.pub = self.create_publisher(JointState, 'state', 10)
        self.create_timer(0.1, self.tick)
        threading.Thread(target=self.work).start()

    def work(self):
        while rclpy.ok():
            value = time.time()
            CHANGES
            time.sleep(0.1)

    def tick(self):
        SENDS

def main():
    rclpy.init()
    rclpy.spin(Driver())

main()
"""
SENT = 'self.pub.publish(self.state)'
TWO = 'self.state.position[0] = value; self.state.velocity[0] = value'


def pieces(changes: str, sends: str = SENT) -> tuple[list[tuple[bool, tuple[str, ...]]], ...]:
    """Of the timer and the thread: whether it is a change, and the locks, of each piece."""
    text = PROGRAM.replace('CHANGES', textwrap.indent(textwrap.dedent(changes), ' ' * 12).strip())
    (unit,) = scan_text(text.replace('SENDS', textwrap.indent(sends, ' ' * 8).strip())).units
    (thread,) = unit.activities
    found = [*unit.callbacks, thread]
    assert {piece.name for each in found for piece in each.pieces} <= {'Driver.state'}
    return tuple([(piece.update, piece.locks) for piece in each.pieces] for each in found)


@pytest.mark.parametrize(
    'changes',
    [
        TWO,
        'self.state.header.stamp = value; self.state.position = [value]',
        'for wheel in range(4):\n    self.state.position[wheel] = value',
        'self.state.name.clear(); self.state.position.append(value)',
        'self.state.position[0] += 1.0; self.state.position[1] += 1.0',
        'places = self.state.position\nplaces[0] = value; places[1] = value',
        'state = self.state\nstate.name = [value]; state.position = [value]',
        'self.state = JointState(); self.state.name = []; self.state.position = [value]',
        'fill(self.state, value)',
    ],
)
def test_a_message_that_is_changed_in_pieces_while_it_may_be_sent(changes: str) -> None:
    timer, thread = pieces(changes)
    assert timer == [(False, ())]
    assert thread
    assert set(thread) == {(True, ())}


@pytest.mark.parametrize(
    'changes',
    [
        'self.state.position[0] = value',
        'self.state.position = [value] * 4',
        'self.state.position.append(value)',
        'state = JointState(); state.name = []; state.position = [value]; self.state = state',
        'self.state.position[0] = value\nself.state.position[0] = value + 1',
        """
        if value > 1:
            self.state.position[0] = value
        else:
            self.state.velocity[0] = value""",
    ],
)
def test_what_is_changed_in_one_piece_or_made_anew_is_never_torn(changes: str) -> None:
    assert pieces(changes) == ([], [])


@pytest.mark.parametrize(
    'sends',
    [
        'state = JointState(); state.name = self.state.name; self.pub.publish(state)',
        'self.pub.publish(copy.deepcopy(self.state))',
        'self.get_logger().info(str(self.state))',
    ],
)
def test_what_sends_another_object_tears_nothing(sends: str) -> None:
    assert pieces(TWO, sends) == ([], [])


def test_an_object_that_is_taken_out_before_it_is_sent_is_not_the_shared_one() -> None:
    swap = 'state = self.state\nself.state = JointState()\nself.pub.publish(state)'
    assert pieces(TWO, swap) == ([], [])


def test_the_locks_are_told() -> None:
    locked = f'with self.lock:\n    {SENT}'
    timer, thread = pieces(f'with self.lock:\n    {TWO}', locked)
    assert timer == [(False, ('lock',))]
    assert set(thread) == {(True, ('lock',))}


def test_who_sends_what_it_has_changed_itself_is_not_told() -> None:
    assert pieces('pass', f'{TWO}; {SENT}') == ([], [])


@pytest.mark.parametrize(
    ('use', 'is_whole'),
    [
        ('print(self.grid.sum())', True),
        ('np.mean(self.grid)', True),
        ('self.grid[0]', False),
        ('grid = self.other; np.mean(grid)', False),
    ],
)
def test_an_array_that_is_filled_while_somebody_goes_over_it(use: str, is_whole: bool) -> None:
    text = PROGRAM.replace('self.state = JointState()', 'self.grid = np.zeros(4)')
    text = text.replace('self.state.position = [0.0] * 4', 'self.other = np.zeros(4)')
    text = text.replace('CHANGES', 'for k in range(4): self.grid[k] = value')
    text = text.replace('SENDS', use).replace('import copy', 'import numpy as np, copy')
    (unit,) = scan_text(text).units
    named = {piece.name for each in (*unit.callbacks, *unit.activities) for piece in each.pieces}
    assert named == ({'Driver.grid'} if is_whole else set())
