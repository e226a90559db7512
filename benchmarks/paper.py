"""
Reproduce the publication with our own tools and write ``docs/paper.md``.

    make paper          # or: python benchmarks/paper.py [--without-live | --growth]

Shin et al., "Modeling and Verification of ROS 2 Callback Concurrency Using UPPAAL Model Checker",
IJSEKE 2026, DOI 10.1142/S0218194026500439. Verdicts and costs are measured by this program; the
published figures stand beside them. The logs come from the example nodes under real rclpy (the
interpreter named by ROS2CC_RCLPY_PYTHON). Spin's figures are left out where it is not installed.
"""

from __future__ import annotations

import argparse
import os
import platform
import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import checker
import spin_rate
from growth import Series, draw_growth
from published import CALLBACKS, COSTS, THREADS, VERDICTS

from ros2cc_extract.checker.api import Limits, Query, Verdict, check, read_model
from ros2cc_extract.extract.static.api import scan
from ros2cc_extract.generator import build
from ros2cc_extract.generator.build import Text
from ros2cc_extract.spec.close import Policy, close
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    CallbackType,
    Executor,
    GroupType,
    Spec,
)
from ros2cc_extract.verify.results.evidence import Evidence
from ros2cc_extract.verify.results.results import QueryResult, Verification
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.unit import verify_unit

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / 'docs' / 'paper.md'
PICTURE = ROOT / 'docs' / 'images' / 'growth.svg'
CASES = {1: 'paper_case1', 2: 'paper_case2', 3: 'paper_case3'}
NAMES = {'on_timer_a': 'TMR1', 'on_timer_b': 'TMR2', 'on_msg_c': 'SUB1', 'on_msg_d': 'SUB2'}
SIGNS = {Verdict.SATISFIED: 'yes', Verdict.NOT_SATISFIED: '**no**', Verdict.UNDECIDED: '?'}
TIME_SCALE = 0.1
LIVE_SECONDS = 2.5
PLAIN_LIMIT_S = 60.0
GROWTH_TITLE = '## Growth'
FULL_SEARCHES = (1, 2, 3, 4)
"""Sizes n x n whose full plain text fits in memory; 4 x 4 has 40 million states."""


@dataclass(frozen=True)
class Case:
    """One of the three published cases, verified by both texts."""

    number: int
    compact: Verification
    plain: Verification


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--without-live', action='store_true', help='leave the rclpy logs out')
    parser.add_argument('--growth', action='store_true', help='renew the section on growth alone')
    options = parser.parse_args()
    if options.growth:
        return renew_growth()
    cases = [verify_case(number) for number in CASES]
    started = time.monotonic()
    cells = dict(measure_cells())
    seconds = time.monotonic() - started
    growth = growth_series()
    PICTURE.write_text(draw_growth(growth), encoding='utf-8')
    sections = [
        introduction(),
        query_section(cases),
        case_section(cases),
        behaviour_section(cases, live=not options.without_live),
        cost_section(cells, seconds),
        growth_section(growth),
    ]
    PAGE.write_text('\n'.join(sections), encoding='utf-8')
    print(f'wrote {PAGE.relative_to(ROOT)} and {PICTURE.relative_to(ROOT)}')
    return 0


def renew_growth() -> int:
    growth = growth_series()
    PICTURE.write_text(draw_growth(growth), encoding='utf-8')
    before = PAGE.read_text(encoding='utf-8').partition(GROWTH_TITLE)[0]
    PAGE.write_text(before + growth_section(growth), encoding='utf-8')
    return 0


def verify_case(number: int) -> Case:
    folder = ROOT / 'launch_free_examples' / CASES[number]
    (unit,) = scan([folder / 'node.py'], root=folder).units
    closed = close(unit)
    return Case(
        number,
        verify_unit(closed, Options(text=Text.COMPACT)),
        verify_unit(closed, Options(text=Text.PLAIN, limits=Limits(seconds=PLAIN_LIMIT_S))),
    )


Cell = tuple[int, int, GroupType]


