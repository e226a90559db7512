"""What was found out is counted; what was not is listed with its place and reason."""

from __future__ import annotations

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.report.machine.json_report import confidence_data
from ros2cc_extract.report.text.confidence import confidence_lines
from ros2cc_extract.spec.assumptions import assume, read_assumptions
from ros2cc_extract.spec.confidence import Confidence, Subject, Summary, confidence_in
from ros2cc_extract.spec.model import Spec

PROGRAM = """
import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from elsewhere import group, period


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(1.0, self.one)
        self.create_timer(period(), self.two, callback_group=group())

    def one(self):
        pass

    def two(self):
        pass


rclpy.init()
executor = MultiThreadedExecutor()
executor.add_node(A())
executor.spin()
"""


BY_CPUS = '2 threads: rclpy takes the number of CPUs at run time, and 2 where it cannot be had'

PERIOD = (
    'unresolved: node.py:12:27: period of two: elsewhere.period(…): '
    'result of elsewhere.period, which is not scanned'
)
GROUP = (
    'unresolved: node.py:12:62: group of unresolved_1: elsewhere.group(…): '
    'result of elsewhere.group, which is not scanned'
)


def units() -> tuple[Spec, ...]:
    return scan_text(PROGRAM).units


def lines(found: Summary, most: int = 10) -> list[str]:
    return list(confidence_lines(found, most))


def test_counts_come_first_and_then_what_is_open() -> None:
    assert lines(confidence_in(units())) == [
        'resolved: 1 of 2 callbacks (1 unresolved), 1 of 2 groups (1 unresolved), '
        '1 of 1 thread counts (1 by assumption), 2 of 2 ownerships',
        f'assumed: {BY_CPUS}',
        PERIOD,
        GROUP,
    ]


def test_an_assumption_of_the_user_is_told_by_its_words() -> None:
    given = read_assumptions(['threads=3', 'group.unresolved_1=REENTRANT'])
    assert lines(confidence_in(assume(unit, given) for unit in units())) == [
        'resolved: 1 of 2 callbacks (1 unresolved), '
        '2 of 2 groups (1 by assumption), 1 of 1 thread counts (1 by assumption), '
        '2 of 2 ownerships',
        'assumed: group.unresolved_1=REENTRANT (--assume)',
        'assumed: threads=3 (--assume)',
        PERIOD,
    ]


def test_many_open_facts_are_only_counted() -> None:
    found = confidence_in(units())
    assert lines(found, 1)[3:] == ['unresolved: 1 more facts, which ros2cc-extract spec lists']
    assert lines(found, 0)[2:] == ['unresolved: 2 facts, which ros2cc-extract spec lists']


def test_many_rules_are_told_on_a_few_lines() -> None:
    rules = {f'parameter {name} keeps its default': 1 for name in 'abcdef'}
    of = {Subject.CALLBACKS: Confidence(0, {**rules, 'one of a list': 4}, 0)}
    assert lines(Summary(of, ())) == [
        'resolved: 10 of 10 callbacks (10 by assumption)',
        'assumed: one of a list (4 facts)',
        'assumed: parameter a keeps its default',
        'assumed: parameter b keeps its default',
        'assumed: parameter c keeps its default',
        'assumed: parameter d keeps its default',
        'assumed: 2 more rules, which ros2cc-extract spec lists',
    ]


def test_nothing_is_told_of_nothing() -> None:
    assert lines(confidence_in([])) == []


def test_a_node_nobody_spins_has_no_owner() -> None:
    found = confidence_in(scan_text(PROGRAM.replace('executor.add_node', '# ')).units)
    assert confidence_data(found)['ownerships'] == {'resolved': 0, 'assumed': {}, 'unresolved': 2}


def test_data_holds_reason_and_place() -> None:
    data = confidence_data(confidence_in(units()))
    assert data['thread_counts'] == {
        'resolved': 0,
        'assumed': {BY_CPUS: 1},
        'unresolved': 0,
    }
    assert [(fact['fact'], fact['place']) for fact in data['unresolved']] == [
        ('period', 'node.py:12:27'),
        ('group', 'node.py:12:62'),
    ]
