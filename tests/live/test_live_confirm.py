"""``confirm`` shows findings on real rclpy: by force, again from its file, and never of a twin."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from ros2cc_extract.confirm import confirming
from ros2cc_extract.confirm.confirming import confirm
from ros2cc_extract.confirm.outcomes import Outcome
from ros2cc_extract.confirm.processes import DOMAINS_VARIABLE
from ros2cc_extract.confirm.schedules import Schedule, read_schedule
from tests.confirm.table import onto, schedules
from tests.support.domains import free_domains

BUGS = Path(__file__).parents[1] / 'bugs'
AT_ONCE = 2
LIMIT_S = 120.0
# Of one that waits where its wait might be ended: what hangs is confirmed within half of it.
HANGS_WITHIN_S = 12.0


@pytest.fixture(autouse=True)
def own_domains(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Nobody else's messages, and none for anybody else."""
    with free_domains(AT_ONCE) as numbers:
        monkeypatch.setenv(DOMAINS_VARIABLE, f'{numbers[0]}-{numbers[-1]}')
        yield


def test_locks_in_opposite_order_are_confirmed(rclpy_python: str, tmp_path: Path) -> None:
    """Without force the two callbacks would meet between their locks once in a blue moon."""
    kept, node = tmp_path / 'kept.json', BUGS / 'g4_lock_order.py'
    command = [sys.executable, '-m', 'ros2cc_extract.cli.main', 'confirm', str(node), 'CC111']
    options = ['--yes', '--python', rclpy_python, '--keep', str(kept), '--limit', str(LIMIT_S)]
    done = subprocess.run(
        [*command, *options, '--output-format', 'json'], capture_output=True, text=True
    )
    (found,) = json.loads(done.stdout)['findings']
    assert (done.returncode, found['outcome'], found['line']) == (1, 'confirmed', 24)
    assert 'clear (ThreadPoolExecutor' in found['evidence']
    assert read_schedule(kept).points[0].holds


