"""Snapshots of processes that hang, made by hand."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ros2cc_extract.extract.live.hang_analysis.frame_waits import Kind, Wait
from ros2cc_extract.extract.live.hang_analysis.samples import (
    Activity,
    Entity,
    Executor,
    Frame,
    Look,
)
from ros2cc_extract.extract.live.hang_analysis.wait_for_graph import (
    Explanation,
    Standing,
    Verdict,
)

SINGLE, POOL = 'SingleThreadedExecutor', 'MultiThreadedExecutor'


def entity(number: int, kind: str, group: int, **given: Any) -> Entity:
    values: dict[str, Any] = {
        'cls': kind,
        'node': '/n',
        'simulated_clock': False,
        'exclusive': True,
        'active': None,
        'function': f'N.f{number}',
        'module': 'program',
        'place': None,
        'key': None,
        'domain': 0,
        'there': True,
        'servers': None,
        'pending': frozenset(),
        'ready': False,
        'cancelled': False,
    }
    return Entity(number=number, kind=kind, group=group, **(values | given))


def stands(
    of: int | None,
    kind: Kind,
    resource: int | None,
    ident: int | None = 100,
    *,
    file: str = 'node.py',
    function: str = 'f',
    reasons: tuple[str, ...] = (),
) -> Standing:
    """Give a callback that waits; without ``ident`` a coroutine that is suspended."""
    frame = Frame(
        number=1,
        file=file,
        function=function,
        called=function,
        module='program',
        line=1,
        at=1,
        position=None,
        item=None,
        objects={},
        endless=True,
        entity=of,
    )
    activity = Activity(name='t', frames=(frame,), ident=ident, entity=of)
    wait = Wait(kind, resource)
    return Standing(activity, wait, moved=False, can_end=False, reasons=reasons)


def hang(
    entities: Sequence[Entity],
    *standings: Standing,
    cls: str = POOL,
    workers: int | None = 2,
    **given: Any,
) -> Explanation:
    served = frozenset(each.number for each in entities)
    executor = Executor(
        number=900,
        cls=cls,
        workers=workers if cls == POOL else None,
        pool=None,
        entities=served,
        nodes=('/n',),
        spun=True,
    )
    values: dict[str, Any] = {
        'main': 1,
        'nodes': ('/n',),
        'activities': tuple(each.activity for each in standings),
        'entities': {each.number: each for each in entities},
        'executors': (executor,),
        'objects': {},
        'unread': (),
    }
    return Explanation(7, Verdict.DEADLOCK, standings, Look(**(values | given)))
