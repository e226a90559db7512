"""Text of strangers does nothing: in no format, on neither stream, from no command."""

from __future__ import annotations

import io
import json
import re
from collections.abc import Callable, Iterator
from dataclasses import fields, is_dataclass
from enum import Enum
from functools import cache
from pathlib import Path
from typing import Any, TextIO, cast
from xml.etree import ElementTree

import pytest
import yaml
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from ros2cc_extract.cli.main import main
from ros2cc_extract.pipeline.check import Outcome, check_paths
from ros2cc_extract.pipeline.config import load_config
from ros2cc_extract.report.formats import WRITERS, write
from ros2cc_extract.report.shared.checked import Checked
from ros2cc_extract.report.text.check import Presentation, print_check
from ros2cc_extract.report.text.findings import Detail
from ros2cc_extract.report.text.style import console_for
from ros2cc_extract.ros.standard import standard_job
from ros2cc_extract.spec.yaml.yaml_io import read_specs, write_specs
from ros2cc_extract.text_escaping import Shown, json_text, one_line, printable

CLASS = 'texts of strangers'

NODE = Path(__file__).parents[2] / 'launch_free_examples/service_deadlock/node.py'
OBEYED = '\x1b[31m\x1b]0;title\x07\x9b2J\x85\u2028\u202e\u2066\u200f\x00\x7f\r\n::error::forged'
ON_A_LINE = ''.join(c for c in OBEYED if c not in '\r\n\0')
LETTERS = st.sampled_from(sorted({*OBEYED, *'a"\\<>&%|#`[{;é🤖', '##[error]x', '\n::error::x'}))
STRANGE = st.lists(LETTERS, min_size=1, max_size=8).map(''.join)
few = settings(
    max_examples=25, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


def assert_harmless(text: str) -> None:
    odd = {c for c in text if not c.isprintable() and c not in '\n\t'}
    assert not odd, f'{odd} in {text!r}'


@given(st.text())
def test_one_line_is_one_line(text: str) -> None:
    assert one_line(text).isprintable()
    assert not text.isprintable() or one_line(text) == text


@given(
    st.recursive(st.text() | st.integers(), lambda x: st.lists(x) | st.dictionaries(st.text(), x))
)
def test_json_says_what_it_said_and_does_nothing(data: Any) -> None:
    text = json_text(data)
    assert json.loads(text) == data
    assert_harmless(text)


@given(st.lists(st.text()))
def test_a_stream_passes_text_only(parts: list[str]) -> None:
    told, log = io.StringIO(), io.StringIO()
    stream, lines = Shown(cast(TextIO, told)), Shown(cast(TextIO, log), by_lines=True)
    for part in parts:
        stream.write(part)
        print(part, file=cast(TextIO, lines))
    assert_harmless(told.getvalue())
    assert_harmless(log.getvalue())
    assert log.getvalue().count('\n') == sum(part != '\n' or 2 for part in parts)
    assert not re.search(r'^\s*::|##\[', log.getvalue(), re.MULTILINE)


@cache
def outcome() -> Outcome:
    job = standard_job([NODE], load_config(NODE))
    return check_paths(job, io.StringIO())


def stained(value: Any, stain: str) -> Any:
    """A value with ``stain`` behind each of its texts that is no identifier."""
    if type(value) is str:
        return value if value.isidentifier() else f'{value}{stain}'
    if type(value) in (tuple, list):
        return type(value)(stained(part, stain) for part in value)
    if isinstance(value, dict):
        return {key: stained(part, stain) for key, part in value.items()}
    if is_dataclass(value) and not isinstance(value, type | Enum):
        made = object.__new__(type(value))
        kept = {f.name: getattr(value, f.name) for f in fields(value)}
        new = {
            n: kept[n] if n in ('code', 'origin') else stained(v, stain) for n, v in kept.items()
        }
        object.__setattr__(made, '__dict__', new)
        return made
    return value


def told_as(form: str, stain: str) -> str:
    found = outcome()
    units, findings = stained(found.units, stain), stained(found.findings, stain)
    stream = io.StringIO()
    shown = cast(TextIO, Shown(cast(TextIO, stream)))
    checked = Checked(
        units=units,
        verifications=found.verifications,
        findings=findings,
        summary=found.summary,
        promises=stained(found.promises, stain),
        files=[f'{file}{stain}' for file in found.extraction.files_seen],
        sources=found.sources,
        with_verdicts=True,
    )
    if form == 'text':
        console = console_for(shown)
        console.width = 10_000
        print_check(checked, console, Presentation(detail=Detail.VERBOSE))
    else:
        shown.write(write(checked, form))
    return stream.getvalue()


@few
@pytest.mark.parametrize('form', ['text', *WRITERS])
@given(stain=STRANGE)
def test_no_format_holds_more_than_text(form: str, stain: str) -> None:
    text = told_as(form, stain)
    assert_harmless(text)
    assert text.count('\n') == told_as(form, 'x').count('\n') or form in ('html', 'junit')
    if form in ('json', 'sarif'):
        assert f'the answer of service {stain}' in str(json.loads(text)) or stain in everything(
            json.loads(text)
        )
    if form == 'junit':
        ElementTree.fromstring(text)
    if form == 'github':
        commands = [line for line in text.splitlines() if line.startswith('::')]
        assert len(commands) == len(outcome().findings)


def everything(data: Any) -> str:
    if isinstance(data, dict):
        return '\0'.join(map(everything, (*data, *data.values())))
    return '\0'.join(map(everything, data)) if isinstance(data, list) else str(data)


@few
@given(stain=STRANGE)
def test_a_specification_says_what_it_said_and_does_nothing(stain: str) -> None:
    units = outcome().units
    odd = [stained(unit, stain.replace('\x00', '').replace('\r', '')) for unit in units]
    text = write_specs(odd)
    assert_harmless(text)
    assert not re.search(r'^\s*::', text, re.MULTILINE)
    list(yaml.safe_load_all(text))


def test_what_is_printable_is_the_same_value() -> None:
    findings = outcome().findings
    assert printable(findings) is findings


PROGRAM = f"""
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Odd(Node):
    def __init__(self):
        super().__init__('odd')
        self.client = self.create_client(Trigger, {OBEYED!r})
        self.create_subscription(String, {OBEYED!r}, self.on_odd, 10)
        self.create_timer(1.0, self.tick)

    def on_odd(self, msg):
        self.client.call(Trigger.Request())  # {ON_A_LINE}

    def tick(self):
        undefined_of_somebody(self, {OBEYED!r})


def main():
    rclpy.init()
    rclpy.spin(Odd())
"""


@pytest.fixture
def odd(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A node whose name, topics and source are a stranger's."""
    monkeypatch.setenv('XDG_CACHE_HOME', str(tmp_path / '.cache'))
    folder = tmp_path / OBEYED.replace('\x00', '').replace('/', '')
    folder.mkdir()
    (folder / '::error::node\x1b[1m\n::error::forged.py').write_text(PROGRAM)
    (folder / 'broken\n::error::forged\x9b.py').write_text('def (\n')
    monkeypatch.chdir(folder)
    return folder


def said(*arguments: object) -> Iterator[str]:
    told, complaints = io.StringIO(), io.StringIO()
    status = main([*map(str, arguments)], told, complaints)
    assert status in (0, 1, 2, 3), complaints.getvalue()
    yield told.getvalue()
    yield complaints.getvalue()


FORMS: list[Callable[[Path], list[object]]] = [
    *(lambda p, f=f: ['check', '.', '--output-format', f] for f in ('text', *WRITERS)),
    lambda p: ['check', '.', '--verbose'],
    lambda p: ['check', '.', '-o', p / 'kept'],
    lambda p: ['check', '.', '--write-baseline', p / OBEYED[:6]],
    lambda p: ['check', p / f'missing{OBEYED[:-5]}'.replace('\x00', '')],
    lambda p: ['spec', '.'],
    lambda p: ['spec', '.', '--check', p / 'one.yaml'],
    lambda p: ['model', p / 'one.yaml', '-o', p / 'model\x1b[1m\n::error::x'],
    lambda p: ['verify', p / 'one.yaml', '--timeout', '5'],
    lambda p: ['verify', p / 'one.yaml', '--output-format', 'json'],
    lambda p: ['verify', p / 'one.yaml', '--threads', '1..2', '--timeout', '5'],
    lambda p: ['verify', p / 'two.yaml'],
    lambda p: ['diff', p / 'one.yaml', p / 'two.yaml'],
    lambda p: ['diff', p / 'one.yaml', p / 'other.yaml'],
    lambda p: ['diff', p / 'one.yaml', p / 'other.yaml', '--output-format', 'json'],
    lambda p: ['diff', p / 'one.yaml', p / 'other.yaml', '--output-format', 'mermaid'],
    lambda p: ['merge', p / 'one.yaml', p / 'other.yaml'],
    lambda p: ['conform', p / 'trace.json', p / 'one.yaml'],
    lambda p: ['explain', OBEYED],
    lambda p: [OBEYED.replace('\x00', '')],
]


@pytest.mark.parametrize('form', FORMS)
def test_no_command_says_more_than_text(
    form: Callable[[Path], list[object]], odd: Path, tmp_path: Path
) -> None:
    (spec,) = [text for text in said('spec', '.') if text.startswith('# Format')]
    (tmp_path / 'one.yaml').write_text(spec)
    (tmp_path / 'other.yaml').write_text(spec.replace('forged', 'other'))
    (tmp_path / 'two.yaml').write_text(f'node: {OBEYED}')
    (tmp_path / 'trace.json').write_text(json.dumps({'format': OBEYED}))
    arguments = form(tmp_path)
    for text in said(*arguments):
        assert_harmless(text)
        forged = [line for line in text.splitlines() if line.lstrip().startswith('::error::')]
        assert not forged, forged


def test_a_specification_of_strange_names_is_read_as_it_was_written(odd: Path) -> None:
    (text,) = [text for text in said('spec', '.') if text.startswith('# Format')]
    topics = {callback.key for unit in read_specs(text, 'x') for callback in unit.callbacks}
    assert OBEYED in topics
