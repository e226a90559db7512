"""
A stand-in for ``verifyta``: answers by the embedded checker, prints as the real one does.

Verdicts go to standard output, runs to the error stream. Layout: see ``verifyta_trace.py``.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

from ros2cc_extract.checker.api import EdgeRef, Run, StateView, Verdict, check, load_model
from ros2cc_extract.checker.api import read_queries as read

WORDS = {Verdict.SATISFIED: 'is satisfied', Verdict.NOT_SATISFIED: 'is NOT satisfied'}


def main() -> int:
    model_path, queries_path = map(Path, sys.argv[-2:])
    model = load_model(model_path)
    queries = read(queries_path.read_text(encoding='utf-8'), queries_path.name)
    print(
        'Options for the verification:\n  Generating some trace\n  Search order is breadth first'
    )
    for number, answer in enumerate(check(model, queries).answers, start=1):
        print(f'\nVerifying formula {number} at line {number}')
        print(f' -- Formula {WORDS[answer.verdict]}.')
        if answer.path is not None:
            satisfied = answer.verdict is Verdict.SATISFIED
            print(f'Showing {"example trace" if satisfied else "counter example"}.')
            sys.stderr.write('\n'.join(printed(answer.path)) + '\n')
        print(' -- States stored : 16 states\n -- Resident memory used : 6144 KiB')
    return 0


def printed(run: Run) -> Iterator[str]:
    yield from state(run.initial)
    for step in run.steps:
        yield 'Transitions:'
        yield from (f'  {edge(each)}' for each in step.edges)
        yield ''
        yield from state(step.state)


def state(view: StateView) -> Iterator[str]:
    locations = ' '.join(f'{process}.{at}' for process, at in view.locations.items())
    values = ' '.join(f'{name}={value}' for name, value in view.variables.items())
    yield from ('State:', f'( {locations} )', f'{values} #depth=0 ', '')


def edge(taken: EdgeRef) -> str:
    ends = f'{taken.process}.{taken.source}->{taken.process}.{taken.target}'
    return f'{ends} {{ 1, {taken.channel or "tau"}, 1 }}'


if __name__ == '__main__':
    sys.exit(main())
