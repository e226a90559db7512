"""The picture of a unit: the executor around its groups, the groups around their callbacks."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from html import escape

from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.report.html.parts import (
    SEVERITY_WORDS,
    items,
    place_text,
    plural,
    span,
    tag,
)
from ros2cc_extract.report.text.spec import describe_executor
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import Callback, CallbackGroup, EntityKind, GroupType, Spec, When

Numbered = Sequence[tuple[int, Finding]]
"""The findings of the page with their numbers, which are their anchors."""

_LETTERS = {
    EntityKind.TIMER: 'T',
    EntityKind.SUBSCRIPTION: 'S',
    EntityKind.SERVICE: 'V',
    EntityKind.CLIENT: 'C',
    EntityKind.GUARD_CONDITION: 'G',
    EntityKind.ACTION_SERVER: 'A',
    EntityKind.ACTION_CLIENT: 'A',
    EntityKind.ACTION_EXECUTE: 'E',
    EntityKind.DONE_CALLBACK: 'D',
    EntityKind.TASK: 'K',
}


def unit_picture(spec: Spec, findings: Numbered) -> str:
    """Draw one unit; arrows of waits are laid over it by the script."""
    written = [callback for callback in spec.callbacks if not callback.builtin]
    numbers = {callback.name: n for n, callback in enumerate(spec.callbacks)}
    boxes = ''.join(
        _group_box(spec, group, members, findings, numbers)
        for group in spec.groups
        if (members := [c for c in written if c.group == group.name])
    )
    hidden = len(spec.callbacks) - len(written)
    more = f'{plural(hidden, "entity").replace("entitys", "entities")} that rclpy itself adds'
    return tag(
        'div',
        tag(
            'div',
            tag('div', escape(describe_executor(spec.executor)), class_='executor-name'),
            tag('div', *(span('thread', thread) for thread in spec.executor.threads)),
            class_='executor-head',
        ),
        tag('div', boxes, class_='groups'),
        tag('p', escape(f'and {more}'), class_='quiet') if hidden else '',
        class_='executor',
    )


def _group_box(
    spec: Spec,
    group: CallbackGroup,
    members: Sequence[Callback],
    findings: Numbered,
    numbers: dict[str, int],
) -> str:
    chips = ''.join(_chip(spec, c, findings, numbers) for c in members)
    kind = group.type.value.lower()
    classes = f'group {"outside" if group.groupless else kind}'
    return tag(
        'section',
        tag(
            'header',
            tag('b', escape('in no group' if group.groupless else group.name)),
            span('kind', _group_kind(group)),
            place_text(group.source),
        ),
        chips,
        class_=classes + (' unresolved' if group.unresolved else ''),
    )


def _group_kind(group: CallbackGroup) -> str:
    if group.groupless:
        return 'tasks, done-callbacks, execute'
    if group.unresolved:
        return f'not resolved: {group.unresolved.reason}'
    kind = 'mutually exclusive' if group.type is GroupType.EXCLUSIVE else 'reentrant'
    return f'{kind}, default group' if group.default else kind


def _chip(spec: Spec, callback: Callback, findings: Numbered, numbers: dict[str, int]) -> str:
    identity = f'{spec.name}-{callback.name}'
    about = [(number, f) for number, f in findings if callback.name in f.subjects]
    letter = _LETTERS.get(callback.entity, '·') if callback.entity else callback.type.value[0]
    return tag(
        'div',
        tag(
            'div',
            span('letter', letter),
            tag('b', escape(callback.display_name), title=callback.function or callback.name),
            *(_badge(number, finding) for number, finding in about),
            class_='chip-head',
        ),
        tag('div', escape(' '.join(_subject(callback))), class_='subject'),
        items((_wait(block) for block in callback.blocking), 'waits'),
        place_text(callback.defined or callback.source),
        class_='chip',
        id=identity,
        data_colour=str(numbers[callback.name] % 8),
        data_waits=' '.join(f'{spec.name}-{on}' for on in _awaited(spec, callback)),
    )


def _badge(number: int, finding: Finding) -> str:
    kind = SEVERITY_WORDS[finding.severity]
    return tag('a', finding.code, class_=f'badge {kind}', href=f'#finding-{number}')


def _awaited(spec: Spec, callback: Callback) -> list[str]:
    names = {other.name for other in spec.callbacks if not other.builtin}
    return [str(block.on) for block in callback.blocking if block.on in names]


def _wait(block: Blocking) -> str:
    how_long = f' {block.seconds:g} s' if isinstance(block.seconds, float) else ''
    on = f' → {block.on}' if isinstance(block.on, str) else ''
    return f'{escape(block.call)}{how_long}{escape(on)}'


def _subject(callback: Callback) -> Iterator[str]:
    yield callback.entity.value.replace('_', ' ') if callback.entity else callback.type.value
    value = callback.period_s if callback.period_s is not None else callback.key
    if isinstance(value, Unknown):
        yield '?'
    elif isinstance(value, float):
        yield f'every {value:g} s'
    elif value is not None:
        yield value
    if callback.count != 1:
        yield '× ?' if isinstance(callback.count, Unknown) else f'× {callback.count}'
    marks = (
        (callback.conditional, 'conditional'),
        (callback.when is not When.START, 'created later'),
        (callback.coroutine, 'coroutine'),
        (callback.one_shot, 'one-shot'),
        (callback.library is not None, f'made by {callback.library}'),
    )
    yield from (f'· {text}' for holds, text in marks if holds)
