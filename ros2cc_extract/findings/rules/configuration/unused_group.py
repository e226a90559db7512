"""CC404: a callback group in which nothing is."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Context, Hit, Rule
from ros2cc_extract.findings.rules.configuration.groups_on_one_thread import is_made
from ros2cc_extract.source_locations import Place

_HIDING = frozenset({'entities', 'group', 'function', 'node'})
"""Facts that may hide an entity, or which group one is in, where they are missing."""


def find(context: Context) -> Iterator[Hit]:
    """Where something could not be followed, the group may well be used there."""
    if any(fact.fact in _HIDING for fact in context.unit.unresolved):
        return
    used = {callback.group for callback in context.unit.callbacks}
    unused: dict[Place, list[str]] = {}
    for group in context.unit.groups:
        if group.name not in used and is_made(group) and group.source is not None:
            unused.setdefault(group.source, []).append(group.name)
    for place, names in unused.items():
        yield _hit(place, names)


def _hit(place: Place, names: Sequence[str]) -> Hit:
    """One for all groups that one line makes, as that of a class of several nodes."""
    what = f'any of the {len(names)} groups made here' if names[1:] else f'group {names[0]!r}'
    return Hit(
        place=place,
        message=f'no callback uses {what}',
        help='pass it as callback_group, or leave it out',
        subjects=tuple(names),
    )


RULE = Rule(
    code='CC404',
    slug='unused-group',
    severity=Severity.WARNING,
    title='Unused callback group',
    what='A callback group is created, but no entity uses it. Most often the argument '
    '`callback_group=` was forgotten, and the entity is in the default group.',
    why='Only the argument `callback_group` puts an entity into a group; without it, the entity '
    'is in the default group. Source: rclpy 7.1.6 and 9.1.2, `node.py` (`create_timer`, '
    '`create_subscription` …).',
    bad="""\
class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.group = ReentrantCallbackGroup()
        self.create_timer(0.1, self.control)
""",
    good="""\
class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.group = ReentrantCallbackGroup()
        self.create_timer(0.1, self.control, callback_group=self.group)
""",
    mend='Pass the group as `callback_group=`, or leave it out.',
    find=find,
)
