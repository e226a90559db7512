"""From a recording to specifications."""

from __future__ import annotations

from pathlib import Path

from ros2cc_extract.extract.live.recordings.collect import specs_of
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    CallbackType,
    EntityKind,
    Executor,
    GroupType,
    Origin,
    Spec,
)
from tests.unit.live.recordings import executor, group, node, recording, stay, timer


def test_executor_with_one_node_is_a_unit(tmp_path: Path) -> None:
    recorded = recording(
        tmp_path,
        executors=[executor(1)],
        nodes=[node(2, 'arm', stay(1, 10, None))],
        groups=[group(3, node=2, default=True)],
        entities=[timer(4, 2, 3, 'arm.Arm.tick')],
    )
    assert specs_of(recorded) == (
        Spec(
            name='arm',
            callbacks=(
                Callback(
                    name='tick',
                    type=CallbackType.TMR,
                    group='arm_default',
                    entity=EntityKind.TIMER,
                    node='arm',
                    function='arm.Arm.tick',
                    period_s=0.5,
                    source=Place('arm.py', 12, 9),
                    defined=Place('arm.py', 20),
                ),
            ),
            groups=(
                CallbackGroup(
                    name='arm_default', type=GroupType.EXCLUSIVE, default=True, node='arm'
                ),
            ),
            executor=Executor(
                name='executor',
                threads=('thread_0',),
                kind='SingleThreadedExecutor',
                source=Place('arm.py', 50, 5),
            ),
            origin=Origin.LIVE,
            nodes=('arm',),
            sources=('arm.py',),
            rclpy='7.1.6',
        ),
    )


def homes(folder: Path, *stays: dict[str, object]) -> list[str]:
    """Name the executors' classes of the units that a node with these stays gives."""
    recorded = recording(
        folder,
        executors=[executor(1, **{'class': 'First'}), executor(2, **{'class': 'Second'})],
        nodes=[node(3, 'arm', *stays)],
    )
    return [str(spec.executor.kind) for spec in specs_of(recorded)]


def test_node_belongs_to_the_executor_it_was_in_longest(tmp_path: Path) -> None:
    assert homes(tmp_path, stay(1, 0, 100), stay(2, 100, 110)) == ['First']


def test_executor_that_never_ran_does_not_count(tmp_path: Path) -> None:
    assert homes(tmp_path, stay(1, 0, 100, waited=False), stay(2, 100, 110)) == ['Second']


def test_node_that_nobody_ran_belongs_to_its_last_executor(tmp_path: Path) -> None:
    never = {'waited': False}
    assert homes(tmp_path, stay(1, 0, 100, **never), stay(2, 100, 110, **never)) == ['Second']


def test_node_in_no_executor_gives_no_unit(tmp_path: Path) -> None:
    assert homes(tmp_path) == []


def test_equal_names_of_two_nodes_are_told_apart(tmp_path: Path) -> None:
    recorded = recording(
        tmp_path,
        executors=[executor(1)],
        nodes=[node(2, 'left', stay(1, 0, None)), node(3, 'right', stay(1, 0, None))],
        groups=[group(4, node=2, default=True), group(5, node=3, default=True)],
        entities=[timer(6, 2, 4, 'arm.Arm.tick'), timer(7, 3, 5, 'arm.Arm.tick')],
    )
    (spec,) = specs_of(recorded)
    assert [callback.name for callback in spec.callbacks] == ['left_tick', 'right_tick']
    assert [each.name for each in spec.groups] == ['left_default', 'right_default']


def test_thread_count_that_could_not_be_read_is_unknown(tmp_path: Path) -> None:
    recorded = recording(
        tmp_path,
        executors=[executor(1, threads=None)],
        nodes=[node(2, 'arm', stay(1, 0, None))],
    )
    (spec,) = specs_of(recorded)
    assert spec.executor.threads == ('thread_0',)
    assert spec.executor.unresolved == Unknown(
        'thread count could not be read', Place('arm.py', 50, 5)
    )
