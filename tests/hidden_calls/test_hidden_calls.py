"""A wait is found or told, however Python comes to it."""

from __future__ import annotations

import asyncio
import json
import sys
from contextlib import suppress
from io import StringIO
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from ros2cc_extract.cli.main import main
from tests.hidden_calls.ways import FOUND, OPEN, Way, cases, text_of

WAYS = {way.name: way for way in (*FOUND, *OPEN)}
KIND = 'Event.wait'


class ReachedError(BaseException):
    """The wait was reached; not what a way would catch."""


class _Node:
    """Stands for a node: nothing of it is what is asked here."""

    def __init__(self, name: str) -> None: ...
    def create_subscription(self, *given: object) -> None: ...
    def create_timer(self, *given: object) -> None: ...


@pytest.mark.parametrize('way', list(WAYS.values()), ids=list(WAYS))
def test_python_comes_to_the_wait(way: Way, monkeypatch: pytest.MonkeyPatch) -> None:
    if 'TaskGroup' in way.more and not hasattr(asyncio, 'TaskGroup'):
        pytest.skip('as of Python 3.11')
    reached: list[str] = []

    def wait(*given: object) -> None:
        reached.append('here')
        raise ReachedError

    def spin(node: Any) -> None:
        node.ready.wait = wait
        node.on_timer()

    stubs = {'rclpy': {'init': lambda: None, 'spin': spin}, 'rclpy.node': {'Node': _Node}}
    for name, members in {**stubs, 'std_msgs': {}, 'std_msgs.msg': {'String': None}}.items():
        stub = ModuleType(name)
        vars(stub).update(members)
        monkeypatch.setitem(sys.modules, name, stub)
    monkeypatch.setattr(sys, 'unraisablehook', lambda error: None)
    with suppress(BaseException):  # a group of tasks has one of its own around it
        exec(compile(text_of(way, KIND), 'way.py', 'exec'), {'__name__': '__main__'})
    assert reached


def told(way: Way, kind: str, folder: Path) -> list[tuple[str, str, int]]:
    """Severity, code and line of what the tool says, but for advice."""
    path, out = folder / 'way.py', StringIO()
    path.write_text(text_of(way, kind), encoding='utf-8')
    main(['check', '--no-cache', '--output-format', 'json', str(path)], out, StringIO())
    found = json.loads(out.getvalue())['findings']
    return [
        (each['severity'], each['code'], each['line'])
        for each in found
        if not each['code'].startswith(('CC4', 'CC5'))
    ]


def line_of(way: Way, kind: str) -> int:
    """Where the method of the node waits."""
    lines = text_of(way, kind).splitlines()
    return lines.index('    def wait(self, *args):') + 2


@pytest.mark.parametrize(('name', 'kind'), list(cases()))
def test_the_wait_is_found(name: str, kind: str, tmp_path: Path) -> None:
    errors = [each for each in told(WAYS[name], kind, tmp_path) if each[0] == 'error']
    assert [line for _, _, line in errors] == [line_of(WAYS[name], kind)]


@pytest.mark.parametrize('way', OPEN, ids=lambda way: way.name)
def test_the_wait_is_told(way: Way, tmp_path: Path) -> None:
    assert told(way, KIND, tmp_path) == [('note', 'CC120', line_of(way, KIND))]


_USED_ELSEWHERE = '\nthreading.Thread(target=self.wait, daemon=True).start()'


@pytest.mark.parametrize(
    'name', ['eval', 'exec', 'chain', 'heap', 'partialmethod', 'item of vars']
)
def test_another_caller_hides_nothing(name: str, tmp_path: Path) -> None:
    way = WAYS[name]._replace(init=WAYS[name].init + _USED_ELSEWHERE)
    errors = [each for each in told(way, KIND, tmp_path) if each[0] == 'error']
    assert [line for _, _, line in errors] == [line_of(way, KIND)]


_HIDDEN = 'def later(self):\n    return 1\n'
_COMPUTED = "time.strftime('later')"


@pytest.mark.parametrize(
    ('use', 'init', 'is_told'),
    [
        ('self.later()', f'setattr(self, {_COMPUTED}, self.wait)', True),
        ('self.later()', f"setattr(self, 'la' + {_COMPUTED}[2:], self.wait)", True),
        ('self.later()', f"setattr(self, 'on_' + {_COMPUTED}, self.wait)", False),
        ('self.later()', f'setattr(self, {_COMPUTED}, self.later)', False),
        (f'getattr(self, {_COMPUTED})()', f'self.other = {_COMPUTED}', True),
    ],
)
def test_what_a_computed_name_may_mean_is_told(
    use: str, init: str, *, is_told: bool, tmp_path: Path
) -> None:
    way = Way('computed', use, more=_HIDDEN, init=init + _USED_ELSEWHERE)
    found = {(severity, code) for severity, code, _ in told(way, KIND, tmp_path)}
    assert found == ({('note', 'CC120')} if is_told else set())


@pytest.mark.parametrize('name', ['singledispatch', 'singledispatch of nothing else'])
def test_another_function_for_that_class_is_called(name: str, tmp_path: Path) -> None:
    way = WAYS[name]
    other = "handle('a', self)" if way.use == 'handle(1, self)' else 'handle(1, self)'
    found = told(way._replace(use=other), KIND, tmp_path)
    assert not [each for each in found if each[0] == 'error']
