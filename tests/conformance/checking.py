"""Compares what random programs did with their models, and sums it up."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from ros2cc_extract.conform.arrivals import Arrival
from ros2cc_extract.conform.search import Outcome
from ros2cc_extract.conform.trace import Trace, read_traces
from ros2cc_extract.conform.unit import Comparison, compare
from tests.conformance.programs import draw
from tests.conformance.units import spec_of


@dataclass(frozen=True)
class Ran:
    """A program that was run: its seed, when it was over, and what arrived."""

    seed: int
    ended_ns: int
    arrivals: tuple[Arrival, ...] = ()


def read_ran(path: Path) -> list[Ran]:
    rows = (json.loads(line) for line in path.read_text().splitlines())
    return [
        Ran(row['seed'], row['ended'], tuple(_arrivals(row.get('arrivals', ())))) for row in rows
    ]


def _arrivals(rows: Sequence[Sequence[int]]) -> Iterator[Arrival]:
    threads = list(dict.fromkeys(thread for _, thread, _, _ in rows))
    for number, thread, earliest_ns, latest_ns in rows:
        yield Arrival(
            callback=f'c{number}',
            thread=threads.index(thread),
            earliest_ns=earliest_ns,
            latest_ns=latest_ns,
        )


def compare_all(trace_file: Path, ran: list[Ran]) -> Iterator[tuple[Ran, Comparison]]:
    (trace,) = read_traces(trace_file)
    for each in ran:
        yield each, compare_one(trace, each)


def delayed(ran: Ran) -> Ran:
    """
    The same where what was handed over may have been on its way until it was served.

    Fast DDS hands it to threads of its own, which a busy machine keeps waiting.
    """
    return replace(ran, arrivals=tuple(replace(each, latest_ns=None) for each in ran.arrivals))


def compare_in_time(trace: Trace, ran: Ran) -> tuple[Comparison, bool]:
    """Compare as if all had arrived at once, and if that fails, some time later: say which."""
    found = compare_one(trace, ran)
    if ran.arrivals and found.answer.outcome is Outcome.DIVERGES:
        return compare_one(trace, delayed(ran)), True
    return found, False


def compare_one(trace: Trace, ran: Ran, edit: Callable[[str], str] = str) -> Comparison:
    program = draw(ran.seed)
    executors = {
        subject.executor
        for subject in trace.subjects.values()
        if subject.node == program.node_name(0) and subject.executor is not None
    }
    (executor,) = executors
    return compare(
        trace,
        executor,
        spec_of(program),
        until_ns=ran.ended_ns,
        edit=edit,
        arrivals=ran.arrivals,
    )
