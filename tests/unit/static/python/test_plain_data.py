"""Programs that read nested data for long: what has to do with ROS is reached all the same."""

from __future__ import annotations

from pathlib import Path

import pytest

from ros2cc_extract.extract.extraction import Extraction
from ros2cc_extract.extract.static.api import scan
from ros2cc_extract.extract.static.scan import guarded_runs
from ros2cc_extract.source_locations import Unknown

NAMES = [f'read_{number}' for number in range(20)]
HEAD = 'import json\nimport rclpy\nfrom rclpy.node import Node\nfrom tools import notify\n\n'
MAIN = """

def main():
    rclpy.init()
    config = {'topics': []}
    read_0(json.load(open('config.json')), config)
    node = Node('late')
    node.create_timer(1.0, print)
    for topic in config['topics']:
        node.create_subscription(str, topic, print, 10)
    rclpy.spin(node)


main()
"""


def reader(name: str, work: str) -> str:
    """A function that calls all its like: there are more ways than anybody can follow."""
    calls = ''.join(f'    if data.get({n!r}):\n        {n}(data[{n!r}], found)\n' for n in NAMES)
    return f'def {name}(data, found):\n{calls}    {work}\n\n\n'


def program(work: str) -> str:
    return HEAD + ''.join(reader(name, work) for name in NAMES) + MAIN


def scanned(folder: Path, work: str) -> Extraction:
    (folder / 'node.py').write_text(program(work))
    (folder / 'tools.py').write_text('def notify(node):\n    node.create_client(str, "x")\n')
    return scan([folder / 'node.py'])


@pytest.mark.parametrize('work', ['return data', 'found["size"] = len(data)'])
def test_what_comes_after_long_work_on_plain_data_is_there(work: str, tmp_path: Path) -> None:
    extraction = scanned(tmp_path, work)
    (unit,) = extraction.units
    assert (unit.name, unit.executor.spun) == ('late', 'rclpy.spin')
    assert [callback.period_s for callback in unit.callbacks if callback.period_s] == [1.0]
    assert extraction.diagnostics == ()


def test_what_such_work_may_have_filled_is_not_known(tmp_path: Path) -> None:
    (unit,) = scanned(tmp_path, 'found["topics"].append(data["topic"])').units
    (of_topics,) = (callback for callback in unit.callbacks if callback.entity.value != 'timer')
    assert isinstance(of_topics.count, Unknown)


def test_work_that_may_touch_a_node_is_never_left(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(guarded_runs, 'STEP_LIMIT', 50_000)
    extraction = scanned(tmp_path, 'notify(found.get("node"))')
    assert [diagnostic.slug for diagnostic in extraction.diagnostics] == ['not-followed']


def test_of_a_long_program_without_ros_nothing_is_missing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(guarded_runs, 'STEP_LIMIT', 50_000)
    loops = ''.join(f'{"    " * n}for i{n} in range(30):\n' for n in range(4))
    (tmp_path / 'size.py').write_text('from node import size\n\n' + loops + ' ' * 16 + 'size()\n')
    (tmp_path / 'node.py').write_text('import rclpy\n\n\ndef size():\n    return 1\n')
    assert scan([tmp_path]).diagnostics == ()
