"""Whatever the text, a scan ends in a result or a diagnostic, and says the same twice."""

from __future__ import annotations

import os
import random
from pathlib import Path

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from ros2cc_extract.extract.static.api import scan_text

CASES = sorted((Path(__file__).parents[1] / 'scanner_cases').glob('*.py'))
TEXTS = [path.read_text(encoding='utf-8').partition('\n# expect:')[0] for path in CASES]

# The long run is asked for by name: ROS2CC_FUZZ_RUNS=100000.
RUNS = int(os.environ.get('ROS2CC_FUZZ_RUNS', '150'))

NAMES = st.sampled_from(['a', 'b', 'self', 'node', 'group', 'ex', 'A', 'B', 'Node', 'rclpy'])
ATTRIBUTES = st.sampled_from(
    ['create_timer', 'create_subscription', 'spin', 'add_node', 'g', 'append', 'x', 'executor']
)
ATOMS = st.one_of(
    NAMES,
    st.sampled_from(['1', '0.5', "'in'", 'None', 'True', '[]', '{}', '(1, 2)', 'lambda: a']),
    st.sampled_from(
        ['ReentrantCallbackGroup()', 'MultiThreadedExecutor(2)', "Node('n')", 'threading.Lock()']
    ),
)


def _larger(inner: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    return st.one_of(
        st.builds('{}.{}'.format, inner, ATTRIBUTES),
        st.builds('{}({}, {})'.format, inner, inner, inner),
        st.builds('{}(callback_group={})'.format, inner, inner),
        st.builds('({} if {} else {})'.format, inner, inner, inner),
        st.builds('[{} for a in {}]'.format, inner, inner),
        st.builds('({} + {})'.format, inner, inner),
        st.builds('{}[{}]'.format, inner, inner),
        st.builds('(not {})'.format, inner),
        st.builds('*{}'.format, NAMES).map(lambda text: f'f({text})'),
    )


EXPRESSIONS = st.recursive(ATOMS, _larger, max_leaves=6)


def _indented(lines: list[str]) -> list[str]:
    return [f'    {line}' for line in lines] or ['    pass']


def _blocks(inner: st.SearchStrategy[list[str]]) -> st.SearchStrategy[list[str]]:
    bodies = st.lists(inner, max_size=3).map(lambda parts: [x for part in parts for x in part])
    heads = st.one_of(
        st.builds('if {}:'.format, EXPRESSIONS),
        st.builds('for a in {}:'.format, EXPRESSIONS),
        st.builds('while {}:'.format, EXPRESSIONS),
        st.builds('with {} as b:'.format, EXPRESSIONS),
        st.builds('def {}(self, a=None, *b):'.format, NAMES),
        st.builds('class {}({}):'.format, NAMES, EXPRESSIONS),
        st.just('async def f(self):'),
    )
    return st.builds(lambda head, body: [head, *_indented(body)], heads, bodies)


SIMPLE = st.one_of(
    st.builds('{} = {}'.format, NAMES, EXPRESSIONS),
    st.builds('{}.x = {}'.format, NAMES, EXPRESSIONS),
    st.builds('{} += {}'.format, NAMES, EXPRESSIONS),
    st.builds('rclpy.spin({})'.format, EXPRESSIONS),
    EXPRESSIONS,
).map(lambda line: [line])
STATEMENTS = st.recursive(SIMPLE, _blocks, max_leaves=8)
HEAD = (
    'import rclpy, threading\nfrom rclpy.node import Node\nfrom rclpy.executors import *\n'
    'from rclpy.callback_groups import *\n'
)


def check(text: str) -> None:
    found = scan_text(text)
    assert found == scan_text(text)
    for unit in found.units:
        names = list(unit.names())
        assert len(names) == len(set(names))


@settings(max_examples=RUNS, deadline=None, suppress_health_check=list(HealthCheck))
@given(st.lists(STATEMENTS, max_size=8))
def test_generated_programs(blocks: list[list[str]]) -> None:
    check(HEAD + '\n'.join(line for block in blocks for line in block) + '\n')


@settings(max_examples=RUNS, deadline=None, suppress_health_check=list(HealthCheck))
@given(st.integers(0, len(TEXTS) - 1), st.integers(0, 2**32))
def test_mutated_cases(index: int, seed: int) -> None:
    check(mutated(TEXTS[index], random.Random(seed)))


@settings(max_examples=RUNS, deadline=None, suppress_health_check=list(HealthCheck))
@given(st.text(max_size=200))
def test_any_text(text: str) -> None:
    check(f'import rclpy\n{text}')


def mutated(text: str, rng: random.Random) -> str:
    """Delete, double, swap and replace lines and tokens; the result often still parses."""
    lines = text.split('\n')
    for _ in range(rng.randint(1, 4)):
        at = rng.randrange(len(lines))
        action = rng.randrange(6)
        if action == 0:
            del lines[at]
            lines = lines or ['']
        elif action == 1:
            lines.insert(at, lines[rng.randrange(len(lines))])
        elif action == 2:
            other = rng.randrange(len(lines))
            lines[at], lines[other] = lines[other], lines[at]
        elif action == 3:
            lines[at] = _with_other_word(lines[at], text, rng)
        elif action == 4:
            lines[at] = lines[at][: rng.randrange(len(lines[at]) + 1)]
        else:
            lines[at] = f'{lines[at]}{rng.choice("()[]{}.,:=*@0abc ")}'
    return '\n'.join(lines)


def _with_other_word(line: str, text: str, rng: random.Random) -> str:
    words, others = line.split(' '), text.split()
    if others:
        words[rng.randrange(len(words))] = rng.choice(others)
    return ' '.join(words)
