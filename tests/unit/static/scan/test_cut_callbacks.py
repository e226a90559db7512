"""A callback, or a thread, that is too long to be followed to its end may wait for anything."""

from __future__ import annotations

import pytest

from ros2cc_extract.checker.api import Verdict
from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.extract.static.scan import guarded_runs
from ros2cc_extract.generator.build import Family, Profile
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.close import close
from ros2cc_extract.spec.effects import NOT_FOLLOWED, Blocking
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.unit import verify_unit

LONG = """
import threading
import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node

class Long(Node):
    def __init__(self):
        super().__init__('long')
        self.done = threading.Event()
        self.create_timer(1.0, self.tick)
        threading.Thread(target=self.work).start()

    def tick(self):
        pass

    def work(self):
        pass

rclpy.init()
node = Long()
executor = MultiThreadedExecutor(2)
executor.add_node(node)
executor.spin()
"""
WAITS = '\n'.join(f'        self.field_{number} = {number}' for number in range(5_000))


@pytest.mark.parametrize(('function', 'line'), [('tick', 11), ('work', 12)])
def test_what_is_not_followed_may_wait_for_anything(
    function: str, line: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(guarded_runs, 'STEP_LIMIT', 4_000)
    head = f'    def {function}(self):\n'
    text = LONG.replace(f'{head}        pass', f'{head}{WAITS}\n        self.done.wait()')
    (unit,) = scan_text(text).units
    place = Place('node.py', line, 9)
    doer = next(
        each
        for each in (*unit.callbacks, *unit.activities)
        if (each.function or '').endswith(function)
    )
    why = Unknown(guarded_runs.TOO_LONG, place)
    assert doer.blocking == (Blocking(call=NOT_FOLLOWED, source=place, on=why, escapes=why),)


def test_its_claims_are_undecided(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(guarded_runs, 'STEP_LIMIT', 4_000)
    text = LONG.replace('        pass', WAITS, 1)
    (unit,) = scan_text(text).units
    results = verify_unit(close(unit), Options(profile=Profile.RCLPY)).results
    ends = [each.verdict for each in results if each.family == Family.PROGRESS.value]
    assert ends == [Verdict.UNDECIDED]
