"""Units as a Mermaid flow chart: executor, groups as boxes, callbacks, and their waits."""

from __future__ import annotations

from collections.abc import Container, Iterator, Sequence

from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.report.text.spec import describe_executor
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.model import Callback, CallbackGroup, GroupType, Spec
from ros2cc_extract.text_escaping import printable

CHANGED = 'stroke:#c62828,stroke-width:3px'
"""Style of what is not the same on both sides."""


def units_diagram(units: Sequence[Spec], *, builtin: bool = False) -> str:
    """
    Draw units in one chart, each in a box of its own where there are several.

    :param builtin: also draw what rclpy itself adds to every node.
    """
    units = printable(units)
    if len(units) == 1:
        chart = _Chart(units[0], 'n_', builtin=builtin)
        return _document([*chart.lines(), *chart.styles()])
    lines, styles = _boxes([(f'unit {unit.name}', [unit]) for unit in units], (), builtin=builtin)
    return _document([*lines, *styles])


def sides_diagram(sides: Sequence[tuple[str, Sequence[Spec]]], changed: Container[str]) -> str:
    """
    Draw each side in a box under its title, in their order.

    :param changed: names of callbacks, groups and executors to be marked.
    """
    lines, styles = _boxes(printable(sides), changed)
    # An unseen link keeps Mermaid from drawing the last side first.
    links = [f'    side_{number - 1} ~~~ side_{number}' for number in range(1, len(sides))]
    return _document([*lines, *links, *styles])


def _boxes(
    boxes: Sequence[tuple[str, Sequence[Spec]]], changed: Container[str], *, builtin: bool = False
) -> tuple[list[str], list[str]]:
    """Write boxes and, apart from these, styles."""
    lines: list[str] = []
    styles: list[str] = []
    for number, (title, units) in enumerate(boxes):
        lines.append(f'    subgraph side_{number}["{_quoted(title)}"]')
        for place, unit in enumerate(units):
            chart = _Chart(unit, f's{number}u{place}_', changed, builtin=builtin)
            lines += (f'    {line}' for line in chart.lines())
            styles += chart.styles()
        lines.append('    end')
    return lines, styles


def _document(lines: Sequence[str]) -> str:
    return '\n'.join(['flowchart LR', *lines]) + '\n'


@dataclass(frozen=True)
class _Chart:
    """
    One unit; groups without members are left out.

    :param prefix: of its names, which keeps them from being read as words of Mermaid such as
        ``end``, and apart from those of other units.
    """

    unit: Spec
    prefix: str
    changed: Container[str] = ()
    builtin: bool = False

    @property
    def callbacks(self) -> list[Callback]:
        """Those that are drawn."""
        return [c for c in self.unit.callbacks if self.builtin or not c.builtin]

    @property
    def groups(self) -> list[CallbackGroup]:
        """Those that are drawn."""
        used = {callback.group for callback in self.callbacks}
        return [group for group in self.unit.groups if group.name in used]

    def lines(self) -> Iterator[str]:
        """Nodes, boxes and arrows."""
        executor = f'{self.prefix}executor'
        yield f'    {executor}(["{_quoted(describe_executor(self.unit.executor))}"])'
        for group in self.groups:
            yield f'    subgraph {self.prefix}{group.name}["{_quoted(_group_title(group))}"]'
            for callback in self.callbacks:
                if callback.group == group.name:
                    name = self.prefix + callback.name
                    yield f'        {name}["{_quoted(_callback_title(callback))}"]'
            yield '    end'
            yield f'    {executor} --> {self.prefix}{group.name}'
        yield from self._waits()

    def _waits(self) -> Iterator[str]:
        """One arrow for each call that waits for another callback, however often it is there."""
        names = {callback.name for callback in self.callbacks}
        for callback in self.callbacks:
            others = names - {callback.name}
            waits = [(b.call, b.on) for b in callback.blocking if b.on in others]
            for call, on in dict.fromkeys(waits):
                ends = f'-. "{_quoted(call)}" .-> {self.prefix}{on}'
                yield f'    {self.prefix}{callback.name} {ends}'

    def styles(self) -> Iterator[str]:
        """Reentrant groups are dashed; what has changed has a frame."""
        named = {self.unit.executor.name: f'{self.prefix}executor'}
        members = [each.name for each in self.groups] + [each.name for each in self.callbacks]
        named |= {name: self.prefix + name for name in members}
        for group in self.groups:
            if group.type is GroupType.REENTRANT and group.name not in self.changed:
                yield f'    style {named[group.name]} stroke-dasharray: 5 5'
        dashed = {group.name for group in self.groups if group.type is GroupType.REENTRANT}
        for name, drawn in named.items():
            if name in self.changed:
                dash = ',stroke-dasharray: 5 5' if name in dashed else ''
                yield f'    style {drawn} {CHANGED}{dash}'


def _group_title(group: CallbackGroup) -> str:
    if group.groupless:
        return 'in no group'
    kind = 'mutually exclusive' if group.type is GroupType.EXCLUSIVE else 'reentrant'
    return f'{group.name}: {"not resolved" if group.unresolved else kind}'


def _callback_title(callback: Callback) -> str:
    kind = callback.entity.value.replace('_', ' ') if callback.entity else callback.type.value
    name = callback.display_name
    # A client is called by its service, and has no more to say.
    return name if name.startswith(f'{kind} ') else f'{name}<br/>{kind}{_subject(callback)}'


def _subject(callback: Callback) -> str:
    value = callback.period_s if callback.period_s is not None else callback.key
    if value is None:
        return ''
    if isinstance(value, Unknown):
        return ' ?'
    return f' every {value:g} s' if isinstance(value, float) else f' {value}'


def _quoted(text: str) -> str:
    return text.replace('&', '#amp;').replace('"', '#quot;')
