"""A promise is kept only where that is proven, and broken only where a finding says so."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import pytest

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.findings.collect import findings_of
from ros2cc_extract.findings.promises import Judgement, Mark, Promise, about, judge
from ros2cc_extract.generator.build import Family, Profile
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.close import close
from ros2cc_extract.spec.model import Spec, Unresolved
from ros2cc_extract.verify.results.results import Verdict, Verification
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.unit import verify_unit

NODE = """\
import rclpy
from rclpy.node import Node


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.create_timer(0.1, self.move)

    def move(self):
        pass


rclpy.init()
rclpy.spin(Arm())
"""
FINDING = Finding(code='CC101', severity=Severity.ERROR, place=Place('arm.py', 8, 9), message='it')


@cache
def clean() -> tuple[Spec, Verification]:
    [unit] = scan_text(NODE, 'arm.py').units
    return unit, verify_unit(close(unit), Options(profile=Profile.RCLPY))


def marks(*own: Finding, near: tuple[Finding, ...] = (), **changes: object) -> dict[str, str]:
    unit, verification = clean()
    judged = judge(unit, replace(verification, **changes), own, near)
    return {each.promise.name: each.mark.name for each in judged if each.mark is not Mark.KEPT}


def all_open(judged: tuple[Judgement, ...]) -> bool:
    return [each.mark for each in judged] == [Mark.OPEN] * len(Promise)


def test_a_clean_node_keeps_all() -> None:
    assert marks() == {}


@pytest.mark.parametrize(
    ('code', 'broken'),
    [
        ('CC101', {'DEADLOCK', 'WAITS'}),
        ('CC112', {'WAITS'}),
        ('CC201', {'STARVATION'}),
        ('CC301', {'RACES'}),
        ('CC405', {'STARVATION', 'SETTINGS'}),
    ],
)
def test_a_finding_breaks_what_its_rule_is_about(code: str, broken: set[str]) -> None:
    assert marks(replace(FINDING, code=code)) == dict.fromkeys(broken, 'BROKEN')


@pytest.mark.parametrize('code', ['CC107', 'CC406'])
def test_who_serves_a_node_that_two_spins_have_is_open(code: str) -> None:
    told = replace(FINDING, code=code, severity=Severity.WARNING)
    broken = {'CC107': {'RACES'}, 'CC406': {'STARVATION', 'SETTINGS'}}[code]
    waits = dict.fromkeys(('DEADLOCK', 'WAITS', 'STARVATION'), 'OPEN')
    assert marks(told) == waits | dict.fromkeys(broken, 'BROKEN')
    # One by a unit is about a spin inside a callback, which the model has.
    assert marks(replace(told, unit='arm')) == dict.fromkeys(broken, 'BROKEN')
    near = marks(near=(told,))
    assert {name: near[name] for name in waits} == waits


def test_a_note_decides_nothing_but_that_a_setting_has_no_effect() -> None:
    assert marks(replace(FINDING, code='CC301', severity=Severity.NOTE)) == {'RACES': 'OPEN'}
    assert marks(replace(FINDING, code='CC403', severity=Severity.NOTE)) == {'SETTINGS': 'BROKEN'}


def test_what_may_be_about_another_unit_leaves_it_open() -> None:
    assert marks(near=(FINDING,)) == {'DEADLOCK': 'OPEN', 'WAITS': 'OPEN'}


@pytest.mark.parametrize('code', ['CC120', 'CC121'])
def test_a_wait_that_is_not_decided_leaves_open_what_rests_on_it(code: str) -> None:
    own = replace(FINDING, code=code, severity=Severity.NOTE)
    wanted = {'WAITS', 'STARVATION', *({'DEADLOCK'} if code == 'CC120' else ())}
    assert marks(own) == dict.fromkeys(wanted, 'OPEN')


@pytest.mark.parametrize('verdict', [Verdict.UNDECIDED, Verdict.NOT_SATISFIED])
def test_a_verdict_that_is_no_proof_leaves_it_open(verdict: Verdict) -> None:
    _, verification = clean()
    results = tuple(
        replace(result, verdict=verdict) if result.family == Family.DEADLOCK.value else result
        for result in verification.results
    )
    assert marks(results=results) == {'DEADLOCK': 'OPEN'}


def test_another_model_decides_nothing() -> None:
    unit, verification = clean()
    assert all_open(judge(unit, replace(verification, profile='paper'), ()))
    assert all_open(judge(unit, replace(verification, results=()), ()))
    assert all_open(judge(unit, replace(verification, defect='KeyError'), ()))


def test_what_is_not_known_of_the_unit_leaves_all_open() -> None:
    unit, verification = clean()
    executor = replace(unit.executor, kind=Unknown('nobody spins it'))
    fact = Unresolved(subject='arm', fact='entities', reason='passed to a library')
    [callback, *others] = unit.callbacks
    hidden = replace(callback, unresolved=Unknown('a parameter'))
    for open_unit in (
        replace(unit, executor=executor),
        replace(unit, unresolved=(fact,)),
        replace(unit, callbacks=(hidden, *others)),
    ):
        assert all_open(judge(open_unit, verification, ()))
    unread = replace(FINDING, code='CC500')
    assert all_open(judge(unit, verification, (unread,)))


def test_a_finding_of_the_scan_is_about_the_units_of_its_file() -> None:
    unit, _ = clean()
    other = replace(unit, name='other', sources=('other.py',))
    twin = replace(unit, name='twin')
    assert about([FINDING], unit, [unit, other]) == ([FINDING], [])
    assert about([FINDING], other, [unit, other]) == ([], [])
    assert about([FINDING], unit, [unit, twin]) == ([], [FINDING])


def test_a_finding_of_one_unit_is_not_about_its_neighbours() -> None:
    unit, _ = clean()
    other = replace(unit, name='other', entry='other.py:main')
    beside = replace(unit, name='beside')
    named = replace(FINDING, unit='arm', subjects=(unit.callbacks[0].name,))
    assert about([named], unit, [unit, other, beside]) == ([named], [])
    assert about([named], other, [unit, other, beside]) == ([], [])
    assert about([named], beside, [unit, other, beside]) == ([], [named])


COPIES = """\
import sys
import threading
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String


