"""Names in the graph: expansion, remaps, and which nearly are the same."""

from __future__ import annotations

import pytest

from ros2cc_extract.spec.system.names import (
    Naming,
    Remap,
    expanded,
    joined_namespace,
    naming,
    read_remap,
)
from ros2cc_extract.spec.system.near_names import how_near
from ros2cc_extract.spec.system.parameters import matches


@pytest.mark.parametrize(
    ('name', 'whole'),
    [
        ('chat', '/left/chat'),
        ('/chat', '/chat'),
        ('~', '/left/arm'),
        ('~/chat', '/left/arm/chat'),
        ('deep/chat', '/left/deep/chat'),
    ],
)
def test_a_name_is_expanded(name: str, whole: str) -> None:
    assert expanded(name, 'left', 'arm') == whole


@pytest.mark.parametrize(
    ('base', 'pushed', 'whole'),
    [('', 'a', '/a'), ('/a', 'b', '/a/b'), ('/a', '/b', '/b'), ('/a', '', '/a'), ('/', 'b', '/b')],
)
def test_namespaces_are_joined(base: str, pushed: str, whole: str) -> None:
    assert joined_namespace(base, pushed) == whole


def rules(*texts: str) -> Naming:
    found = [read_remap(text) for text in texts]
    return naming('arm', 'left', [each for each in found if each is not None])


@pytest.mark.parametrize(
    ('texts', 'name', 'whole'),
    [
        (['chat:=talk'], 'chat', '/left/talk'),
        (['/left/chat:=/talk'], 'chat', '/talk'),
        (['chat:=talk'], '/left/chat', '/left/talk'),
        (['chat:=one', 'chat:=two'], 'chat', '/left/one'),
        (['chat:=~/talk'], 'chat', '/left/arm/talk'),
        (['__ns:=/right', 'chat:=talk'], 'chat', '/right/talk'),
        (['__node:=hand', '~/chat:=talk'], '~/chat', '/left/talk'),
        (['other:chat:=talk'], 'chat', '/left/chat'),
        (['arm:chat:=talk'], 'chat', '/left/talk'),
        (['rosservice://chat:=talk'], 'chat', '/left/chat'),
        (['rostopic://chat:=talk'], 'chat', '/left/talk'),
    ],
)
def test_the_first_rule_that_matches_renames(texts: list[str], name: str, whole: str) -> None:
    assert rules(*texts).resolved(name) == whole


def test_rules_name_the_node_itself() -> None:
    assert rules('__node:=hand', '__ns:=/right/').full_name == '/right/hand'
    assert rules('__name:=hand').full_name == '/left/hand'
    assert rules('arm:__node:=hand').full_name == '/left/hand'
    assert rules('other:__node:=hand').full_name == '/left/arm'
    assert read_remap('a:=b') == Remap(old='a', new='b')
    assert read_remap('no rule') is None


@pytest.mark.parametrize(
    ('one', 'other', 'why'),
    [
        ('/plan', '/plan', None),
        ('/plan', '/arm/plan', 'the namespace'),
        ('/arm/plan', '/arm/left/plan', 'the namespace'),
        ('/left/plan', '/right/plan', None),
        ('/arm/plan', '/armplan', 'a slash'),
        ('/plan', '/plaan', 'one letter'),
        ('/plan', '/paln', 'one letter'),
        ('/plan', '/plam', 'one letter'),
        ('/Plan', '/plan', 'upper and lower case'),
        ('/camera1', '/camera2', None),
        ('/a', '/b', None),
        ('/arm/~/plan', '/arm/plan', "a '~' that is not at the start"),
        ('/cmd_vel', '/odom', None),
    ],
)
def test_which_names_are_near(one: str, other: str, why: str | None) -> None:
    assert how_near(one, other) == how_near(other, one) == why


@pytest.mark.parametrize(
    ('pattern', 'name', 'holds'),
    [
        ('/**', '/a/b', True),
        ('/**/b', '/b', True),
        ('/**/b', '/a/c/b', True),
        ('/*/b', '/a/b', True),
        ('/*/b', '/a/c/b', False),
        ('/a/b', '/a/b', True),
        ('b', '/b', True),
        ('b', '/a/b', False),
    ],
)
def test_patterns_of_parameter_files(pattern: str, name: str, *, holds: bool) -> None:
    assert matches(pattern, name) is holds
