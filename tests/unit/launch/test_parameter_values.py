"""Values of parameter files, as rcl reads them; each was put to the rclpy of Jazzy and Kilted."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.launch.parameter_files import parameters_in
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.system.parameter_types import type_set


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
