"""Small units, written by hand, and what the rules say of them."""

from __future__ import annotations

from typing import Any

from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.findings.collect import findings_of
from ros2cc_extract.findings.waits.workers import DEFAULT_COUNT, EVENTS, MULTI, SINGLE
from ros2cc_extract.generator.template_files import Profile
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.close import close
from ros2cc_extract.spec.effects import Access, Blocking
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    EntityKind,
    Executor,
    GroupType,
    Spec,
    Unresolved,
)
from ros2cc_extract.verify.results.results import Verification
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.unit import verify_unit

FILE = 'arm.py'
ONE_THREAD = Executor(name='executor', kind=SINGLE, threads=('thread_0',))
EVENTS_EXECUTOR = Executor(name='executor', kind=EVENTS, threads=('thread_0',))
NOT_FOUND = Executor(
    name='executor', kind=Unknown('no executor in this file'), threads=('thread_0',)
)


def at(line: int, column: int = 9) -> Place:
    return Place(FILE, line, column)


def threads(number: int, **facts: Any) -> Executor:
    names = tuple(f'thread_{index}' for index in range(number))
    return Executor(name='executor', kind=MULTI, threads=names, source=at(90), **facts)


def default_threads(number: int) -> Executor:
    return threads(number, threads_source=DEFAULT_COUNT)


def exclusive(name: str, **facts: Any) -> CallbackGroup:
    return CallbackGroup(name=name, type=GroupType.EXCLUSIVE, **facts)


def reentrant(name: str, **facts: Any) -> CallbackGroup:
    return CallbackGroup(name=name, type=GroupType.REENTRANT, **facts)


DEFAULT = exclusive('arm_default', default=True, node='arm')
OTHER = exclusive('other', source=at(5))
FREE = reentrant('free', source=at(6))
OUTSIDE = reentrant('no_group', groupless=True)


def callback(name: str, kind: EntityKind, group: str = 'arm_default', **facts: Any) -> Callback:
    return Callback(
        name=name,
        type=kind.published_type,
        entity=kind,
        group=group,
        node=facts.pop('node', 'arm'),
        **facts,
    )


def timer(name: str, group: str = 'arm_default', **facts: Any) -> Callback:
    return callback(name, EntityKind.TIMER, group, **facts)


def subscription(name: str, group: str = 'arm_default', **facts: Any) -> Callback:
    return callback(name, EntityKind.SUBSCRIPTION, group, **facts)


def service(name: str, group: str = 'arm_default', **facts: Any) -> Callback:
    return callback(name, EntityKind.SERVICE, group, **facts)


def client(name: str, group: str = 'arm_default', **facts: Any) -> Callback:
    return callback(name, EntityKind.CLIENT, group, key=facts.pop('key', 'plan'), **facts)


def outside(name: str, kind: EntityKind, **facts: Any) -> Callback:
    return callback(name, kind, 'no_group', groupless=True, **facts)


def calls(on: str | Unknown | None, line: int = 40, **facts: Any) -> tuple[Blocking, ...]:
    call = facts.pop('call', 'client.call')
    return (Blocking(call=call, on=on, source=at(line), **facts),)


def sleeps(seconds: float, line: int = 50) -> tuple[Blocking, ...]:
    return (Blocking(call='time.sleep', seconds=seconds, source=at(line)),)


def updates(name: str, line: int, *locks: str) -> tuple[Access, ...]:
    return (Access(name=name, source=at(line), locks=locks, update=True),)


def writes(name: str, line: int, *locks: str) -> tuple[Access, ...]:
    return (Access(name=name, source=at(line), locks=locks),)


def appends(name: str, line: int) -> tuple[Access, ...]:
    return (Access(name=name, source=at(line), update=True, in_place=True),)


def unit(
    executor: Executor,
    *callbacks: Callback,
    groups: tuple[CallbackGroup, ...] = (DEFAULT, OTHER, FREE, OUTSIDE),
    unresolved: tuple[Unresolved, ...] = (),
) -> Spec:
    """One unit of node ``arm``; groups without members are left out."""
    used = {callback.group for callback in callbacks}
    return Spec(
        name='arm',
        nodes=('arm',),
        sources=(FILE,),
        callbacks=callbacks,
        groups=tuple(group for group in groups if group.name in used),
        executor=executor,
        unresolved=unresolved,
    )


def verified(spec: Spec) -> Verification:
    """What the model says of a unit, for those rules that go by it."""
    return verify_unit(close(spec), Options(profile=Profile.RCLPY, structural=False))


def found(spec: Spec, verification: Verification | None = None) -> list[str]:
    """Codes and lines of all findings, as ``CC101:40``, with ``note`` where it is one."""
    return [_short(finding) for finding in findings_of([spec], [], [verification])]


def only(spec: Spec, code: str, verification: Verification | None = None) -> Finding:
    """The one finding with ``code``."""
    (finding,) = [f for f in findings_of([spec], [], [verification]) if f.code == code]
    return finding


def _short(finding: Finding) -> str:
    weight = '' if finding.severity.value == 'error' else f' {finding.severity.value}'
    return f'{finding.code}:{finding.place.line}{weight}'
