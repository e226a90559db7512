"""A global that known code only sets to None is one thing, wherever it is used."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import Spec

USE = """
import rclpy
from std_srvs.srv import Trigger
{given}

class Robot:
    def __init__(self):
        self.stop = node.create_client(Trigger, 'stop')
        self.move = node.create_client(Trigger, 'move')

    def go(self):
        future = self.move.call_async(Trigger.Request())
        rclpy.spin_until_future_complete({spun}, future)

"""
BY_FUNCTION = 'node = None\ndef begin(given):\n    global node\n    node = given\n'
BY_NOBODY = 'node = None'


def only(units: tuple[Spec, ...]) -> Spec:
    assert len(units) == 1
    return units[0]


@pytest.mark.parametrize('given', [BY_FUNCTION, BY_NOBODY])
def test_clients_of_one_unset_global_are_those_of_one_node(given: str) -> None:
    unit = only(scan_text(USE.format(given=given, spun='node')).units)
    assert [callback.name for callback in unit.callbacks] == ['stop_client', 'move_client']


@pytest.mark.parametrize('given', [BY_FUNCTION, BY_NOBODY])
def test_who_spins_it_takes_the_answers_of_its_clients(given: str) -> None:
    wait: Blocking
    (wait,) = only(scan_text(USE.format(given=given, spun='node')).units).set_up
    assert wait.call == 'spin_until_future_complete'
    assert [waker.by for waker in wait.wakers] == ['move_client']
    assert wait.escapes is None


def test_another_node_takes_none_of_them() -> None:
    given = BY_NOBODY + "\nother = rclpy.create_node('other')"
    units = scan_text(USE.format(given=given, spun='other')).units
    (wait,) = (wait for unit in units for wait in unit.set_up)
    assert wait.escapes is not None


def test_a_name_of_a_function_is_not_that_of_the_module() -> None:
    text = (
        USE.format(given=BY_NOBODY, spun='node')
        + """
def more():
    node = None
    node.create_client(Trigger, 'third')

more()
"""
    )
    assert len(scan_text(text).units) == 2


def test_the_module_itself_means_the_same_thing() -> None:
    text = (
        USE.format(given=BY_NOBODY, spun='node') + "\nwait = node.create_client(Trigger, 'wait')\n"
    )
    names = [callback.name for callback in only(scan_text(text).units).callbacks]
    assert sorted(names) == ['move_client', 'stop_client', 'wait_client']
