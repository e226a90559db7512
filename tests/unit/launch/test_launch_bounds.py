"""
Launch files that are small and stand for more than the limits allow: reported, at little cost.

Without their bounds none of them comes to an end before the time limit of a test.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.attack import launch_bombs
from tests.attack.launch_bombs import Bomb
from tests.unit.launch.following import followed, lines

SIZE = 40
LARGE = 'launch file is too large to be followed'
WORDS = {
    'texts_that_double': 'texts of the launch are too long to be put together',
    'aliases_that_double': 'the YAML holds too much by its aliases',
    'lists_of_actions_that_double': 'it is too long to be followed',
    'substitutions_that_double': 'it is too long to be followed',
    'functions_that_return_themselves': LARGE,
    'handlers_of_each_other': 'it is nested too deeply',
    'nodes_without_number': 'launch starts more than can be followed',
}


@pytest.mark.parametrize('name', WORDS)
def test_what_is_too_large_is_told(name: str, tmp_path: Path) -> None:
    bomb: Bomb = getattr(launch_bombs, name)(SIZE)
    found = followed(tmp_path, bomb[1].removeprefix(launch_bombs.HEAD), bomb[0])
    said = [each.message for each in found.noticed]
    said += [str(why) for each in found.processes for _, why in each.open]
    said += [str(each.name) for each in found.processes]
    assert any(WORDS[name] in each for each in said), said[:3]


def test_as_many_processes_as_robots_have(tmp_path: Path) -> None:
    nodes = ''.join(f'<node pkg="p" exec="e" name="n{n}"/>' for n in range(900))
    assert len(lines(followed(tmp_path, f'<launch>{nodes}</launch>', 'a.launch.xml'))) == 900


def test_a_parameter_file_that_cannot_be_read_leaves_the_parameters_open(tmp_path: Path) -> None:
    node = '<node pkg="p" exec="e"><param from="$(dirname)/p.yaml"/></node>'
    xml = f'<launch>{node}</launch>'
    folder = tmp_path / 'robot' / 'launch'
    folder.mkdir(parents=True)
    for text, told in (
        ('/**:\n  ros__parameters: {a: 1}\n', ['node p e a=1']),
        ('#' * 1_000_001, ['node p e ?parameters']),
        ('/**: &a\n  ros__parameters: *a\n', ['node p e ?parameters']),
        ('[' * 1_000, ['node p e ?parameters']),
    ):
        (folder / 'p.yaml').write_text(text)
        assert lines(followed(tmp_path, xml, 'a.launch.xml')) == told


def test_names_that_ros_does_not_take_are_open(tmp_path: Path) -> None:
    xml = """<launch>
      <node pkg="p" exec="a" name="{long}"/>
      <node pkg="p" exec="b" namespace="{most}"><remap from="{long}" to="x"/></node>
      <group><push-ros-namespace namespace="{most}"/><node pkg="p" exec="c" namespace="n"/></group>
    </launch>"""
    text = xml.format(long='x' * 256, most='y' * 254)
    assert lines(followed(tmp_path, text, 'a.launch.xml')) == [
        'node p a name=?',
        f'node p b ns=/{"y" * 254} ?remappings',
        'node p c ns=?',
    ]
