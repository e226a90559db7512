"""
Runs a marked test under many schedules: ``@pytest.mark.ros2cc_schedules(200)``.

The test runs once as it comes, and then again and again in the same process, each time with its
fixtures made anew and under another schedule. The first run that fails is the result, with the
number that repeats it.
"""

from __future__ import annotations

import inspect
import os
import signal
import sys
import threading
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from _pytest.runner import CallInfo, runtestprotocol

from ros2cc_extract.ros.failed_orders import Order, keep, kept

if TYPE_CHECKING:
    from ros2cc_extract.explore.failures import Failure
    from ros2cc_extract.explore.in_process import InProcess
    from ros2cc_extract.explore.points import Point

MARKER, OPTION = 'ros2cc_schedules', '--ros2cc-schedule'
DEFAULT = 100
SECTION = 'ros2cc schedule'
# Executors wait for what they run, at their shutdown, so a hang may go on in the teardown.
_TEARDOWN_S = 10.0
_MOST_CHOICES = 20
# A test has few steps; by their number it is chosen where a schedule changes its mind.
_STEPS = 12
# What fails under a schedule is repeated in the order it had then, and by its number, in turns:
# what the test does before the first choice is not the schedule's.
_REPEATS = 6
_RECORDED = {'policy': 'recorded', 'gather_s': 0.0, 'ends_at_miss': True}
_running: list[_Schedule] = []
_hung: list[str] = []


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup('ros2cc')
    group.addoption(
        OPTION,
        type=int,
        metavar='N',
        help=f'run tests marked {MARKER} under schedule N only, as a failed one has named it',
    )


def pytest_configure(config: pytest.Config) -> None:
    text = f'{MARKER}(n={DEFAULT}, source=None): run the test under n schedules of its callbacks'
    config.addinivalue_line('markers', text)


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_protocol(item: pytest.Item, nextitem: pytest.Item | None) -> bool | None:
    marker = item.get_closest_marker(MARKER)
    if marker is None or not isinstance(item, pytest.Function):
        return None
    item.ihook.pytest_runtest_logstart(nodeid=item.nodeid, location=item.location)
    for report in _reports(item, marker, nextitem):
        item.ihook.pytest_runtest_logreport(report=report)
    item.ihook.pytest_runtest_logfinish(nodeid=item.nodeid, location=item.location)
    return True


def _reports(
    item: pytest.Function, marker: pytest.Mark, nextitem: pytest.Item | None
) -> list[pytest.TestReport]:
    """Run until a schedule fails, and give the reports of the last run."""
    from ros2cc_extract.explore.in_process import Learned

    asked = item.config.getoption(OPTION)
    numbers = [0, *([asked] * _REPEATS if asked else range(1, _count(marker) + 1))]
    learned, points = Learned(), _points(_sources(marker))
    reports: list[pytest.TestReport] = []
    for turn, number in enumerate(numbers, 1):
        is_last = turn == len(numbers)
        item._initrequest()
        order = kept(item, number, points) if asked and turn % 2 == 0 else []
        schedule = _Schedule(number, points, learned, order)
        _running.append(schedule)
        # Until the last one, what is made for more than one test stays as it is.
        follows: Any = nextitem if is_last else item.parent
        try:
            reports = runtestprotocol(item, log=False, nextitem=follows)
        finally:
            _running.remove(schedule)
            schedule.uninstall()
        schedule.judge(item, reports)
        if any(report.failed or report.skipped for report in reports):
            if number and not asked:
                keep(item, number, points, schedule.order)
            if not is_last:
                reports += _torn_down(item, nextitem)
            break
        if number == 0 and not _sources(marker):
            points = _points([Path(file) for file in learned.files])
    return reports


def _torn_down(item: pytest.Item, nextitem: pytest.Item | None) -> list[pytest.TestReport]:
    """Tear down what the next test does not use; a report where that fails."""
    tear_down = item.session._setupstate.teardown_exact
    # Before pytest 7 the item came first.
    asked = (nextitem,) if len(inspect.signature(tear_down).parameters) == 1 else (item, nextitem)
    call = CallInfo.from_call(lambda: tear_down(*asked), when='teardown')
    if call.excinfo is None:
        return []
    return [item.ihook.pytest_runtest_makereport(item=item, call=call)]


def _count(marker: pytest.Mark) -> int:
    count = marker.args[0] if marker.args else marker.kwargs.get('n', DEFAULT)
    if not isinstance(count, int) or count < 1:
        raise pytest.UsageError(f'{MARKER}({count!r}): write a whole number above 0')
    return count


def _sources(marker: pytest.Mark) -> list[Path]:
    given = marker.kwargs.get('source') or ()
    return [Path(each) for each in ([given] if isinstance(given, (str, Path)) else given)]


def _points(sources: Sequence[Path]) -> tuple[Point, ...]:
    from ros2cc_extract.explore.first_look import units_of
    from ros2cc_extract.explore.points import points_of

    return points_of(units_of(sources))


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_call(item: pytest.Item) -> Iterator[None]:
    if not _running:
        yield
        return
    with_schedule = _running[-1]
    with_schedule.begin()
    try:
        yield
    finally:
        with_schedule.end()


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_setup(item: pytest.Item) -> None:
    if _running:
        _running[-1].install()


