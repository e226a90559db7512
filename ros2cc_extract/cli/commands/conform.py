"""``ros2cc-extract conform``: whether a recorded execution is a path of the model."""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from ros2cc_extract.cli.shared.exit_status import EXIT_CLEAN, EXIT_FINDINGS, EXIT_UNDECIDED

if TYPE_CHECKING:
    from ros2cc_extract.conform.observations import Observation
    from ros2cc_extract.conform.search import Answer
    from ros2cc_extract.conform.trace import Trace
    from ros2cc_extract.conform.unit import Comparison
    from ros2cc_extract.spec.model import Spec

EVENTS_SHOWN = 12
STATES_SHOWN = 4
ALLOWED_SHOWN = 12


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.epilog = (
        'Exit status: 0 it is a path of the model; 1 it is not; 2 input error; 3 undecided: a '
        'limit '
        'was\nhit, or the specification says too little.'
    )
    parser.add_argument(
        'trace', type=Path, metavar='TRACE', help='what `run --trace` wrote (JSON lines)'
    )
    parser.add_argument(
        'spec',
        type=Path,
        metavar='SPEC',
        help='a YAML specification (- for standard input), or Python source',
    )
    parser.add_argument(
        '--events',
        type=int,
        default=EVENTS_SHOWN,
        metavar='N',
        help='show N events before the divergence (default %(default)s)',
    )
    parser.add_argument('--max-states', type=int, metavar='N', help='stop after about N states')


def run(args: argparse.Namespace, stdout: TextIO, stderr: TextIO) -> int:
    from ros2cc_extract.cli.shared.releases import report_releases
    from ros2cc_extract.conform.search import STATES
    from ros2cc_extract.conform.trace import read_traces
    from ros2cc_extract.conform.unit import compare, pair_units
    from ros2cc_extract.errors import InputError
    from ros2cc_extract.pipeline.sources import load_units
    from ros2cc_extract.source_locations import Place
    from ros2cc_extract.text_escaping import one_line

    traces = read_traces(args.trace)
    report_releases((trace.rclpy for trace in traces), stderr)
    units = load_units(args.spec, stderr)
    pairs = list(pair_units(traces, units))
    if not pairs:
        mend = 'give the specification of the program that was recorded'
        raise InputError(f'no node of {args.spec} is in it', Place(str(args.trace)), mend)
    statuses = []
    for trace, executor, spec in pairs:
        comparison = compare(trace, executor, spec, states=args.max_states or STATES)
        stdout.writelines(f'{one_line(line)}\n' for line in _lines(comparison, trace, args.events))
        statuses.append(_status(comparison))
    return max(statuses, key=(EXIT_CLEAN, EXIT_UNDECIDED, EXIT_FINDINGS).index)


def _status(comparison: Comparison) -> int:
    from ros2cc_extract.conform.search import Outcome

    if comparison.answer.outcome is Outcome.CONFORMS:
        return EXIT_CLEAN
    is_open = comparison.answer.outcome is Outcome.UNDECIDED or comparison.is_gap
    return EXIT_UNDECIDED if is_open else EXIT_FINDINGS


def _lines(comparison: Comparison, trace: Trace, shown: int) -> Iterator[str]:
    from ros2cc_extract.conform.search import Outcome

    answer, spec = comparison.answer, comparison.unit.spec
    events = len(comparison.observations)
    if answer.outcome is Outcome.CONFORMS:
        how = _reordering(answer)
        yield f'{spec.name}: conforms{how}: all {events} events are a path of the model'
    elif answer.outcome is Outcome.UNDECIDED:
        yield f'{spec.name}: undecided: {answer.seen} states looked at, {events} events'
    else:
        verdict = 'undecided' if comparison.is_gap else 'diverges'
        yield f'{spec.name}: {verdict} after {answer.steps} of {events} events'
        yield from _divergence(comparison, trace, shown)
        yield from (f'  {gap}' for gap in comparison.gaps)
    for lacking in comparison.lacking:
        yield f'  not in the specification, but it ran: {lacking}'
    if trace.lost:
        yield f'  the trace has {trace.lost} gaps: events came faster than they could be kept'


def _reordering(answer: Answer) -> str:
    moved_ms = answer.reordered_ns / 1e6
    return f' only with a reordering of {moved_ms:.3g} ms' if moved_ms else ''


def _divergence(comparison: Comparison, trace: Trace, shown: int) -> Iterator[str]:
    from ros2cc_extract.conform.wording import say_allowed, say_state

    answer, spec, model = comparison.answer, comparison.unit.spec, comparison.model
    begun = comparison.observations[0].clock_ns
    before = answer.path[-shown:] if shown else ()
    if len(answer.path) > len(before):
        yield f'    … {len(answer.path) - len(before)} events'
    for observation in before:
        yield f'    {_event(observation, begun, trace, spec)}'
    if answer.next is not None:
        yield f'  > {_event(answer.next, begun, trace, spec)}'
    yield '  before it the model can be here:'
    yield from _shortened([say_state(model, s, spec) for s in answer.states], STATES_SHOWN)
    yield '  and would have allowed:'
    yield from _shortened(say_allowed(model, answer.states, spec), ALLOWED_SHOWN)


def _event(observation: Observation, begun_ns: int, trace: Trace, spec: Spec) -> str:
    from ros2cc_extract.conform.wording import say_observation

    time_ms = (observation.clock_ns - begun_ns) / 1e6
    thread = trace.threads.get(observation.thread, str(observation.thread))
    return f'{time_ms:10.3f} ms  {thread}: {say_observation(observation, spec)}'


def _shortened(lines: Sequence[str], most: int) -> Iterator[str]:
    for line in lines[:most]:
        yield f'    - {line}'
    if len(lines) > most:
        yield f'    … {len(lines) - most} more'