class Counter:
    def __init__(self, node, topic):
        self.node, self.lock = node, threading.Lock()
        group = {}
        node.create_subscription(String, topic, self.on_text, 1, callback_group=group)

    def on_text(self, msg):
        with {}:
            total = self.node.total
            self.node.get_logger().info('one more')
            self.node.total = total + len(msg.data)


class Counters(Node):
    def __init__(self):
        super().__init__('counters')
        self.total = 0
        self.shared = MutuallyExclusiveCallbackGroup()
        self.counters = [Counter(self, topic) for topic in sys.argv[1:]]


rclpy.init()
executor = {}
executor.add_node(Counters())
executor.spin()
"""
POOL, OPEN = 'MultiThreadedExecutor(4)', 'ReentrantCallbackGroup()'


@pytest.mark.parametrize(
    ('group', 'executor', 'mark'),
    [
        (OPEN, POOL, 'OPEN'),
        ('MutuallyExclusiveCallbackGroup()', POOL, 'OPEN'),
        ('node.shared', POOL, 'KEPT'),
        (OPEN, 'SingleThreadedExecutor()', 'KEPT'),
    ],
)
def test_what_each_copy_has_for_itself_keeps_no_other_out(
    group: str, executor: str, mark: str
) -> None:
    [unit] = scan_text(COPIES.format(group, 'self.lock', executor), 'arm.py').units
    verification = verify_unit(close(unit), Options(profile=Profile.RCLPY))
    judged = {each.promise: each for each in judge(unit, verification, ())}
    races = judged[Promise.RACES]
    told = 'Counter.on_text stands for several, each of which may have a group or lock of its own'
    assert (races.mark.name, races.reason) == (mark, told if mark == 'OPEN' else '')


TIMED = """\
import threading
import rclpy
from rclpy.node import Node
from std_msgs.msg import Empty


