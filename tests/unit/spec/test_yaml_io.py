"""Reading and writing specifications: identity, and one precise complaint per fault."""

from __future__ import annotations

import json
from importlib.resources import files

import jsonschema
import pytest
import yaml

from ros2cc_extract.errors import SpecFormatError
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.effects import OUTSIDE, Access, Act, Blocking, Needs, Waker
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    CallbackType,
    EntityKind,
    Executor,
    GroupType,
    Origin,
    Spec,
    collect_unresolved,
)
from ros2cc_extract.spec.yaml.yaml_io import SPEC, read_specs, write_specs

PUBLISHED = """\
node:
  name: "example"
  callbacks:
    - name: "TMR1"
      type: "TMR"
      callback_group: "G1"
    - name: "SUB1"
      type: "SUB"
      callback_group: "G2"
  callback_groups:
    - name: "G1"
      type: "REENTRANT"
    - name: "G2"
      type: "EXCLUSIVE"
  executor:
    name: "executor"
    threads:
      - name: "thread0"
      - name: "thread1"
"""
AT = Place('arm.py', 42, 9)
TRICKY = Spec(
    name='arm',
    nodes=('arm', 'leg'),
    origin=Origin.STATIC,
    sources=('arm.py',),
    entry='arm.py:main',
    callbacks=(
        Callback(
            name='on_joint',
            type=CallbackType.SUB,
            group='g',
            entity=EntityKind.SUBSCRIPTION,
            node='arm',
            function='arm.Arm.on_joint',
            key=Unknown('a parameter', AT),
            count=Unknown('loop over a parameter'),
            conditional=True,
            source=AT,
            blocking=(
                Blocking(call='client.call', on=Unknown('x: y # "z"'), source=AT, chain=(AT, AT)),
                Blocking(call='time.sleep', seconds=1e-05, held=('lock', 'gate (re-entrant)')),
            ),
            writes=(Access(name='Arm.x', source=AT, locks=('lock',), update=True),),
            locks=(Act(name='lock', tries=True),),
            publishes=(Act(name=Unknown('an expression', AT), source=AT), Act(name='out')),
        ),
        Callback(
            name='tick',
            type=CallbackType.TMR,
            group='unresolved_1',
            entity=EntityKind.TIMER,
            node=Unknown('which node'),
            period_s=Unknown('a parameter'),
            count=3,
            unresolved=Unknown('made by a factory', AT),
        ),
        Callback(name='plain', type=CallbackType.CLT, group='g'),
    ),
    groups=(
        CallbackGroup(name='g', type=GroupType.EXCLUSIVE, default=True, node='arm'),
        CallbackGroup(
            name='unresolved_1', type=GroupType.EXCLUSIVE, unresolved=Unknown('an argument', AT)
        ),
    ),
    executor=Executor(name='ex', kind=Unknown('none found', AT), threads=('thread_0',)),
)


def test_published_format_is_read() -> None:
    (spec,) = read_specs(PUBLISHED, 'example.yaml')
    assert spec == Spec(
        name='example',
        callbacks=(
            Callback(name='TMR1', type=CallbackType.TMR, group='G1'),
            Callback(name='SUB1', type=CallbackType.SUB, group='G2'),
        ),
        groups=(
            CallbackGroup(name='G1', type=GroupType.REENTRANT),
            CallbackGroup(name='G2', type=GroupType.EXCLUSIVE),
        ),
        executor=Executor(name='executor', threads=('thread0', 'thread1')),
    )


def test_writing_and_reading_is_the_identity() -> None:
    text = write_specs([TRICKY, TRICKY])
    assert read_specs(text, 'x.yaml') == (TRICKY, TRICKY)
    assert write_specs(read_specs(text, 'x.yaml')) == text


def test_unknown_facts_stay_visible() -> None:
    facts = {(fact.subject, fact.fact): fact.reason for fact in collect_unresolved(TRICKY)}
    assert facts == {
        ('on_joint', 'topic'): 'a parameter',
        ('on_joint', 'count'): 'loop over a parameter',
        ('tick', 'function'): 'made by a factory',
        ('tick', 'node'): 'which node',
        ('tick', 'period'): 'a parameter',
        ('unresolved_1', 'group'): 'an argument',
        ('ex', 'executor'): 'none found',
    }


def test_committed_schema_is_the_one_of_the_tables() -> None:
    committed = (
        files('ros2cc_extract.spec.yaml').joinpath('schema.json').read_text(encoding='utf-8')
    )
    assert json.loads(committed) == SPEC.schema


@pytest.mark.parametrize('text', [PUBLISHED, write_specs([TRICKY])])
def test_what_is_read_fits_the_schema(text: str) -> None:
    jsonschema.validate(yaml.safe_load(text), SPEC.schema)


