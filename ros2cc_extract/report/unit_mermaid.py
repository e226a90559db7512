"""A unit as a Mermaid flow chart: executor, groups as boxes, callbacks, and who waits for whom."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.places import Unknown
from ros2cc_extract.report.spec_text import describe_executor
from ros2cc_extract.spec.model import Callback, CallbackGroup, GroupType, Spec


def unit_diagram(spec: Spec, *, builtin: bool = False) -> str:
    """
    Draw one unit; groups without members are left out.

    :param builtin: also draw what rclpy itself adds to every node.
    """
    callbacks = [c for c in spec.callbacks if builtin or not c.builtin]
    lines = ['flowchart LR', f'    executor(["{_quoted(describe_executor(spec.executor))}"])']
    for group in spec.groups:
        members = [callback for callback in callbacks if callback.group == group.name]
        if members:
            lines += _box(group, members)
            lines.append(f'    executor --> {_id(group.name)}')
    lines += _waits(callbacks)
    lines += [f'    style {_id(g.name)} stroke-dasharray: 5 5' for g in _open(spec, callbacks)]
    return '\n'.join(lines) + '\n'


def _box(group: CallbackGroup, members: list[Callback]) -> Iterator[str]:
    yield f'    subgraph {_id(group.name)}["{_quoted(_group_title(group))}"]'
    for callback in members:
        yield f'        {_id(callback.name)}["{_quoted(_callback_title(callback))}"]'
    yield '    end'


def _group_title(group: CallbackGroup) -> str:
    if group.groupless:
        return 'in no group'
    kind = 'mutually exclusive' if group.type is GroupType.EXCLUSIVE else 'reentrant'
    return f'{group.name}: {"not resolved" if group.unresolved else kind}'


def _callback_title(callback: Callback) -> str:
    kind = callback.entity.value.replace('_', ' ') if callback.entity else callback.type.value
    return f'{callback.display_name}<br/>{kind}{_subject(callback)}'


def _subject(callback: Callback) -> str:
    value = callback.period_s if callback.period_s is not None else callback.key
    if value is None:
        return ''
    if isinstance(value, Unknown):
        return ' ?'
    return f' every {value:g} s' if isinstance(value, float) else f' {value}'


def _waits(callbacks: list[Callback]) -> Iterator[str]:
    names = {callback.name for callback in callbacks}
    for callback in callbacks:
        for block in callback.blocking:
            if isinstance(block.on, str) and block.on in names:
                call = _quoted(block.call)
                yield f'    {_id(callback.name)} -. "{call}" .-> {_id(block.on)}'


def _open(spec: Spec, callbacks: list[Callback]) -> list[CallbackGroup]:
    used = {callback.group for callback in callbacks}
    return [g for g in spec.groups if g.name in used and g.type is GroupType.REENTRANT]


def _id(name: str) -> str:
    """Keep a name from being read as a word of Mermaid, such as ``end``."""
    return f'n_{name}'


def _quoted(text: str) -> str:
    return text.replace('&', '#amp;').replace('"', '#quot;')