def measure_cells() -> Iterator[tuple[Cell, Verification]]:
    """Verify every cell of the published cost table, all query families, compact text."""
    options = Options(text=Text.COMPACT)
    for kind in (GroupType.EXCLUSIVE, GroupType.REENTRANT):
        for threads in THREADS:
            for callbacks in CALLBACKS:
                closed = close(square(callbacks, threads, kind), Policy())
                yield (callbacks, threads, kind), verify_unit(closed, options)


def square(callbacks: int, threads: int, kind: GroupType) -> Spec:
    """One group with ``callbacks`` subscriptions, as the cost table has it."""
    return Spec(
        name='cost',
        callbacks=tuple(
            Callback(name=f'SUB{i}', type=CallbackType.SUB, group='G')
            for i in range(1, callbacks + 1)
        ),
        groups=(CallbackGroup(name='G', type=kind),),
        executor=Executor(name='executor', threads=tuple(f't{i}' for i in range(threads))),
    )


def introduction() -> str:
    return f"""# The publication, reproduced

`make paper` writes this page. The three cases are the nodes in `launch_free_examples/`, scanned
from source; models, verdicts, runs, times and logs below are what our tools gave on
{platform.machine()}, {os.cpu_count()} cores, Python {platform.python_version()}.
Published figures: Shin et al., IJSEKE 2026, DOI 10.1142/S0218194026500439.
"""


def query_section(cases: Sequence[Case]) -> str:
    """The 29 queries of the paper, whose table has "always open" per callback, not per group."""
    lines = [
        '## Queries and verdicts',
        '',
        'The paper counts 29 queries: its table asks "group always open" once per callback, its',
        'generator once per group, as we do (26); the 29 verdicts follow.',
        '',
        '| # | query | expression | C1 | C2 | C3 | published |',
        '|---|---|---|---|---|---|---|',
    ]
    rows = list(zip(*(published_rows(case.compact) for case in cases), strict=True))
    for index, (row, published) in enumerate(zip(rows, VERDICTS, strict=True), start=1):
        found = [result.verdict is Verdict.SATISFIED for result in row]
        agrees = 'same' if found == list(published) else f'**{published}**'
        signs = ' | '.join(SIGNS[result.verdict] for result in row)
        lines.append(f'| {index} | {words(row[0])} | `{row[0].formula}` | {signs} | {agrees} |')
    return '\n'.join([*lines, ''])


def published_rows(verification: Verification) -> list[QueryResult]:
    """Repeat "group always open" for each callback of the group."""
    rows: list[QueryResult] = []
    for result in verification.results:
        rows.extend([result] * (4 if result.family == 'group_always_open' else 1))
    return rows


def words(result: QueryResult) -> str:
    text = re.sub(r'group \w+ is', 'the group is', result.words)
    for name, short in NAMES.items():
        text = text.replace(name, short)
    return text


def case_section(cases: Sequence[Case]) -> str:
    lines = [
        '## Cost of the three cases',
        '',
        'All 26 queries at once, default reductions, seconds of the search. UPPAAL as published:',
        'Q1 alone in 0.04 s, 0.5 s and 90 s, C3 with 4.5 GB.',
        '',
        '| case | text | states | transitions | seconds | peak MB |',
        '|---|---|---|---|---|---|',
    ]
    for case in cases:
        for text, found in (('plain', case.plain), ('compact', case.compact)):
            lines.append(
                f'| C{case.number} | {text}, {found.engine} | {found.states:,} | '
                f'{found.transitions:,} | {found.seconds:.3f} | {found.peak_mb:.0f} |'
            )
    return '\n'.join([*lines, ''])


@dataclass(frozen=True)
class Behaviour:
    """One of the four behaviours: the run that shows it and the log beside it."""

    title: str
    case: int
    family: str
    callbacks: tuple[str, ...]
    remark: str


