"""CC304 and CC305: what two runs of one callback, or a test and a use, lose between them."""

from __future__ import annotations

from dataclasses import replace

import pytest
from finding_units import (
    ONE_THREAD,
    at,
    found,
    only,
    outside,
    service,
    sleeps,
    threads,
    timer,
    unit,
    updates,
)

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of
from ros2cc_extract.spec.effects import Access, Act, Blocking
from ros2cc_extract.spec.model import Callback, EntityKind, Spec, When


def access(line: int, *locks: str, **facts: object) -> Access:
    return Access(name='Arm.goal', source=at(line), locks=locks, **facts)  # type: ignore[arg-type]


def takes(*lines: int) -> tuple[Act, ...]:
    return tuple(Act(name='lock', source=at(line)) for line in lines)


def told(*callbacks: Callback, executor: int = 3) -> list[str]:
    codes = found(unit(threads(executor), *callbacks))
    return [code for code in codes if code.startswith('CC3')]


WAITING = {'blocking': sleeps(0.2, line=25)}
CALLED_BETWEEN = {'reads': (access(20),), 'writes': (access(30, rests=True, later=True),)}
READ_THEN_WRITTEN = {'reads': (access(20),), 'writes': (access(30, rests=True),)}
WRITTEN_THEN_READ = {'reads': (access(30),), 'writes': (access(20),)}


@pytest.mark.parametrize(
    ('callback', 'expected'),
    [
        (service('on_go', 'free', **READ_THEN_WRITTEN, **WAITING), ['CC304:30 warning']),
        (service('on_go', 'free', **READ_THEN_WRITTEN), ['CC304:30 note']),
        (service('on_go', 'free', **CALLED_BETWEEN), ['CC304:30 warning']),
        (service('on_go', 'other', **READ_THEN_WRITTEN, **WAITING), []),
        (
            timer('tick', 'free', period_s=0.1, **READ_THEN_WRITTEN, **WAITING),
            ['CC304:30 warning'],
        ),
        (timer('tick', 'free', period_s=0.5, **READ_THEN_WRITTEN, **WAITING), ['CC304:30 note']),
        (service('on_go', 'free', **WRITTEN_THEN_READ, **WAITING), ['CC304:30 warning']),
        (service('on_go', 'free', **WRITTEN_THEN_READ), []),
        (
            outside('execute', EntityKind.ACTION_EXECUTE, **WRITTEN_THEN_READ, **WAITING),
            ['CC304:30 warning'],
        ),
    ],
)
def test_two_runs_of_one_callback(callback: Callback, expected: list[str]) -> None:
    assert told(callback) == expected
    assert told(callback, executor=1) == []


def test_what_is_written_whatever_was_read_is_left_alone() -> None:
    unrelated = replace(READ_THEN_WRITTEN['writes'][0], rests=False)
    node = service('on_go', 'free', reads=(access(20),), writes=(unrelated,), **WAITING)
    assert told(node) == []


def test_what_others_store_too_is_read_back_on_purpose() -> None:
    own = service('on_go', 'free', **WRITTEN_THEN_READ, **WAITING)
    stores = timer('tick', 'free', writes=(access(40),))
    clears = timer('tick', 'free', writes=(access(40, clears=True),))
    assert 'CC304:30 warning' not in told(own, stores)
    assert 'CC304:30 warning' in told(own, clears)


def test_who_compares_reckons_with_others() -> None:
    asked = replace(access(30), compared=True)
    assert told(service('on_go', 'free', reads=(asked,), writes=(access(20),), **WAITING)) == []


def test_a_sum_in_one_statement_is_an_update() -> None:
    read = Access(name='Arm.goal', source=at(30, 21))
    node = service('on_go', 'free', reads=(read,), writes=(access(30, rests=True),))
    finding = only(unit(threads(2), node), 'CC304')
    assert 'updates Arm.goal from its old value' in finding.message


def test_one_lock_from_the_read_to_the_write_protects_and_two_sections_do_not() -> None:
    reads, writes = (access(20, 'lock'),), (access(30, 'lock', rests=True),)
    one = service('on_go', 'free', reads=reads, writes=writes, locks=takes(19), **WAITING)
    assert told(one) == []
    assert told(replace(one, locks=takes(19, 29))) == ['CC304:30 warning']


