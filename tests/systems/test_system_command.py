"""The command ``system``: the specification, its schema, pictures, and what it refuses."""

from __future__ import annotations

import io
import json
import shutil
from pathlib import Path
from typing import Any

import jsonschema
import pytest
import yaml

from ros2cc_extract.cli.main import main

LAUNCH = Path(__file__).parent / 'launch'
RELAYS = LAUNCH / 'relays_bad.launch.xml'


def told(*words: str) -> tuple[int, str, str]:
    out, err = io.StringIO(), io.StringIO()
    return main(['system', '--no-cache', *words], out, err), out.getvalue(), err.getvalue()


def system_of(path: Path) -> dict[str, Any]:
    found: dict[str, Any] = yaml.safe_load(told(str(path))[1])
    return found


@pytest.mark.parametrize('path', sorted(LAUNCH.iterdir()), ids=lambda path: path.name)
def test_what_is_written_is_of_the_schema(path: Path) -> None:
    found = system_of(path)
    jsonschema.validate(found, json.loads(told('--schema')[1]))
    out = io.StringIO()
    main(['spec', '--schema'], out, io.StringIO())
    for process in found['system']['processes']:
        for unit in process['units']:
            jsonschema.validate(unit, json.loads(out.getvalue()))
    assert json.loads(told(str(path), '--output-format', 'json')[1]) == found


def test_names_are_resolved_and_parameters_decide() -> None:
    system = system_of(RELAYS)['system']
    first, second = system['processes']
    assert [node['name'] for node in (*first['nodes'], *second['nodes'])] == [
        '/chain/first',
        '/chain/second',
    ]
    timers = [
        [
            each['name']
            for each in process['units'][0]['node']['callbacks']
            if each['type'] == 'TMR'
        ]
        for process in (first, second)
    ]
    assert timers == [['tick'], []]
    ends = {
        connection['service']: [(end['kind'], end['process']) for end in connection['ends']]
        for connection in system['connections']
    }
    assert ends == {
        '/chain/first/request': [('service', 'first'), ('client', 'second')],
        '/chain/second/request': [('client', 'first'), ('service', 'second')],
    }


def test_an_argument_names_the_namespace() -> None:
    found = yaml.safe_load(told(str(RELAYS), 'space:=other')[1])
    names = [node['name'] for p in found['system']['processes'] for node in p['nodes']]
    assert names == ['/other/first', '/other/second']


def test_a_circle_is_red_and_what_is_in_none_is_not() -> None:
    assert 'linkStyle 0,1,2,3 stroke:#c62828' in told(str(RELAYS), '--output-format', 'mermaid')[1]
    assert told(str(RELAYS), '--output-format', 'dot')[1].count('color="#c62828"') == 4
    good = str(LAUNCH / 'relays_good.launch.yaml')
    assert 'linkStyle' not in told(good, '--output-format', 'mermaid')[1]


def test_several_systems_are_boxes_side_by_side(tmp_path: Path) -> None:
    for name in ('a', 'b'):
        (tmp_path / f'{name}.launch.xml').write_text('<launch><node pkg="p" exec="e"/></launch>')
    drawn = told(str(tmp_path), '--output-format', 'mermaid')[1].splitlines()
    assert drawn == [
        'flowchart LR',
        '  subgraph s0["a.launch.xml"]',
        '    subgraph s0p0["e (outside)"]',
        '      s0p0x[" "]',
        '    end',
        '  end',
        '  subgraph s1["b.launch.xml"]',
        '    subgraph s1p0["e (outside)"]',
        '      s1p0x[" "]',
        '    end',
        '  end',
    ]
    drawn = told(str(tmp_path), '--output-format', 'dot')[1].splitlines()
    assert [line.strip() for line in drawn if 'subgraph' in line or 'label' in line] == [
        'subgraph cluster_s0 {',
        'label="a.launch.xml";',
        'subgraph cluster_s0p0 { style=dashed;',
        'label="e";',
        'subgraph cluster_s1 {',
        'label="b.launch.xml";',
        'subgraph cluster_s1p0 { style=dashed;',
        'label="e";',
    ]


def test_what_is_no_launch_file_is_refused(tmp_path: Path) -> None:
    path = tmp_path / 'node.py'
    path.write_text('')
    assert told(str(path)) == (
        2,
        '',
        f'ros2cc-extract: error: {path}: is no launch file; launch files end in .launch.py, '
        '.launch.xml or .launch.yaml\n',
    )


def test_nothing_in_sight_is_undecided(tmp_path: Path) -> None:
    path = tmp_path / 'a.launch.xml'
    path.write_text('<launch><node pkg="elsewhere" exec="e"/></launch>')
    out, err = io.StringIO(), io.StringIO()
    assert main(['check', '-q', '--no-cache', str(path)], out, err) == 3
    assert err.getvalue() == 'nothing to check: none of 1 processes has a known callback\n'
    assert 'process e is outside: package elsewhere is not found' in out.getvalue()


def test_a_process_whose_file_cannot_be_read_says_so(tmp_path: Path) -> None:
    """That no start of a node is in sight there would be true, and lead nowhere."""
    (tmp_path / 'node.py').write_text('import rclpy\nrclpy.init(\n', encoding='utf-8')
    path = tmp_path / 'all.launch.xml'
    cmd = f'python3 {tmp_path / "node.py"}'
    path.write_text(f'<launch><executable cmd="{cmd}"/></launch>', encoding='utf-8')
    (process,) = system_of(path)['system']['processes']
    assert "its file cannot be read: syntax error: '(' was never closed" in process['outside']


def test_an_argument_needs_a_launch_file(tmp_path: Path) -> None:
    path = tmp_path / 'node.py'
    path.write_text('')
    err = io.StringIO()
    assert main(['check', str(path), 'a:=b'], io.StringIO(), err) == 2
    assert 'a:= is for a launch file; name the launch file too' in err.getvalue()


def test_confirm_starts_no_system() -> None:
    err = io.StringIO()
    assert main(['confirm', '--no-cache', str(RELAYS)], io.StringIO(), err) == 2
    assert 'a launch file is not started; name the Python file of one of its nodes' in (
        err.getvalue()
    )


def test_a_program_whose_entry_point_is_put_together_is_in_sight(tmp_path: Path) -> None:
    """A process whose ``setup.py`` joins texts was outside."""
    code = Path(__file__).parents[1] / 'scanner_cases' / 'd16_scripts_put_together'
    home = tmp_path / 'arm'
    shutil.copytree(code, home)
    (home / 'launch').mkdir()
    launch = home / 'launch' / 'a.launch.xml'
    nodes = ('fast', 'node', 'other', 'more')
    text = ''.join(f'<node pkg="arm" exec="arm_{name}"/>' for name in nodes)
    launch.write_text(f'<launch>{text}</launch>')
    *known, more = system_of(launch)['system']['processes']
    entries = [each['entry'].removeprefix(f'{home}/') for each in known]
    assert entries == ['arm/node.py:fast', 'arm/node.py:ros_main', 'arm/other.py:ros_main']
    assert more['outside'] == (
        'executable arm_more was not found among what package arm installs, of which not all '
        'could be read: an entry point: an expression that could not be folded '
        f'({home}/setup.py:15:13) ({launch}:1:109)'
    )
