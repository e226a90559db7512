"""Which waits of set-ups no order of starting ends."""

from __future__ import annotations

import pytest

from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.node_graph import Endpoint, EndpointKind
from ros2cc_extract.spec.system.launched import Launched
from ros2cc_extract.spec.system.model import (
    Process,
    System,
    SystemAwaited,
    SystemEndpoint,
    SystemNode,
)
from ros2cc_extract.spec.system.start_up import start_circles, stuck_waits

Steps = str
"""``offers`` and ``waits`` of one process in their order: ``+a -b ?c`` (``?`` for an answer)."""


def process(name: str, steps: Steps) -> Process:
    places: list[Place] = []
    ends: list[SystemEndpoint] = []
    awaits: list[SystemAwaited] = []
    for number, step in enumerate(steps.split(), 1):
        place, what = Place(f'{name}.py', number), f'/{step[1:]}'
        if step[0] == '+':
            of = Endpoint(kind=EndpointKind.SERVICE, name=what, after=tuple(places))
            ends.append(SystemEndpoint(kind=of.kind, name=what, written=what, of=of))
        else:
            called = Unknown('computed') if what == '/open' else what
            is_answer = step[0] == '?'
            awaits.append(
                SystemAwaited(what='service', name=called, source=place, answers=is_answer)
            )
            places.append(place)
    node = SystemNode(name=f'/{name}', own_name=name, endpoints=tuple(ends), awaits=tuple(awaits))
    launched = Launched(kind='node', source=Place('a.launch.xml'))
    return Process(name=name, launched=launched, nodes=(node,))


def system(**steps: Steps) -> System:
    return System(name='s', processes=tuple(process(*each) for each in steps.items()))


def stuck(**steps: Steps) -> list[str]:
    return [
        f'{each.process.name}:{each.awaited.source.line}' for each in stuck_waits(system(**steps))
    ]


@pytest.mark.parametrize(
    ('steps', 'found'),
    [
        ({'a': '-y +x', 'b': '-x +y'}, ['a:1', 'b:1']),
        ({'a': '+x -y', 'b': '-x +y'}, []),
        ({'a': '-y +x', 'b': '+y -x'}, []),
        ({'a': '-y +x', 'b': '-z +y', 'c': '-x +z'}, ['a:1', 'b:1', 'c:1']),
        ({'a': '-y +x', 'b': '-z +y', 'c': '+z -x'}, []),
        ({'a': '-y +x', 'b': '-x +y', 'c': '+y'}, []),
        ({'a': '-y +x', 'b': '-x +y', 'c': '-x'}, ['a:1', 'b:1', 'c:1']),
        ({'a': '-x +x'}, ['a:1']),
        ({'a': '-nobody +x', 'b': '-x'}, []),
        ({'a': '-open +x', 'b': '-x'}, []),
        ({'a': '+x ?y', 'b': '+y ?x'}, ['a:2', 'b:2']),
        ({'a': '+x -y', 'b': '+y ?x'}, []),
        ({'a': '-y +x', 'b': '+y -x ?x'}, []),
        ({'a': '?x +y', 'b': '+x -y'}, ['a:1', 'b:2']),
    ],
)
def test_a_set_up_ends_where_what_it_waits_for_comes(
    steps: dict[str, Steps], found: list[str]
) -> None:
    assert stuck(**steps) == found


def test_a_circle_is_told_once_and_who_only_waits_for_it_is_in_none() -> None:
    found = start_circles(system(c='-x', a='-y +x', b='-x +y'))
    assert [[each.process.name for each in circle] for circle in found] == [['a', 'b']]