@pytest.mark.parametrize(
    ('old', 'new', 'line', 'what'),
    [
        ('  executor:', '  speed: 3\n  executor:', 15, "unknown key 'speed' in 'node'"),
        ('"SUB1"', '"TMR1"', 7, "duplicate name 'TMR1', first used at line 4"),
        ('"thread1"', '"G1"', 19, "duplicate name 'G1', first used at line 11"),
        ('group: "G2"', 'group: "G3"', 9, "callback group 'G3' does not exist"),
        ('"SUB"', '"Sub"', 8, "'node.callbacks[1].type' is 'Sub'"),
        ('"REENTRANT"', 'yes', 12, 'must be a text, it is true or false'),
        ('"SUB1"', 'on', 7, 'must be a text, it is true or false'),
        ('"SUB1"', '"2nd"', 7, "'2nd' is no UPPAAL identifier"),
        ('"SUB1"', '"clock"', 7, "'clock' is a UPPAAL keyword"),
        ('"executor"', '"A"', 16, "'A' is a word of UPPAAL queries"),
        ('"SUB1"', '"NUM_CB"', 7, "'NUM_CB' is a name of the model itself"),
        ('      type: "TMR"\n', '', 4, "key 'type' is missing in 'node.callbacks[0]'"),
        ('"TMR"', '"TMR"\n      type: "SUB"', 6, "key 'type' stands twice"),
        (
            '    threads:',
            '    threads: 3\n    spun:',
            17,
            "'node.executor.threads' must be a list",
        ),
    ],
)
def test_a_fault_is_told_at_its_line(old: str, new: str, line: int, what: str) -> None:
    assert old in PUBLISHED
    with pytest.raises(SpecFormatError) as caught:
        read_specs(PUBLISHED.replace(old, new, 1), 'arm.yaml')
    assert what in str(caught.value)
    assert caught.value.place is not None
    assert (caught.value.place.file, caught.value.place.line) == ('arm.yaml', line)
    assert caught.value.mend or 'must be' in str(caught.value)


@pytest.mark.parametrize(
    ('text', 'message'),
    [
        ('', 'arm.yaml: the file is empty; a specification is a YAML mapping with the key node'),
        ('# nothing\n', 'arm.yaml: the file is empty; a specification is a YAML mapping'),
        ('- a\n', 'arm.yaml:1:1: the document must be a mapping, it is a list'),
        ('node: [1\n', 'arm.yaml:2:1: no valid YAML'),
        ('node: \x01', 'arm.yaml: '),
        ('node: {}\n', "arm.yaml:1:7: key 'name' is missing in 'node'"),
        ('[' * 3000, 'arm.yaml'),
    ],
)
def test_what_is_no_specification_is_refused(text: str, message: str) -> None:
    with pytest.raises(SpecFormatError) as caught:
        read_specs(text, 'arm.yaml')
    assert str(caught.value).startswith(message)
    assert '\n' not in str(caught.value)


def test_unknown_version_is_refused() -> None:
    with pytest.raises(SpecFormatError, match='spec_version 3 is not known'):
        read_specs('ros2cc: {spec_version: 3}\n' + PUBLISHED, 'arm.yaml')


WITH_WAKERS = """\
ros2cc: {spec_version: 2}
node:
  name: arm
  callbacks:
    - name: scan
      type: TMR
      callback_group: group
      entity: timer
      callback: Arm.scan
      period_s: 0.5
      blocking:
        - call: Queue.get
          resource: jobs
          needs: each
          wakers: [{by: feed, after: 0, conditional: true, source: 'arm.py:9'}, {by: outside}]
          source: arm.py:4
        - {call: Event.wait, escapes: stored in a list, escapes_at: arm.py:7}
  callback_groups:
    - {name: group, type: EXCLUSIVE}
  executor:
    name: executor
    threads:
      - {name: thread_0}
  activities:
    - name: feed
      kind: thread
      function: Arm.feed
      node: arm
      starts: [{by: scan, after: 0, source: arm.py:3}]
      loops: true
      blocking:
        - {call: time.sleep, seconds: 1.0, source: arm.py:8}
      source: arm.py:3
"""


def test_wakers_and_activities_are_read_and_written() -> None:
    (spec,) = read_specs(WITH_WAKERS, 'arm.yaml')
    get, wait = spec.callbacks[0].blocking
    assert get.needs is Needs.EACH
    assert get.wakers == (
        Waker(by='feed', source=Place('arm.py', 9), after=0, conditional=True),
        Waker(by=OUTSIDE),
    )
    assert wait.escapes == Unknown('stored in a list', Place('arm.py', 7))
    assert [activity.display_name for activity in spec.activities] == ['feed']
    assert read_specs(write_specs([spec]), 'arm.yaml') == (spec,)


def test_an_activity_shares_the_name_space() -> None:
    text = WITH_WAKERS.replace('- name: feed', '- name: scan')
    with pytest.raises(SpecFormatError, match="duplicate name 'scan'"):
        read_specs(text, 'arm.yaml')


@pytest.mark.parametrize('opening', ['[', '{a: ', '- ', '? '])
def test_a_text_of_brackets_is_refused_where_it_gets_too_deep(opening: str) -> None:
    # PyYAML 6.0.2 ends the process here: its composer calls itself in C. That of 6.0.4 reads 1,000
    # of these brackets ahead, and refuses them itself.
    with pytest.raises(SpecFormatError) as refused:
        read_specs(opening * 50_000, 'deep.yaml')
    assert refused.value.what == 'the YAML is nested too deeply'
    columns = [100 * len(opening) + 1, *([1_001] if opening == '[' else [])]
    assert refused.value.place in [Place('deep.yaml', 1, column) for column in columns]