class _Schedule:
    """
    One run of a test under one schedule; number 0 is the run as it comes.

    :param order: in which the schedule has failed before; empty where that is not known.
    """

    def __init__(self, number: int, points: tuple[Point, ...], learned: Any, order: Order) -> None:
        self._number = number
        self._order = order
        self._points = points
        self._learned = learned
        self._own: InProcess | None = None
        self._before: Any = None
        self._lock = threading.Lock()
        self._is_called = False

    def install(self) -> None:
        """Wrap rclpy, if the test has loaded it."""
        from ros2cc_extract.explore.in_process import InProcess

        if 'rclpy.executors' in sys.modules:
            self._own = InProcess(self._points, self._learned, self._found_hang)
            self._own.install()

    def begin(self) -> None:
        if self._own is None:
            self.install()
        if self._own is not None:
            if threading.current_thread() is threading.main_thread():
                self._before = signal.signal(signal.SIGUSR2, self._interrupted)
                self._is_called = True
            self._own.begin(self._row())

    def end(self) -> None:
        if self._own is not None:
            self._own.end()
            with self._lock:
                self._is_called = False
            if self._before is not None:
                signal.signal(signal.SIGUSR2, self._before)

    @property
    def order(self) -> Order:
        """What was chosen in this run."""
        return self._own.choices if self._own is not None else []

    def uninstall(self) -> None:
        if self._own is not None:
            self._own.uninstall()

    def _row(self) -> dict[str, Any]:
        from ros2cc_extract.explore.exploring import Strategy, schedule_row
        from ros2cc_extract.explore.scenario import PLAIN

        if self._number == 0:
            return {'number': 0, 'policy': PLAIN}
        if self._order:
            return {'number': self._number, **_RECORDED, 'choices': self._order}
        return schedule_row(Strategy.MIXED, 1, self._number, _STEPS)

    def _found_hang(self, failure: Failure) -> None:
        """Called beside the test: end it where it stands."""
        text = _text(failure)
        _hung.append(text)
        ident = threading.main_thread().ident
        with self._lock:
            if ident is not None and self._is_called:
                signal.pthread_kill(ident, signal.SIGUSR2)
        give_up = threading.Timer(_TEARDOWN_S, self._give_up, (text,))
        give_up.daemon = True
        give_up.start()

    def _interrupted(self, _number: int, _frame: Any) -> None:
        pytest.fail(_hung[-1] if _hung else 'hang', pytrace=False)

    def _give_up(self, text: str) -> None:
        if self in _running:
            sys.__stderr__.write(f'\n{text}\n{self._how_to_repeat("this test")}\n')  # type: ignore[union-attr]
            sys.__stderr__.write('the test does not end: pytest is ended\n')  # type: ignore[union-attr]
            sys.__stderr__.flush()  # type: ignore[union-attr]
            os._exit(1)

    def judge(self, item: pytest.Item, reports: Sequence[pytest.TestReport]) -> None:
        """Fail a run in which an update was lost, and say which schedule a failed one had."""
        from ros2cc_extract.explore.failures import Kind

        if self._own is None:
            return
        lost = [each for each in self._own.failures if each.kind is Kind.LOST_UPDATE]
        call = next((each for each in reports if each.when == 'call'), None)
        if lost and call is not None and call.passed:
            call.outcome = 'failed'
            call.longrepr = '\n'.join(map(_text, lost))
        for report in reports:
            if report.failed:
                report.sections.append((SECTION, self._words(item)))

    def _words(self, item: pytest.Item) -> str:
        from ros2cc_extract.explore.failures import Kind

        assert self._own is not None
        lines = [self._how_to_repeat(item.nodeid)]
        lines += [_text(each) for each in self._own.failures if each.kind is not Kind.HANG]
        order = self.order
        if order:
            lines.append('in this order:')
            lines += ['  …'] if len(order) > _MOST_CHOICES else []
            lines += [f'  {key}: {at}' for key, at in order[-_MOST_CHOICES:]]
        return '\n'.join(lines)

    def _how_to_repeat(self, nodeid: str) -> str:
        if self._number == 0:
            return 'it fails as it comes, without any schedule'
        return f'schedule {self._number}; repeat it: pytest {nodeid!r} {OPTION}={self._number}'


def _text(failure: Failure) -> str:
    from ros2cc_extract.explore.wording import shown_path

    where = f'{shown_path(failure.file)}:{failure.line}'
    head = f'{where}: {failure.kind.value}: {failure.words}'
    return '\n'.join([head, *(f'  {line}' for line in failure.evidence.splitlines())])


@pytest.hookimpl(trylast=True)
def pytest_unconfigure(config: pytest.Config) -> None:
    """Threads that hang would keep the interpreter from its end."""
    if _hung:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(int(pytest.ExitCode.TESTS_FAILED))