class Waiter(Node):
    def __init__(self):
        super().__init__('waiter')
        self.ready = threading.Event()
        self.create_subscription(Empty, 'ready', self.on_ready, 10)
        self.create_timer(1.0, self.work)

    def on_ready(self, msg):
        self.ready.set()

    def work(self):
        self.ready.wait({})


rclpy.init()
rclpy.spin(Waiter())
"""


@pytest.mark.parametrize(
    ('seconds', 'marks_of_waits', 'reason'),
    [
        ('5.0', ['KEPT', 'KEPT'], 'one by its time-out alone (CC102 at waiter.py:18)'),
        ('', ['BROKEN', 'BROKEN'], 'CC102'),
    ],
)
def test_a_wait_that_always_times_out_ends_all_the_same(
    seconds: str, marks_of_waits: list[str], reason: str
) -> None:
    [unit] = scan_text(TIMED.format(seconds), 'waiter.py').units
    verification = verify_unit(close(unit), Options(profile=Profile.RCLPY))
    own = findings_of([unit], [], [verification])
    judged = {each.promise: each for each in judge(unit, verification, own)}
    found = [judged[Promise.DEADLOCK], judged[Promise.WAITS]]
    assert [each.mark.name for each in found] == marks_of_waits
    assert judged[Promise.WAITS].reason == reason


TRANSFORM = """\
import rclpy
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.time import Time
from tf2_ros import Buffer, TransformListener


class Looker(Node):
    def __init__(self):
        super().__init__('looker')
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.create_timer(0.5, self.work)

    def work(self):
        {}


rclpy.init()
rclpy.spin(Looker())
"""
ASKS = "self.buffer.can_transform('map', 'base', Time(), Duration(seconds=1.0))"


@pytest.mark.parametrize(
    ('does', 'codes'),
    [(f"while not {ASKS}:\n            print('no')", ['CC109']), (f'print({ASKS})', ['CC205'])],
)
def test_what_an_attempt_costs_is_not_reported_beside_a_loop_that_never_ends(
    does: str, codes: list[str]
) -> None:
    [unit] = scan_text(TRANSFORM.format(does)).units
    verification = verify_unit(close(unit), Options(profile=Profile.RCLPY))
    found = findings_of([unit], [], [verification])
    assert [each.code for each in found if each.code[:3] in ('CC1', 'CC2')] == codes


@pytest.mark.parametrize(
    ('group', 'settings'), [('ReentrantCallbackGroup', 'KEPT'), (None, 'OPEN')]
)
def test_threads_have_an_effect_where_one_callback_overlaps_itself(
    group: str | None, settings: str
) -> None:
    made = f'callback_group=rclpy.callback_groups.{group}()' if group else ''
    text = (
        NODE.replace('import rclpy\n', 'import rclpy.callback_groups\n')
        .replace('self.move)', f'self.move, {made})')
        .replace('Arm())', 'Arm(), rclpy.executors.MultiThreadedExecutor(num_threads=2))')
    )
    [unit] = scan_text(text, 'arm.py').units
    judged = judge(unit, verify_unit(close(unit), Options(profile=Profile.RCLPY)), ())
    marked = {each.promise: each.mark.name for each in judged}
    assert marked[Promise.SETTINGS] == settings


def test_of_units_with_one_name_a_finding_is_about_that_of_its_file() -> None:
    one, other = (
        replace(scan_text(NODE).units[0], sources=(name,)) for name in ('one.py', 'other.py')
    )
    finding = replace(FINDING, unit=one.name, place=Place('one.py', 3, 1))
    assert about([finding], one, [one, other]) == ([finding], [])
    assert about([finding], other, [one, other]) == ([], [])
    elsewhere = replace(finding, place=Place('helper.py', 3, 1))
    assert about([elsewhere], other, [one, other]) == ([elsewhere], [])