BEHAVIOURS = (
    Behaviour(
        'Round robin on one thread',
        1,
        'starvation',
        ('on_msg_d',),
        'So there is no run against it; the log shows both subscriptions in turn.',
    ),
    Behaviour(
        'Starvation in an exclusive group',
        2,
        'starvation',
        ('on_msg_d',),
        'The run shows SUB2 seen ready and never run; the log shows SUB1 again and again.',
    ),
    Behaviour(
        'A busy thread is no harm to the others',
        3,
        'can_overlap',
        ('on_msg_c', 'on_msg_d'),
        'One thread works on SUB1 while another takes SUB2.',
    ),
    Behaviour(
        'No starvation in a reentrant group',
        3,
        'starvation',
        ('on_msg_d',),
        'So there is no run against it; the log shows it served every time.',
    ),
)


def behaviour_section(cases: Sequence[Case], *, live: bool) -> str:
    lines = ['## Four behaviours, in the model and under real rclpy', '']
    logs = {number: live_log(number) if live else [] for number in CASES}
    for behaviour in BEHAVIOURS:
        verification = cases[behaviour.case - 1].compact
        result = next(
            r
            for r in verification.results
            if r.family == behaviour.family and r.callbacks == behaviour.callbacks
        )
        lines += [
            f'### {behaviour.title} (case {behaviour.case})',
            '',
            f'{words(result)}: **{result.verdict.value}**. {behaviour.remark}',
            '',
            '```',
            *(told(result.evidence) if result.evidence else ['(no run against it exists)']),
            '```',
            '',
        ]
        if logs[behaviour.case]:
            lines += [f'Log under rclpy, one unit = {TIME_SCALE} s:', '', '```']
            lines += [*logs[behaviour.case], '```', '']
    return '\n'.join(lines)


def told(evidence: Evidence) -> Iterator[str]:
    for moment in evidence.moments:
        if moment.number == evidence.cycle_from:
            yield '    and then for ever:'
        text = '; '.join(sentence.text for sentence in moment.sentences)
        for name, short in NAMES.items():
            text = text.replace(name, short)
        yield f'{moment.number:3} {text}'


LOG_LINE = re.compile(r'\[(\d+\.\d+)\].*: (timer [AB]|msg_[CD] (?:begins|ends))')


def live_log(number: int) -> list[str]:
    """Run a case with its publisher; time in units since its first line."""
    python = os.environ.get('ROS2CC_RCLPY_PYTHON', sys.executable)
    node = ROOT / 'launch_free_examples' / CASES[number] / 'node.py'
    command = [python, str(node), '--with-publisher', '--seconds', str(LIVE_SECONDS)]
    command += ['--ros-args', '-p', f'time_scale:={TIME_SCALE}']
    environment = {
        **os.environ,
        'ROS_DOMAIN_ID': str(60 + number),
        'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST',
    }
    process = subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env=environment, text=True
    )
    try:
        output, _ = process.communicate(timeout=60)
    except subprocess.TimeoutExpired:
        process.send_signal(signal.SIGKILL)
        output, _ = process.communicate()
    events = [(float(m.group(1)), m.group(2)) for m in LOG_LINE.finditer(output)]
    messages = [event for event in events if 'msg' in event[1]]
    first = messages[0][0] if messages else 0.0
    return [f'[{(at - first) / TIME_SCALE:6.2f}] {what}' for at, what in messages[:14]]


def cost_section(cells: dict[Cell, Verification], seconds: float) -> str:
    lines = [
        '## Cost by callbacks and threads',
        '',
        'Seconds: here, all query families on the compact text / published, Q1 alone. All 50',
        f'cells together took {seconds:.2f} s here, rendering and parsing included.',
        '',
    ]
    for kind in (GroupType.EXCLUSIVE, GroupType.REENTRANT):
        lines += [f'**{kind.value.lower()}**', '']
        lines += [
            '| threads | ' + ' | '.join(f'{n} callbacks' for n in CALLBACKS) + ' |',
            '|---' * (len(CALLBACKS) + 1) + '|',
        ]
        for threads in THREADS:
            shown = (
                f'{cells[c, threads, kind].seconds:.3f} / {published_cost(c, threads, kind)}'
                for c in CALLBACKS
            )
            lines.append(f'| {threads} | ' + ' | '.join(shown) + ' |')
        lines.append('')
    return '\n'.join(lines)


