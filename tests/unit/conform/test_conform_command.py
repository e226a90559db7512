"""``ros2cc-extract conform`` on traces written by hand, one event each 30 ms."""

from __future__ import annotations

import io
import json
from pathlib import Path

import pytest

from ros2cc_extract.cli.main import main

SPEC = """\
ros2cc: {spec_version: 1, origin: manual}
node:
  name: arm
  callbacks:
    - {name: on_joint, type: SUB, entity: subscription, callback_group: g, node: arm,
       callback: Arm.on_joint, topic: joints, defined: 'arm.py:60:5'}
    - {name: on_tick, type: TMR, entity: timer, callback_group: g, node: arm,
       callback: Arm.on_tick, defined: 'arm.py:70:5'}
  callback_groups:
    - {name: g, type: EXCLUSIVE}
  executor: {name: executor, kind: MultiThreadedExecutor, threads: [{name: t0}, {name: t1}]}
"""
NOWHERE = {'node': None, 'executor': None, 'group': None, 'key': None}
SUBJECTS = {
    1: {'kind': 'executor', **NOWHERE, 'threads': 2},
    2: {'kind': 'subscription', 'node': 'arm', 'executor': 1, 'group': 9, 'key': 'joints'},
    3: {'kind': 'timer', 'node': 'arm', 'executor': 1, 'group': 9, 'key': None},
    4: {'kind': 'timer', 'node': 'arm', 'executor': 1, 'group': 9, 'key': None},
}
NAMES = {1: 'MultiThreadedExecutor', 2: 'arm.Arm.on_joint', 3: 'arm.Arm.on_tick', 4: 'arm.late'}
# Both members of the group are queued; the second is refused, found again, and runs.
GOOD = """
    spin wait> 1, spin wait< 1, spin collect 3, spin collect 2, a begin 3, a take 3, b refused 2,
    a end 3, spin wait> 1, spin wait< 1, spin collect 2, b begin 2, b take 2, b end 2
"""
#: More than what steps of two threads may be out of order.
SPACING_NS = 30_000_000
THREADS = {'spin': 100, 'a': 101, 'b': 102}


def conform(
    events: str, folder: Path, *options: str, spec: str = SPEC, spacing_ns: int = SPACING_NS
) -> tuple[int, str, str]:
    """Write the trace and the specification, and give status, output and messages."""
    trace, unit = folder / 'run.jsonl', folder / 'arm.yaml'
    trace.write_text(''.join(f'{line}\n' for line in trace_lines(events, spacing_ns)))
    unit.write_text(spec)
    stdout, stderr = io.StringIO(), io.StringIO()
    status = main(['conform', str(trace), str(unit), *options], stdout, stderr)
    return status, stdout.getvalue(), stderr.getvalue()


def trace_lines(events: str = GOOD, spacing_ns: int = SPACING_NS) -> list[str]:
    """What a recorder would write of these events."""
    lines: list[dict[str, object]] = [
        {
            'format': 'ros2cc trace',
            'version': 1,
            'process': 7,
            'rclpy': '7.1.6',
            'lost': 0,
            'threads': {str(number): name for name, number in THREADS.items()},
        }
    ]
    lines += [
        {'process': 7, 'entity': number, 'name': NAMES[number], **values}
        for number, values in SUBJECTS.items()
    ]
    for number, event in enumerate(events.replace('\n', ' ').split(',')):
        thread, name, entity = event.split()
        at = {'clock_ns': number * spacing_ns, 'thread': THREADS[thread]}
        lines.append({'process': 7, **at, 'event': name, 'entity': int(entity)})
    return list(map(json.dumps, lines))


def test_an_execution_of_the_model_conforms(tmp_path: Path) -> None:
    told = 'arm: conforms: all 10 events are a path of the model\n'
    assert conform(GOOD, tmp_path) == (0, told, '')


