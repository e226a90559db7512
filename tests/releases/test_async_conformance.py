"""
What nodes of asyncio did is a path of their models, step by step.

``loop_tracer.py`` records begin, await, going on and end of callbacks. Traces of 11.0.0 lie here;
on the release of the day they are recorded anew. Left out are nodes whose callbacks await what
time ends, which models pass over, or start tasks, which the tracer does not see.
"""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from ros2cc_extract.conform.search import Outcome
from ros2cc_extract.conform.trace import read_traces
from ros2cc_extract.conform.unit import compare, pair_units
from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.spec.model import GroupType, Spec
from tests.conformance.suite import own_environment
from tests.releases.test_async_nodes import FOLDER, LINES_WITH_ASYNC_NODES
from tests.releases.turns import release_of_the_day

HERE = Path(__file__).parent
TRACER = HERE / 'loop_tracer.py'
TRACES = sorted((HERE / 'loop_traces').glob('*.jsonl'))
#: Of which several runs go on at a time.
CONCURRENT = ['concurrent_topic_good', 'service_concurrent_good']
PATIENCE_S = 30.0
FEWEST = 2


def as_it_is(spec: Spec) -> Spec:
    return spec


def one_by_one(spec: Spec) -> Spec:
    """The unit as if nothing in it were concurrent."""
    groups = tuple(
        each if each.groupless else replace(each, type=GroupType.EXCLUSIVE) for each in spec.groups
    )
    return replace(spec, groups=groups)


def outcomes(trace_file: Path, change: Callable[[Spec], Spec] = as_it_is) -> list[Outcome]:
    program = FOLDER / f'{trace_file.stem}.py'
    units = scan_text(program.read_text(), program.name).units
    found = []
    for trace, executor, spec in pair_units(read_traces(trace_file), units):
        compared = compare(trace, executor, change(spec))
        assert (compared.lacking, compared.gaps) == ((), ())
        assert len(compared.observations) >= FEWEST
        found.append(compared.answer.outcome)
    return found


@pytest.mark.parametrize('trace_file', TRACES, ids=lambda path: path.stem)
def test_a_trace_is_a_path_of_the_model(trace_file: Path) -> None:
    assert outcomes(trace_file) == [Outcome.CONFORMS]


@pytest.mark.parametrize('name', CONCURRENT)
def test_concurrent_runs_are_no_path_of_a_serial_model(name: str) -> None:
    trace_file = HERE / 'loop_traces' / f'{name}.jsonl'
    assert outcomes(trace_file, one_by_one) == [Outcome.DIVERGES]


@pytest.mark.live
def test_traces_of_the_release_of_the_day_are_paths_of_the_models(tmp_path: Path) -> None:
    python, release = release_of_the_day()
    if not release.version.startswith(LINES_WITH_ASYNC_NODES):
        pytest.skip(f'rclpy {release.version} has no AsyncNode')
    found = {}
    for name in (path.stem for path in TRACES):
        trace_file = tmp_path / f'{name}.jsonl'
        with own_environment() as environment:
            subprocess.run(
                [python, str(TRACER), str(FOLDER / f'{name}.py'), str(trace_file)],
                env=release.over(environment),
                capture_output=True,
                check=False,  # what a node raises when it is destroyed does not matter
                timeout=PATIENCE_S,
            )
        found[name] = outcomes(trace_file)
    assert found == {path.stem: [Outcome.CONFORMS] for path in TRACES}