def published_cost(callbacks: int, threads: int, kind: GroupType) -> str:
    cost = COSTS[threads][callbacks - 1][kind is GroupType.REENTRANT]
    return 'not finished' if cost is None else f'{cost}'


def growth_series() -> list[Series]:
    """CPU seconds along the diagonal of the reentrant table: n callbacks on n threads."""
    full = [search(n, Text.PLAIN, reduction=False, all_queries=False) for n in FULL_SEARCHES]
    plain = [search(n, Text.PLAIN, reduction=True, all_queries=True) for n in CALLBACKS]
    compact = [search(n, Text.COMPACT, reduction=False, all_queries=True) for n in CALLBACKS]
    series = [
        Series('UPPAAL, as published (Q1)', [COSTS[n][n - 1][1] for n in CALLBACKS]),
        Series('ours, plain text, no reduction (Q1)', [run.seconds for run in full]),
        Series('ours, plain text (all queries)', [run.seconds for run in plain]),
        Series('ours, compact text (all queries)', [run.seconds for run in compact]),
    ]
    if spin_rate.missing() is None:
        runs = [spin_rate.fastest(n, n, exclusive=False) for n in FULL_SEARCHES]
        agree = [run.states for run in runs] == [run.states for run in full]
        assert agree, 'Spin and the embedded checker search different models'
        series.insert(1, Series('Spin, plain text (Q1)', [run.seconds for run in runs]))
    return series


@dataclass(frozen=True)
class Search:
    """States, and CPU seconds; ``None`` when a limit ended it."""

    states: int
    seconds: float | None


def search(size: int, text: Text, *, reduction: bool, all_queries: bool) -> Search:
    """Check ``size`` callbacks of a reentrant group on as many threads, within a time limit."""
    row = checker.Row('', size, size, 'reentrant', text.value, reduction, '')
    rendered = build.render(close(checker.unit(row)), text=text)
    model = read_model(rendered.xml, 'model.xml')
    queries = [Query(query.formula, '', None) for query in rendered.queries]
    started = time.process_time()
    found = check(
        model,
        queries if all_queries else queries[:1],
        reduction=reduction,
        limits=Limits(seconds=PLAIN_LIMIT_S),
    )
    seconds = time.process_time() - started
    return Search(found.states, seconds if found.complete else None)


def growth_section(growth: Sequence[Series]) -> str:
    lines = [
        GROWTH_TITLE,
        '',
        'CPU seconds for n callbacks in one reentrant group on n threads. Q1 asks for deadlocks;',
        'every search of the plain text without reduction stores the same states. An empty cell',
        'did not finish, or was not tried as it would need more memory than a desktop has.',
        '',
        '| | ' + ' | '.join(f'{n} x {n}' for n in CALLBACKS) + ' |',
        '|---' * (len(CALLBACKS) + 1) + '|',
    ]
    for series in growth:
        cells = [f'{s:.3f}' if s is not None else '' for s in series.seconds]
        cells += [''] * (len(CALLBACKS) - len(cells))
        lines.append(f'| {series.label} | ' + ' | '.join(cells) + ' |')
    lines += ['', *spin_lines(), '']
    lines += ['![growth of cost with callbacks and threads](images/growth.svg)', '']
    return '\n'.join(lines)


def spin_lines() -> list[str]:
    """States a second of both programs on the case that both hold with ease."""
    if reason := spin_rate.missing():
        return [f'Spin: {reason}.']
    row = checker.Row('', 4, 3, 'reentrant', 'plain', False, '', all_families=False)
    ours = min((checker.measure(row) for _ in spin_rate.HASH_BITS), key=lambda run: run.cpu_s)
    spin = spin_rate.fastest(4, 3, exclusive=False)
    return [
        f'4 callbacks on 3 threads, {ours.states:,} states, one core: ours',
        f'{ours.states / ours.cpu_s / 1e6:.1f} million states/s, Spin'
        f' {spin.states / spin.seconds / 1e6:.1f} million (`benchmarks/spin_rate.py`; the best of',
        'three runs each, Spin with three sizes of its hash table; its compiling not counted).',
    ]


if __name__ == '__main__':
    sys.exit(main())