def test_a_lock_that_is_held_twice_is_no_new_section() -> None:
    reads, writes = (access(20, 'lock'),), (access(30, 'lock', 'lock', rests=True),)
    node = service('on_go', 'free', reads=reads, writes=writes, locks=takes(19, 29), **WAITING)
    assert told(node) == []


def test_two_sections_of_one_lock_lose_what_another_callback_writes() -> None:
    on_go = service(
        'on_go',
        reads=(access(20, 'lock'),),
        writes=(access(30, 'lock', rests=True),),
        locks=takes(19, 29),
    )
    other = timer('tick', 'other', writes=(access(40, 'lock'),), locks=takes(39))
    assert told(on_go, other) == ['CC301:30 warning']
    assert told(replace(on_go, locks=takes(19)), other) == []


def test_items_of_other_keys_do_not_meet() -> None:
    def writing(item: str) -> Spec:
        left = replace(updates('Arm.sides', 20)[0], item="'left'")
        other = replace(updates('Arm.sides', 30)[0], item=item)
        return unit(
            threads(2), timer('tick', writes=(left,)), timer('tock', 'other', writes=(other,))
        )

    assert found(writing("'right'")) == []
    assert found(writing("'left'")) == ['CC301:20 warning']


def using(*locks: str, **facts: object) -> Callback:
    reads = (access(20, *locks), access(21, *locks, rests=True, later=True))
    return timer('check', reads=reads, locks=takes(19) if locks else (), **facts)


def clearing(*locks: str, group: str = 'other') -> Callback:
    return service('on_stop', group, writes=(access(40, *locks, clears=True),))


def test_an_object_that_is_set_to_none_between_a_test_and_its_use() -> None:
    assert told(using(), clearing()) == ['CC305:21 warning']
    assert told(using(), clearing(group='arm_default')) == []
    assert told(using('lock'), clearing('lock')) == []
    assert told(using('lock'), clearing()) == ['CC305:21 warning']
    stored = replace(clearing(), writes=(access(40),))
    assert told(using(), stored) == []


def test_nothing_called_between_a_test_and_a_use_makes_it_a_note() -> None:
    at_once = replace(using(), reads=(access(20), access(21, rests=True)))
    assert told(at_once, clearing()) == ['CC305:21 note']


def test_an_object_that_the_callback_stores_itself_is_there() -> None:
    fresh = replace(using(), writes=(Access(name='Arm.goal', source=at(20, 30), rests=True),))
    codes = told(fresh, clearing())
    assert codes == ['CC301:20 warning'], 'its own write is what the other one disturbs'


def test_message_of_a_use_after_a_test() -> None:
    finding = only(unit(threads(2), using(), clearing()), 'CC305')
    assert finding.message == (
        'check tests Arm.goal and then uses it, and on_stop may set it to None in between: then '
        'the use raises an exception'
    )
    assert [(remark.place, remark.text) for remark in finding.related] == [
        (at(40), 'on_stop writes Arm.goal here')
    ]


def test_a_run_may_clear_what_another_run_of_the_same_callback_uses() -> None:
    node = service(
        'on_stop',
        'free',
        reads=(access(20), access(21, rests=True, later=True)),
        writes=(access(22, clears=True),),
    )
    (finding,) = findings_of([unit(threads(2), node)], [], [None])
    assert (finding.code, finding.place, finding.message) == (
        'CC305',
        at(21),
        'on_stop tests Arm.goal and then uses it, and another run of it may set it to None in '
        'between: then the use raises an exception',
    )


def test_all_that_one_line_uses_so_is_one_finding() -> None:
    def of(name: str, line: int, **how: bool) -> Access:
        return replace(access(line, **how), name=name)

    node = service(
        'on_stop',
        'free',
        reads=tuple(
            of(name, line, rests=line == 21, later=line == 21)
            for name in ('Lift.index', 'Wrist.index')
            for line in (20, 21)
        ),
        writes=(of('Lift.index', 22, clears=True), of('Wrist.index', 22, clears=True)),
    )
    (finding,) = findings_of([unit(threads(2), node)], [], [None])
    assert finding.message == (
        'on_stop tests Lift.index, Wrist.index and then uses them, and another run of it may set '
        'one of them to None in between: then the use raises an exception'
    )