@pytest.mark.slow
def test_a_lost_update_is_shown_by_its_values_and_the_twin_loses_none(
    rclpy_python: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    node, twin = BUGS / 'g2_lost_update.py', BUGS / 'g2_lost_update_mended.py'
    (schedule,) = schedules(node, '7.1.6')
    shown = confirm(schedule, rclpy_python, LIMIT_S).judgement
    assert shown.outcome is Outcome.CONFIRMED
    # Not in `self.count += 1`, where Python lets no other thread in, but where it is reported and
    # set to 0: what was counted meanwhile is lost.
    values = r'count was (\d+) before line 25, another thread set it to \d+, and line 25 then to 0'
    assert re.fullmatch(values, shown.reason)
    monkeypatch.setattr(confirming, 'MOST_TRIES', 2)
    result = confirm(onto(schedule, twin), rclpy_python, LIMIT_S).judgement
    assert result.outcome is Outcome.NOT_REACHED
    assert 'nobody else wrote while line' in result.reason


def test_a_missing_module_is_the_reason(rclpy_python: str, tmp_path: Path) -> None:
    node = tmp_path / 'node.py'
    text = (BUGS / 'b10_call_in_own_group.py').read_text(encoding='utf-8')
    node.write_text(f'import no_such_driver\n{text}', encoding='utf-8')
    command = [sys.executable, '-m', 'ros2cc_extract.cli.main', 'confirm', str(node)]
    done = subprocess.run(
        [*command, '--yes', '--python', rclpy_python], capture_output=True, text=True
    )
    assert done.returncode == 0
    assert 'needs the module no_such_driver, which is not there; see --stub-missing' in done.stdout


# Device and interfaces are installed nowhere; what it waits for depends on a text of a request.
OF_A_ROBOT = """
import rclpy
from rclpy.node import Node
from no_such_interfaces.msg import Wheels
from no_such_interfaces.srv import Order, Park
from no_such_driver import Motor


class Car(Node):
    def __init__(self):
        super().__init__('car')
        self.motor = Motor('/dev/ttyACM0')
        self.speed = 0.0
        self.parking = self.create_client(Park, 'park')
        self.create_subscription(Wheels, 'wheels', self.on_wheels, 10)
        self.create_service(Order, 'order', self.on_order)

    def on_wheels(self, wheels):
        self.speed = (wheels.left + wheels.right) / 2 * self.motor.ratio

    def on_order(self, order, answer):
        if order.word.lower() == 'park':
            answer.done = self.parking.call(Park.Request(side=order.side)).done
        return answer


def main():
    rclpy.init()
    rclpy.spin(Car())


if __name__ == '__main__':
    main()
"""


@pytest.mark.slow
def test_interfaces_that_are_not_installed_are_stood_in_for(
    rclpy_python: str, tmp_path: Path
) -> None:
    node = tmp_path / 'node.py'
    node.write_text(OF_A_ROBOT, encoding='utf-8')
    command = [sys.executable, '-m', 'ros2cc_extract.cli.main', 'confirm', str(node), '--yes']
    options = ['--python', rclpy_python, '--limit', str(LIMIT_S), '--output-format', 'json']
    done = subprocess.run([*command, *options, '--stub-missing'], capture_output=True, text=True)
    (found,) = json.loads(done.stdout)['findings']
    assert (found['code'], found['outcome']) == ('CC102', 'confirmed'), done.stdout
    assert 'Car.on_order' in found['evidence']


# The driver is installed nowhere, and what it is given would end the wait.
GIVES_ITS_FUNCTION = """
import threading

import rclpy
from rclpy.node import Node
from std_msgs.msg import Empty
from no_such_driver import Motor


class Car(Node):
    def __init__(self):
        super().__init__('car')
        self.stopped = threading.Event()
        self.create_subscription(Empty, 'ended', self.on_ended, 10)
        self.create_subscription(Empty, 'stop', self.on_stop, 10)
        {given}

    def on_ended(self, msg):
        self.stopped.set()

    def on_stop(self, msg):
        self.stopped.wait()


rclpy.init()
rclpy.spin(Car())
"""


def of_a_stand_in(given: str, folder: Path) -> Schedule:
    """Of one that is given a function, `check` says by itself that somebody may call it."""
    folder.mkdir()
    node = folder / 'node.py'
    node.write_text(GIVES_ITS_FUNCTION.format(given='Motor()'), encoding='utf-8')
    (schedule,) = schedules(node, '7.1.6')
    node.write_text(GIVES_ITS_FUNCTION.format(given=given), encoding='utf-8')
    return schedule


@pytest.mark.slow
def test_what_a_stand_in_was_given_might_end_the_wait(rclpy_python: str, tmp_path: Path) -> None:
    text = of_a_stand_in("Motor('/dev/ttyACM0')", tmp_path / 'text')
    function = of_a_stand_in('Motor(on_end=self.stopped.set)', tmp_path / 'function')
    with ThreadPoolExecutor(AT_ONCE) as pool:
        shown = pool.submit(confirm, text, rclpy_python, LIMIT_S, stubs=True)
        open_one = pool.submit(confirm, function, rclpy_python, HANGS_WITHIN_S, stubs=True)
    found = shown.result().judgement
    assert found.outcome is Outcome.CONFIRMED, found
    assert 'given Event.set' not in found.reason
    found = open_one.result().judgement
    assert found.outcome is Outcome.NOT_REACHED, found
    assert 'given Event.set' in found.reason


# It stands neither the values of messages nor, as a life-cycle node, a transition it has not.
ONLY_DEFAULTS = """
import rclpy
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn
from std_msgs.msg import Int32
from std_srvs.srv import Trigger


class Cells(LifecycleNode):
    def __init__(self):
        super().__init__('cells')
        self.seen = 0

    def on_configure(self, state):
        self.client = self.create_client(Trigger, 'save')
        self.create_subscription(Int32, 'cells', self.on_cells, 10)
        return TransitionCallbackReturn.SUCCESS

    def on_cells(self, msg):
        [0][msg.data]
        self.seen += 1
        if self.seen > 3:
            self.client.call(Trigger.Request())


rclpy.init()
rclpy.spin(Cells())
"""


def test_a_node_is_met_as_it_can_stand_it(rclpy_python: str, tmp_path: Path) -> None:
    node = tmp_path / 'node.py'
    node.write_text(ONLY_DEFAULTS, encoding='utf-8')
    (schedule,) = schedules(node, '7.1.6')
    found = confirm(schedule, rclpy_python, LIMIT_S)
    assert found.judgement.outcome is Outcome.CONFIRMED, found.judgement
    assert not found.schedule.filled


# Two callbacks that wait for an action in vain, as the client is in the group that they close.
OF_AN_ACTION = """
import rclpy
from rclpy.action import ActionClient
from rclpy.node import Node
from std_msgs.msg import Empty
from test_msgs.action import Fibonacci


class Head(Node):
    def __init__(self):
        super().__init__('head')
        self.client = ActionClient(self, Fibonacci, 'turn')
        self.create_timer(0.5, self.look)
        self.create_subscription(Empty, 'down', self.on_down, 10)

    def look(self):
        self.turn()

    def on_down(self, msg):
        self.turn()

    def turn(self):
        self.client.wait_for_server(timeout_sec=5.0)
        future = self.client.send_goal_async(Fibonacci.Goal())
        rclpy.spin_until_future_complete(self, future, timeout_sec=1.0)


rclpy.init()
rclpy.spin(Head())
"""


def test_an_action_that_is_always_waited_for_in_vain(rclpy_python: str, tmp_path: Path) -> None:
    node = tmp_path / 'node.py'
    node.write_text(OF_AN_ACTION, encoding='utf-8')
    schedule = next(each for each in schedules(node, '7.1.6') if each.code == 'CC101')
    assert schedule.times_out_s == 1.0
    found = confirm(schedule, rclpy_python, LIMIT_S).judgement
    assert found.outcome is Outcome.CONFIRMED, found
    assert found.reason.startswith('took the whole time-out of 1 s')


@pytest.mark.slow
def test_libraries_that_spin_or_wait_are_stood_in_for(rclpy_python: str) -> None:
    """What they do with the executor is known, so a stand-in does it too."""
    nodes = ('a11_navigator_in_callback', 'f2_buffer_client_on_one_thread')
    tried = [each for name in nodes for each in schedules(BUGS / f'{name}.py', '7.1.6')]

    def shown(schedule: Schedule) -> str:
        found = confirm(schedule, rclpy_python, LIMIT_S, stubs=True).judgement
        return f'{schedule.code} {found.outcome.value}: {found.reason}'

    with ThreadPoolExecutor(AT_ONCE) as pool:
        said = list(pool.map(shown, tried))
    answer = 'CC107 confirmed: the answer of /navigate_to_pose is run by the nested spin at line'
    assert said[:2] == [f'{answer} 16', f'{answer} 17']
    assert said[2].startswith('CC102 confirmed: took the whole time-out of 3 s, 1 time'), said
