"""The picture of a unit: the executor around its groups, the groups around their callbacks."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from html import escape

from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.report.html.findings import Numbered
from ros2cc_extract.report.html.parts import SEVERITY_WORDS, items, span, tag
from ros2cc_extract.report.html.runs import COLOURS
from ros2cc_extract.report.text.spec import describe_executor, short
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.display_names import display_names
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import Callback, CallbackGroup, EntityKind, GroupType, Spec, When

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


def unit_picture(spec: Spec, anchor: str, findings: Numbered) -> str:
    """
    Draw one unit; arrows of waits are laid over it by the script.

    :param anchor: of the unit; those of its callbacks begin with it.
    """
    unit = _Unit(spec, anchor, findings)
    boxes = ''.join(
        _group_box(unit, group, members)
        for group in spec.groups
        if (members := [c for c in unit.written if c.group == group.name])
    )
    hidden = len(spec.callbacks) - len(unit.written)
    more = f'and {hidden} {"entity" if hidden == 1 else "entities"} that rclpy itself adds'
    return tag(
        'div',
        tag(
            'div',
            tag('div', escape(describe_executor(spec.executor)), class_='executor-name'),
            tag('div', *(span('thread', thread) for thread in spec.executor.threads)),
            class_='executor-head',
        ),
        tag('div', boxes, class_='groups'),
        tag('p', more, class_='quiet') if hidden else '',
        class_='executor',
    )


@dataclass(frozen=True)
class _Unit:
    spec: Spec
    anchor: str
    findings: Numbered

    @cached_property
    def written(self) -> list[Callback]:
        """Callbacks of the user."""
        return [callback for callback in self.spec.callbacks if not callback.builtin]

    @cached_property
    def numbers(self) -> dict[str, int]:
        """Of each callback, as the model counts them."""
        return {callback.name: n for n, callback in enumerate(self.spec.callbacks)}

    @cached_property
    def names(self) -> Mapping[str, str]:
        """Words by name, of callbacks and groups."""
        return display_names(self.spec)

    @cached_property
    def chips(self) -> dict[str, str]:
        """The anchors of the callbacks that are drawn."""
        return {c.name: f'{self.anchor}-{self.numbers[c.name]}' for c in self.written}


def _group_box(unit: _Unit, group: CallbackGroup, members: Sequence[Callback]) -> str:
    kind = group.type.value.lower()
    classes = f'group {"outside" if group.groupless else kind}'
    return tag(
        'section',
        tag(
            'header',
            tag('b', escape('in no group' if group.groupless else unit.names[group.name])),
            span('kind', _group_kind(group)),
            _place(group.source),
        ),
        *(_chip(unit, callback) for callback in members),
        class_=classes + (' unresolved' if group.unresolved else ''),
    )


def _group_kind(group: CallbackGroup) -> str:
    if group.groupless:
        return 'tasks, done-callbacks, execute'
    if group.unresolved:
        return f'not resolved: {group.unresolved.reason}'
    return 'mutually exclusive' if group.type is GroupType.EXCLUSIVE else 'reentrant'


def _chip(unit: _Unit, callback: Callback) -> str:
    about = [(number, f) for number, f in unit.findings if callback.name in f.subjects]
    letter = _LETTERS.get(callback.entity, '·') if callback.entity else callback.type.value[0]
    waits = [unit.chips[block.on] for block in callback.blocking if block.on in unit.chips]
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
        items((_wait(block, unit.names) for block in callback.blocking), 'waits'),
        _place(callback.defined or callback.source),
        class_='chip',
        id=unit.chips[callback.name],
        data_colour=str(unit.numbers[callback.name] % COLOURS),
        **({'data_waits': ' '.join(waits)} if waits else {}),
    )


def _badge(number: int, finding: Finding) -> str:
    kind = SEVERITY_WORDS[finding.severity]
    return tag('a', finding.code, class_=f'badge {kind}', href=f'#finding-{number}')


def _wait(block: Blocking, names: Mapping[str, str]) -> str:
    how_long = f' {block.seconds:g} s' if isinstance(block.seconds, float) else ''
    on = f' → {names.get(block.on, block.on)}' if isinstance(block.on, str) else ''
    return f'{escape(block.call)}{how_long}{escape(on)}'


def _place(place: Place | None) -> str:
    return span('place', short(place)) if place else ''


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