def test_a_divergence_is_told_with_what_the_model_would_have_allowed(tmp_path: Path) -> None:
    status, told, _ = conform(GOOD.replace('b refused 2', 'b begin 2'), tmp_path)
    assert status == 1
    assert told == (
        'arm: diverges after 4 of 10 events\n'
        '         0.000 ms  spin: the executor wakes up and finds on_joint (arm.py:60:5), '
        'on_tick (arm.py:70:5)\n'
        '        30.000 ms  spin: the executor collects on_tick (arm.py:70:5)\n'
        '        60.000 ms  spin: the executor collects on_joint (arm.py:60:5)\n'
        '        90.000 ms  a: on_tick (arm.py:70:5) starts\n'
        '  >    150.000 ms  b: on_joint (arm.py:60:5) starts\n'
        '  before it the model can be here:\n'
        '    - the executor serves what it has found; t0 runs on_tick; queued: on_joint; '
        'closed groups: g; has arrived: on_joint\n'
        '    - the executor waits; t0 runs on_tick; queued: on_joint; closed groups: g; '
        'has arrived: on_joint\n'
        '    - the executor serves what it has found; t0 is about to start on_joint; t1 runs '
        'on_tick; closed groups: g; has arrived: on_joint\n'
        '    - the executor waits; t0 is about to start on_joint; t1 runs on_tick; closed '
        'groups: g; has arrived: on_joint\n'
        '  and would have allowed:\n'
        '    - on_tick (arm.py:70:5) ends\n'
        '    - on_joint (arm.py:60:5) is refused\n'
    )


def test_steps_of_two_threads_may_stand_in_another_order(tmp_path: Path) -> None:
    late = GOOD.replace('a begin 3, a take 3, b refused 2', 'b refused 2, a begin 3, a take 3')
    assert conform(late, tmp_path)[0] == 1
    told = (
        'arm: conforms only with a reordering of 0.1 ms: all 10 events are a path of the model\n'
    )
    assert conform(late, tmp_path, spacing_ns=100_000) == (0, told, '')


@pytest.mark.parametrize('spacing_ns', [1_000, SPACING_NS])
def test_runs_in_an_exclusive_group_never_overlap(spacing_ns: int, tmp_path: Path) -> None:
    """Their order by the clock is that of the group, however near they are."""
    overlapping = """
        spin wait> 1, spin wait< 1, spin collect 3, spin collect 2, a begin 3, a take 3,
        b begin 2, b take 2, a end 3, b end 2
    """
    status, told, _ = conform(overlapping, tmp_path, spacing_ns=spacing_ns)
    assert (status, told.splitlines()[0]) == (1, 'arm: diverges after 4 of 7 events')
    reentrant = SPEC.replace('type: EXCLUSIVE', 'type: REENTRANT')
    status, told, _ = conform(overlapping, tmp_path, spec=reentrant, spacing_ns=spacing_ns)
    assert (status, told) == (0, 'arm: conforms: all 7 events are a path of the model\n')


def test_a_limit_leaves_the_question_open(tmp_path: Path) -> None:
    status, told, _ = conform(GOOD, tmp_path, '--max-states', '3')
    assert (status, told) == (3, 'arm: undecided: 4 states looked at, 10 events\n')


def test_what_ran_and_is_not_in_the_specification_is_told(tmp_path: Path) -> None:
    status, told, _ = conform(f'{GOOD}, a begin 4, a end 4', tmp_path)
    lacking = '  not in the specification, but it ran: arm.late\n'
    assert (status, told.splitlines(keepends=True)[1:]) == (0, [lacking])


def test_a_specification_of_another_program_is_refused(tmp_path: Path) -> None:
    other = SPEC.replace('node: arm,', 'node: leg,')
    status, told, message = conform(GOOD, tmp_path, spec=other)
    assert (status, told) == (2, '')
    assert message.endswith('give the specification of the program that was recorded\n')


def test_something_else_than_a_trace_is_refused(tmp_path: Path) -> None:
    (tmp_path / 'run.jsonl').write_text('no trace\n')
    (tmp_path / 'arm.yaml').write_text(SPEC)
    paths = [str(tmp_path / name) for name in ('run.jsonl', 'arm.yaml')]
    stderr = io.StringIO()
    assert main(['conform', *paths], io.StringIO(), stderr) == 2
    assert 'run.jsonl:1: is no line of a trace; record it with' in stderr.getvalue()


