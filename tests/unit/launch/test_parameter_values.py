"""Values of parameter files, as rcl reads them; each was put to the rclpy of Jazzy and Kilted."""

from __future__ import annotations

from pathlib import Path

import pytest

from ros2cc_extract.extract.launch.parameter_files import parameters_in
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.system.parameter_types import type_set
from tests.unit.launch.following import followed


@pytest.mark.parametrize(
    ('written', 'value', 'type_name'),
    [
        ('true', True, 'bool'),
        ('yes', True, 'bool'),
        ('OFF', False, 'bool'),
        ('10', 10, 'integer'),
        ('0x10', 16, 'integer'),
        ('-7', -7, 'integer'),
        ('10.0', 10.0, 'double'),
        ('1e3', 1000.0, 'double'),
        ('.inf', float('inf'), 'double'),
        ('fast', 'fast', 'string'),
        ('"10"', '10', 'string'),
        ("'true'", 'true', 'string'),
        ('!!str 5', '5', 'string'),
        ('null', 'null', 'string'),
        ('~', '~', 'string'),
        ('1_000', '1_000', 'string'),
        ('1:30', '1:30', 'string'),
        ('[1, 2]', (1, 2), 'integer array'),
        ('[a]', ('a',), 'string array'),
        ('[]', (), None),
        ('', None, None),
        # Where a text comes from is not seen any more: without quotes it would be a number.
        ('"1e3"', '1e3', None),
    ],
)
def test_a_value_is_what_rcl_reads(written: str, value: object, type_name: str | None) -> None:
    found = parameters_in(f'/**:\n  ros__parameters:\n    rate: {written}\n', 'file.yaml')
    assert not isinstance(found, Unknown)
    [given] = found
    assert (given.value, type(given.value)) == (value, type(value))
    assert type_set(given.value) == type_name


XML = """<launch><node pkg="p" exec="e">
<param name="sep" value="3, 4" value-sep=", "/>
<param name="float" value="3" type="float"/>
<param name="no_number" value="x" type="int"/>
<param name="texts" value="2;5" value-sep=";" type="list_of_str"/>
<param name="list" value="[2.5]" type="list_of_float"/>
<param name="plain" value="3"/>
</node></launch>"""
YAML = """
launch:
- arg: {name: n, default: '4'}
- node:
    pkg: p
    exec: e
    param:
    - {name: list, value: [3, 4]}
    - {name: texts, value: ['3', "4"]}
    - {name: text, value: '3'}
    - {name: number, value: 3}
    - {name: read, value: '$(var n)'}
    - {name: kept, value: '$(var n)', type: str}
    - {name: read_each, value: ['$(var n)', '$(var n)']}
"""
PYTHON = """
    n = LaunchConfiguration('n', default='4')
    return LaunchDescription([Node(package='p', executable='e', parameters=[{
        'read': n, 'float': ParameterValue(n, value_type=float),
        'text': ParameterValue('4'), 'kept': ParameterValue(n, value_type=str),
        'each': [[n], [n, '0']], 'joined': [n, '0'], 'mixed': [1, 2.5]}])])
"""


@pytest.mark.parametrize(
    ('name', 'text', 'expected'),
    [
        (
            'a.launch.xml',
            XML,
            [(3, 4), 3.0, 'it is no int', ('2', '5'), (2.5,), 3],
        ),
        (
            'a.launch.yaml',
            YAML,
            [(3, 4), ('3', '4'), '3', 3, 4, '4', (4, 4)],
        ),
        ('a.launch.py', PYTHON, [4, 4.0, '4', '4', (4, 40), 40, (1.0, 2.5)]),
    ],
)
def test_a_parameter_has_the_type_that_launch_gives_it(
    name: str, text: str, expected: list[object], tmp_path: Path
) -> None:
    [process] = followed(tmp_path, text, name).processes
    values = [
        each.value.reason if isinstance(each.value, Unknown) else each.value
        for each in process.parameters
    ]
    assert [(value, type(value)) for value in values] == [(e, type(e)) for e in expected]