AWAITING = {'coroutine': True, 'blocking': (Blocking(call='await', source=at(25)),)}


@pytest.mark.parametrize(
    ('facts', 'group', 'expected'),
    [
        (AWAITING, 'free', ['CC304:30 warning']),
        (AWAITING, 'other', []),
        ({**AWAITING, **WAITING}, 'free', []),
        ({**AWAITING, 'coroutine': False}, 'free', []),
    ],
)
def test_a_coroutine_on_one_thread_meets_itself_where_it_awaits(
    facts: dict[str, object], group: str, expected: list[str]
) -> None:
    node = service('on_go', group, **READ_THEN_WRITTEN, **facts)
    found_in = found(unit(ONE_THREAD, node, timer('tick')))
    assert [code for code in found_in if code.startswith('CC3')] == expected


@pytest.mark.parametrize(
    ('group', 'expected'), [('other', ['CC301:30 warning']), ('arm_default', [])]
)
def test_a_coroutine_on_one_thread_meets_members_of_other_groups(
    group: str, expected: list[str]
) -> None:
    on_go = service('on_go', **READ_THEN_WRITTEN, **AWAITING)
    other = timer('tick', group, writes=(access(40),))
    found_in = found(unit(ONE_THREAD, on_go, other))
    assert [code for code in found_in if code.startswith('CC3')] == expected


def asks(name: str = 'ask', group: str = 'arm_default', **facts: object) -> Callback:
    act = Act(name='done_callback', source=at(12), **facts)  # type: ignore[arg-type]
    return timer(name, group, period_s=0.5, changes=(act,))


ANSWERED = outside(
    'on_answer',
    EntityKind.DONE_CALLBACK,
    when=When.CALLBACK,
    source=at(12),
    writes=updates('Arm.answers', 30),
)


@pytest.mark.parametrize(
    ('callbacks', 'severity'),
    [
        ((asks(), ANSWERED), 'note'),
        ((asks(), replace(ANSWERED, blocking=sleeps(0.2, line=25))), 'note'),
        ((asks(), replace(ANSWERED, changes=asks().changes)), 'note'),
        ((asks(), replace(ANSWERED, blocking=sleeps(0.7, line=25))), 'warning'),
        ((asks(repeats=True), ANSWERED), 'warning'),
        ((asks(), asks('too', 'other'), ANSWERED), 'warning'),
        ((asks(group='free'), ANSWERED), 'warning'),
        ((service('go', changes=asks().changes), ANSWERED), 'warning'),
        ((ANSWERED,), 'warning'),
    ],
)
def test_answers_come_together_where_no_timer_spaces_them(
    callbacks: tuple[Callback, ...], severity: str
) -> None:
    """By a timer that asks once in a run, two come together only after one has been late."""
    assert told(*callbacks) == [f'CC304:30 {severity}']


ASKING = """
import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger

class A(Node):
    def __init__(self):
        super().__init__('a')
        self.answers = 0
        self.client = self.create_client(Trigger, 'ask')
        self.create_timer(1.0, self.tick)
        self.create_subscription(Trigger.Request, 'go', self.on_go, 10)

    def tick(self):
        TICK

    def on_go(self, message):
        GO

    def ask(self):
        self.client.call_async(Trigger.Request()).add_done_callback(self.on_done)

    def on_done(self, future):
        self.answers += future.result().success

rclpy.init()
executor = MultiThreadedExecutor(num_threads=3)
executor.add_node(A())
executor.spin()
"""


@pytest.mark.parametrize(
    ('tick', 'go', 'severity'),
    [
        ('self.ask()', 'pass', 'note'),
        ('[self.ask() for _ in range(3)]', 'pass', 'warning'),
        ('for _ in self.names: self.ask()', 'pass', 'warning'),
        ('while self.answers < 3: self.ask()', 'pass', 'warning'),
        ('self.ask(); self.ask()', 'pass', 'warning'),
        ('self.ask()', 'self.ask()', 'warning'),
    ],
)
def test_who_asks_and_how_often_is_read_from_the_text(tick: str, go: str, severity: str) -> None:
    text = ASKING.replace('TICK', tick).replace('GO', go)
    findings = findings_of(scan_text(text).units, [], [None])
    assert [f.severity.value for f in findings if f.code == 'CC304'] == [severity]


