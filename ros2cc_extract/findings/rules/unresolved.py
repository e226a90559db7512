"""CC501: a fact of a unit that could not be found out."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.rule import Context, Hit, Rule
from ros2cc_extract.places import Place


def find(context: Context) -> Iterator[Hit]:
    unit = context.unit
    for fact in unit.unresolved:
        yield Hit(
            place=fact.source or Place(unit.sources[0] if unit.sources else unit.name),
            message=f'{fact.fact} of {fact.subject} not resolved: {fact.reason}',
            subjects=(fact.subject,),
        )


RULE = Rule(
    code='CC501',
    slug='unresolved',
    severity=Severity.NOTE,
    title='Fact not resolved',
    what='A callback, group, executor or one of their properties could not be followed in the '
    'source. Rules that rest on it are silent, and models state what was assumed instead.',
    why='Python allows what no scanner can follow: groups from parameters, executors from '
    'factories, names computed at run time. Nothing is guessed: an unknown group is not the '
    'default group.',
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
