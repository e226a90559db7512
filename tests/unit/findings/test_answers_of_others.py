"""A promise that rests on another program's answers says so."""

from __future__ import annotations

from dataclasses import replace

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.answers_of_others import answers_assumed
from ros2cc_extract.findings.promises import Judgement, Mark, Promise, judge
from ros2cc_extract.generator.build import Profile
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.close import close
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import EntityKind, Spec
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.unit import verify_unit
from tests.unit.findings.finding_units import calls, client, service, threads, timer, unit

NODE = """\
import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        group = MutuallyExclusiveCallbackGroup()
        self.client = self.create_client(Trigger, 'plan', callback_group=group)
        {there}
        self.create_timer(0.5, self.move)

    def move(self):
        {waits}


rclpy.init()
executor = MultiThreadedExecutor(num_threads=2)
executor.add_node(Arm())
executor.spin()
"""


CALLS = 'self.client.call(Trigger.Request())'
BY_AN_EVENT = """answered = threading.Event()
        future = self.client.call_async(Trigger.Request())
        future.add_done_callback(lambda _: answered.set())
        answered.wait({seconds})"""


def waits_of(there: str, waits: str = CALLS) -> Judgement:
    [spec] = scan_text(NODE.format(there=there, waits=waits), 'arm.py').units
    judged = judge(spec, verify_unit(close(spec), Options(profile=Profile.RCLPY)), ())
    (waits,) = (each for each in judged if each.promise is Promise.WAITS)
    return waits


def test_an_answer_from_elsewhere_is_an_assumption_of_a_promise_that_is_kept() -> None:
    assumed = "as long as service 'plan' answers from the first request on"
    assert waits_of('pass') == Judgement(Promise.WAITS, Mark.KEPT, assumed)


def test_who_waits_until_the_server_is_there_assumes_less() -> None:
    there = 'self.client.wait_for_service(5.0)'
    assert waits_of(there).reason == "as long as service 'plan' answers"


@pytest.mark.parametrize(
    ('seconds', 'assumed'), [('', "as long as service 'plan' answers"), ('1.0', '')]
)
def test_an_event_that_the_answer_sets_waits_for_the_answer(seconds: str, assumed: str) -> None:
    there = 'self.client.wait_for_service(5.0)'
    judged = waits_of(there, BY_AN_EVENT.format(seconds=seconds))
    assert (judged.mark, judged.reason) == (Mark.KEPT, assumed)


def asking(*services: str, **facts: object) -> Spec:
    waits = tuple(block for name in services for block in calls(name, **facts))
    clients = tuple(client(name, 'other', key=name) for name in services)
    return unit(threads(3), timer('drive', blocking=waits), *clients)


@pytest.mark.parametrize(
    ('spec', 'said'),
    [
        (asking(), ''),
        (asking('plan', seconds=2.0), ''),
        (asking('plan', 'map'), "service 'plan', service 'map' answer from the first request on"),
        (asking('a', 'b', 'c', 'd'), "service 'a', service 'b', service 'c' and 1 more answer"),
    ],
)
def test_each_answer_without_a_time_out_is_assumed(spec: Spec, said: str) -> None:
    assert answers_assumed(spec).startswith(f'as long as {said}' if said else '')
    assert bool(answers_assumed(spec)) == bool(said)


def test_a_service_of_the_same_executor_is_judged_and_not_assumed() -> None:
    alone = asking('plan')
    with_server = replace(alone, callbacks=(*alone.callbacks, service('on_plan', key='plan')))
    assert answers_assumed(with_server) == ''


def test_names_that_are_not_known_and_actions_are_named_as_well_as_can_be() -> None:
    (drive, *_) = asking('plan').callbacks
    unknown = client('plan', 'other', key=Unknown('parameter'))
    assert answers_assumed(unit(threads(3), drive, unknown)).startswith(
        'as long as the service of plan'
    )
    action = replace(unknown, entity=EntityKind.ACTION_CLIENT, key='dock')
    assert answers_assumed(unit(threads(3), drive, action)).startswith("as long as action 'dock'")


def test_waiting_for_the_server_itself_is_no_wait_for_an_answer() -> None:
    waits = (Blocking(call='wait_for_service', on='plan'),)
    spec = unit(threads(3), timer('drive', blocking=waits), client('plan', 'other'))
    assert answers_assumed(spec) == ''