AWAITING = """
    spin wait> 1, spin wait< 1, spin collect 3, a begin 3, a take 3, a suspend 3,
    a resume 3, a end 3
"""
COROUTINE = SPEC.replace('callback: Arm.on_tick,', 'callback: Arm.on_tick, coroutine: true,')


def test_what_a_coroutine_awaits_is_asked_for_where_nobody_tells(tmp_path: Path) -> None:
    status, told, _ = conform(AWAITING, tmp_path, spec=COROUTINE)
    lines = told.splitlines()
    assert (status, lines[0]) == (3, 'arm: undecided after 3 of 6 events')
    assert lines[-1] == (
        '  the specification does not say what it awaits: on_tick; a live run cannot see it, so '
        'give the source, or what merge makes of both'
    )


def test_a_coroutine_whose_await_is_told_is_judged(tmp_path: Path) -> None:
    told_await = 'coroutine: true, blocking: [{call: await, waits_for: on_joint}],'
    spec = COROUTINE.replace('coroutine: true,', told_await)
    status, told, _ = conform(AWAITING, tmp_path, spec=spec)
    assert (status, told.splitlines()[0]) == (1, 'arm: diverges after 4 of 6 events')


#: A timer's callback spins its executor, which serves a subscription inside it.
SPINNING = """
    spin wait> 1, spin wait< 1, spin collect 3, spin begin 3, spin take 3,
    spin wait> 1, spin wait< 1, spin collect 2, spin begin 2, spin take 2, spin end 2, spin end 3
"""
ONE_THREAD = SPEC.replace('MultiThreadedExecutor', 'SingleThreadedExecutor').replace(
    ', {name: t1}', ''
)


def test_that_a_callback_spins_is_asked_for_where_nobody_tells(tmp_path: Path) -> None:
    status, told, _ = conform(SPINNING, tmp_path, spec=ONE_THREAD)
    lines = told.splitlines()
    assert (status, lines[0]) == (3, 'arm: undecided after 3 of 8 events')
    assert lines[-1] == (
        '  the specification does not say that it spins: on_tick; a live run cannot see it, so '
        'give the source, or what merge makes of both'
    )


def test_a_nested_spin_that_is_told_is_judged(tmp_path: Path) -> None:
    spin = "blocking: [{call: executor.spin_once, waits_for: executor, source: 'arm.py:71:9'}],"
    spec = ONE_THREAD.replace('callback: Arm.on_tick,', f'callback: Arm.on_tick, {spin}')
    status, told, _ = conform(SPINNING, tmp_path, spec=spec)
    assert (status, told.splitlines()[0]) == (1, 'arm: diverges after 3 of 8 events')
    reentrant = spec.replace('EXCLUSIVE', 'REENTRANT')
    status, told, _ = conform(SPINNING, tmp_path, spec=reentrant)
    assert (status, told) == (0, 'arm: conforms: all 8 events are a path of the model\n')


def test_a_group_that_nobody_knows_leaves_the_question_open(tmp_path: Path) -> None:
    unknown = SPEC.replace(
        'type: EXCLUSIVE}', "type: EXCLUSIVE, resolved: false, reason: 'a parameter'}"
    )
    status, told, _ = conform(GOOD.replace('b refused 2', 'b begin 2'), tmp_path, spec=unknown)
    lines = told.splitlines()
    assert (status, lines[0]) == (3, 'arm: undecided after 4 of 10 events')
    assert lines[-1] == '  the specification does not say of which type it is: g'


def test_as_many_threads_as_cpus_are_as_many_as_the_trace_says(tmp_path: Path) -> None:
    of_cpus = ONE_THREAD.replace('Single', 'Multi').replace(
        '{name: t0}]', '{name: t0}], threads_source: default_cpu_count'
    )
    both = """
        spin wait> 1, spin wait< 1, spin collect 3, spin collect 2, a begin 3, a take 3,
        b begin 2, b take 2, b end 2, a end 3
    """
    spec = of_cpus.replace('EXCLUSIVE', 'REENTRANT')
    assert conform(both, tmp_path, spec=spec)[0] == 0
    assert conform(both, tmp_path, spec=spec.replace('default_cpu_count', 'given'))[0] == 1
