"""XML and YAML launch files say the same as Python ones."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.unit.launch.following import followed, lines

XML = """\
<launch>
  <arg name="ns" default="x"/>
  <let name="there" value="b_$(var ns)"/>
  <group if="$(eval '2 &gt; 1')">
    <push-ros-namespace namespace="$(var ns)"/>
    <set_remap from="s" to="t"/>
    <node pkg="p" exec="e" name="n" args="--ros-args -p w:=5">
      <remap from="a" to="$(var there)"/>
      <param name="k" value="2"/>
      <param name="m"><param name="d" value="true"/></param>
    </node>
  </group>
  <node pkg="p" exec="off" unless="true"/>
  <node pkg="$(env HOME)" exec="e"/>
  <timer period="1.0"><executable cmd="python3 $(dirname)/x.py --fast"/></timer>
</launch>
"""
YAML = """\
launch:
  - arg:
      name: ns
      default: x
  - let: {name: there, value: b_$(var ns)}
  - group:
      - push_ros_namespace: {namespace: $(var ns)}
      - set_remap: {from: s, to: t}
      - node:
          pkg: p
          exec: e
          name: n
          args: --ros-args -p w:=5
          remap:
            - {from: a, to: $(var there)}
          param:
            - {name: k, value: 2}
            - name: m
              param:
                - {name: d, value: true}
  - node: {pkg: p, exec: 'off', unless: 'true'}
  - node: {pkg: $(env HOME), exec: e}
  - timer:
      period: 1.0
      children:
        - executable: {cmd: python3 $(dirname)/x.py --fast}
"""


@pytest.mark.parametrize(('name', 'text'), [('a.launch.xml', XML), ('a.launch.yaml', YAML)])
def test_both_forms_mean_the_same(name: str, text: str, tmp_path: Path) -> None:
    folder = tmp_path / 'robot' / 'launch'
    assert lines(followed(tmp_path, text, name)) == [
        'node p e name=n ns=/x s:=t a:=b_x w=5 k=2 m.d=True',
        'node environment variable HOME of the launch e',
        f'process python3 {folder}/x.py --fast after timer',
    ]


@pytest.mark.parametrize(
    ('name', 'text', 'why'),
    [
        ('a.launch.xml', '<launch><node', 'not followed: it is no XML'),
        (
            'a.launch.xml',
            '<!DOCTYPE l [<!ENTITY a "b">]><launch/>',
            'not followed: it has a document type',
        ),
        ('a.launch.xml', '<robot/>', 'not followed: its root is robot, not launch'),
        ('a.launch.xml', '<launch><new/></launch>', "not followed: element 'new' is not known"),
        ('a.launch.yaml', 'launch: [', 'not followed: it is no YAML'),
        ('a.launch.yaml', '- launch', 'not followed: its root is no single key'),
    ],
)
def test_what_is_no_launch_file_is_told(name: str, text: str, why: str, tmp_path: Path) -> None:
    found = followed(tmp_path, text, name)
    assert [each.message.partition(' (')[0] for each in found.noticed] == [why]


def test_a_quotation_that_is_not_closed_is_told(tmp_path: Path) -> None:
    text = """<launch><executable cmd="python3 'x.py"/></launch>"""
    (launched,) = followed(tmp_path, text, 'a.launch.xml').processes
    assert [(what, why.reason) for what, why in launched.open] == [
        ('command', 'a quotation in it is not closed')
    ]
