"""Tasks, which are in no group: done-callbacks, execute callbacks of actions, ``create_task``."""

from __future__ import annotations

from dataclasses import replace

import pytest

from ros2cc_extract.checker.api import Verdict, check, read_model
from ros2cc_extract.generator.build import Freedom, Profile, Text, render
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.close import ClosedSpec, close
from ros2cc_extract.spec.model import (
    Blocking,
    Callback,
    CallbackGroup,
    EntityKind,
    Executor,
    GroupType,
    Spec,
)

SPIN = Blocking(
    call='executor.spin_until_future_complete', on='executor', source=Place('node.py', 1)
)


def unit(
    *callbacks: Callback, threads: int = 2, kind: GroupType = GroupType.EXCLUSIVE
) -> ClosedSpec:
    return close(
        Spec(
            name='unit',
            callbacks=callbacks,
            groups=(CallbackGroup(name='g', type=kind),),
            executor=Executor(
                name='executor',
                kind='MultiThreadedExecutor',
                threads=tuple(f't{number}' for number in range(threads)),
            ),
        )
    )


def entity(name: str, kind: EntityKind, *blocking: Blocking) -> Callback:
    return Callback(name=name, type=kind.published_type, entity=kind, group='g', blocking=blocking)


def verdicts(
    closed: ClosedSpec, text: Text = Text.COMPACT, freedom: Freedom | None = None
) -> dict[str, Verdict]:
    model = render(closed, profile=Profile.RCLPY, text=text, freedom=freedom)
    result = check(read_model(model.xml, 'unit.xml'), read_model(model.xml, 'unit.xml').queries)
    return {answer.query.comment: answer.verdict for answer in result.answers}


MISPLACED = unit(
    entity('work', EntityKind.TASK),
    entity('tick', EntityKind.TIMER),
    entity('scan', EntityKind.SUBSCRIPTION),
)


def test_a_task_is_modelled_in_no_group_wherever_it_was_written() -> None:
    work, tick, scan = MISPLACED.spec.callbacks
    assert (work.group, work.groupless) == ('no_group', True)
    assert (tick.group, scan.group) == ('g', 'g')
    assert [(g.name, g.type, g.groupless) for g in MISPLACED.spec.groups] == [
        ('g', GroupType.EXCLUSIVE, False),
        ('no_group', GroupType.REENTRANT, True),
    ]
    assert MISPLACED.assumptions == (
        'work is a task, which is in no group; not modelled in g, where it was written',
    )


def test_both_texts_agree_on_a_task_that_was_written_into_a_group() -> None:
    plain = verdicts(MISPLACED, Text.PLAIN)
    assert plain == verdicts(MISPLACED, Text.COMPACT)
    starving = {words.partition(':')[0]: plain[words] for words in plain if 'starves' in words}
    assert starving == dict.fromkeys(
        (f'{name} never starves' for name in ('work', 'tick', 'scan')), Verdict.SATISFIED
    )


@pytest.mark.parametrize('release', ['7.1.6', '7.1.9', '9.1.2'])
@pytest.mark.parametrize('freedom', [None, Freedom(queued=2, observed=True)])
def test_tasks_that_two_threads_find_are_counted_once(
    release: str, freedom: Freedom | None
) -> None:
    """A pool that is spun by two threads hands a task over once, in the order of its making."""
    closed = unit(
        entity('work', EntityKind.TASK, SPIN),
        entity('done', EntityKind.DONE_CALLBACK),
        threads=1,
    )
    found = verdicts(replace(closed, spec=replace(closed.spec, rclpy=release)), freedom=freedom)
    assert found['done can run'] is Verdict.SATISFIED


@pytest.mark.parametrize('release', ['7.1.6', '7.1.9', '9.1.2'])
def test_tasks_are_counted_without_a_spin(release: str) -> None:
    closed = unit(
        entity('first', EntityKind.TASK),
        entity('second', EntityKind.DONE_CALLBACK),
        entity('tick', EntityKind.TIMER),
    )
    found = verdicts(replace(closed, spec=replace(closed.spec, rclpy=release)))
    assert found['there is no deadlock: all that arrives can be served'] is Verdict.SATISFIED