LEDGER = """
import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from std_msgs.msg import Int64
from std_srvs.srv import Trigger

class Store:
    def __init__(self):
        self.level = 0
        self.top = 0

    def put(self, level, top=0):
        self.level = level
        self.top = top

class Tank(Node):
    def __init__(self):
        super().__init__('tank')
        self.store = Store()
        free = ReentrantCallbackGroup()
        self.client = self.create_client(Trigger, 'ask', callback_group=free)
        self.create_subscription(Int64, 'fill', self.on_fill, 10, callback_group=free)

    async def on_fill(self, message):
        BODY

rclpy.init()
rclpy.spin(Tank())
"""


@pytest.mark.parametrize(
    ('body', 'lost'),
    [
        ('old = self.store.level; await ASK; self.store.put(old + message.data)', ['Store.level']),
        ('old = self.store.top; await ASK; self.store.put(5, top=old + 1)', ['Store.top']),
        ('old = self.store.top; await ASK; self.store.put(*[5], old + 1)', ['Store.top']),
        ('old = self.store.level; await ASK; self.store.put(message.data, 7)', []),
        ('await ASK; self.store.put(self.store.level + message.data)', []),
    ],
)
def test_a_copy_stays_one_when_it_is_handed_to_a_helper(body: str, lost: list[str]) -> None:
    """What a parameter was computed from is known as it is of any other own name."""
    asked = 'self.client.call_async(Trigger.Request())'
    spec = scan_text(LEDGER.replace('BODY', body.replace('ASK', asked)))
    told = [f for f in findings_of(spec.units, [], [None]) if f.code == 'CC304']
    assert [name for f in told for name in lost if name in f.message] == lost
    assert len(told) == len(lost)


SURVEY = """
import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger

class Survey(Node):
    def __init__(self):
        super().__init__('survey')
        self.pending = True
        free = ReentrantCallbackGroup()
        self.client = self.create_client(Trigger, 'map', callback_group=free)
        self.create_timer(5.0, self.tick, callback_group=free)

    def tick(self):
        TICK

    def begin(self, wanted=True):
        BEGIN

    def finish(self):
        self.pending = False

    def is_wanted(self):
        return self.client.service_is_ready()

rclpy.init()
rclpy.spin(Survey(), executor=MultiThreadedExecutor(num_threads=3))
"""
WAIT = 'self.client.wait_for_service(timeout_sec=1.0)'


@pytest.mark.parametrize(
    ('tick', 'begin', 'severity'),
    [
        (f'{WAIT}\n        if self.pending: self.pending = False', 'pass', 'note'),
        (f'{WAIT}\n        if self.pending: self.begin()', 'self.pending = False', 'note'),
        (f'{WAIT}\n        if self.pending: self.begin()', 'self.finish()', 'note'),
        (f'{WAIT}; self.begin()', 'if self.pending: self.finish()', 'note'),
        (f'if self.pending: {WAIT}; self.begin()', 'self.pending = False', 'warning'),
        ('if self.pending: self.begin()', f'{WAIT}; self.pending = False', 'warning'),
        ('if self.pending: self.begin()', f'{WAIT}; self.finish()', 'warning'),
        (
            f'{WAIT}\n        if self.pending: self.begin()',
            'if self.is_wanted(): self.finish()',
            'warning',
        ),
        (
            f'{WAIT}\n        if self.pending: self.begin(self.is_wanted())',
            'self.pending = False',
            'warning',
        ),
        (
            f'{WAIT}\n        if self.pending: self.is_wanted(); self.pending = False',
            'pass',
            'warning',
        ),
    ],
)
def test_a_helper_that_writes_is_as_its_text_in_its_place(
    tick: str, begin: str, severity: str
) -> None:
    """A wait before the test is none in between; one in the helper, or another helper, is."""
    text = SURVEY.replace('TICK', tick).replace('BEGIN', begin)
    findings = findings_of(scan_text(text).units, [], [None])
    assert [f.severity.value for f in findings if f.code == 'CC304'] == [severity]
