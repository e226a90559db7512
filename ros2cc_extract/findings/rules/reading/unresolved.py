"""CC501: a fact of a unit that could not be found out."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Context, Hit, Rule
from ros2cc_extract.findings.base.wording import listing
from ros2cc_extract.findings.rules.configuration.not_served import EXECUTOR, is_not_served
from ros2cc_extract.source_locations import Place

ENTITIES = 'entities'
"""The fact that is missing where something was not followed to its end."""


def find(context: Context) -> Iterator[Hit]:
    """One finding for all subjects that lack a fact for one reason at one place."""
    unit = context.unit
    unnamed = Place(unit.sources[0] if unit.sources else unit.name)
    subjects: dict[tuple[Place, str, str], list[str]] = {}
    not_served = is_not_served(context)
    for fact in unit.unresolved:
        is_of_executor = fact.fact == EXECUTOR and fact.subject == unit.executor.name
        if is_of_executor and not_served:
            continue  # that is CC407
        alike = (fact.source or unnamed, fact.fact, fact.reason)
        subjects.setdefault(alike, []).extend(
            unit.nodes if is_of_executor and unit.nodes else (fact.subject,)
        )
    for (place, what, reason), names in subjects.items():
        yield Hit(
            place=place,
            message=f'{what} of {listing(names)} not resolved: {reason}',
            subjects=tuple(dict.fromkeys(names)),
            cause=reason if what == ENTITIES else f'{what}: {reason}',
        )


RULE = Rule(
    code='CC501',
    slug='unresolved',
    severity=Severity.NOTE,
    title='Fact not resolved',
    what='A callback, group, executor or one of their properties could not be followed in the '
    'source. Rules that depend on it report nothing, and models state what was assumed instead.',
    why='Python allows what no scanner can follow: groups from parameters, executors from '
    'factories, names computed at run time. The scanner never guesses: an unknown group is not '
    'the default group.',
    bad="""\
class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.create_timer(0.1, self.tick, callback_group=make_group(self.get_parameter('g')))
""",
    good="""\
class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.create_timer(0.1, self.tick, callback_group=ReentrantCallbackGroup())
""",
    mend='Nothing has to be mended. Where the fact matters, write it more directly, or record '
    'the running node by `ros2cc-extract run`.',
    find=find,
)
