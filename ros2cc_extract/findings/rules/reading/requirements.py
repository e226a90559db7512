"""
Rules that speak for what a project demands in ``[tool.ros2cc]``; only the help text is here.

The demands are read and decided in ``findings/requirements.py``.
"""

from __future__ import annotations

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Rule

_TABLE = """\
[tool.ros2cc]
never_together = [["on_stop", "on_move"]]
can_overlap = [["on_image", "on_command"]]
never_starves = ["on_stop"]
"""
_WHY = (
    'The verdict is that of the model of the unit, which says under which assumptions it was '
    'made; a violation comes with a run that shows it.'
)

VIOLATED = Rule(
    code='CC601',
    slug='requirement-violated',
    severity=Severity.ERROR,
    title='Requirement violated',
    what='The project requires something of its callbacks, and the model of their unit refutes '
    'it. Callbacks of different executors may always overlap.',
    why=_WHY,
    bad=_TABLE,
    good="""\
commands = MutuallyExclusiveCallbackGroup()
node.create_subscription(Empty, 'stop', on_stop, 10, callback_group=commands)
node.create_subscription(Twist, 'move', on_move, 10, callback_group=commands)
""",
    mend='Change groups or threads until the model agrees, or change the requirement.',
    language='toml',
)
UNKNOWN_NAME = Rule(
    code='CC602',
    slug='requirement-about-nothing',
    severity=Severity.ERROR,
    title='Requirement about a callback that does not exist',
    what='The project requires something of a callback, and no unit has a callback of that name. '
    'A requirement that silently requires nothing would be worse than none.',
    why='A callback is named by its function (`on_stop`), by its qualified function name, or as '
    'in the output of `ros2cc-extract spec`.',
    bad="""\
[tool.ros2cc]
never_starves = ["on_stopp"]
""",
    good="""\
node.create_subscription(Empty, 'stop', on_stop, 10)
""",
    mend='Correct the name in `[tool.ros2cc]`.',
    language='toml',
)
UNDECIDED = Rule(
    code='CC603',
    slug='requirement-undecided',
    severity=Severity.WARNING,
    title='Requirement undecided',
    what='The project requires something of its callbacks, and a limit ended the check before '
    'the model could decide it.',
    why=_WHY,
    bad=_TABLE,
    good="""\
node.create_subscription(Empty, 'stop', on_stop, 10)
""",
    mend='Raise `--timeout`, `--max-states` or `--max-memory`, or use `--text compact`.',
    language='toml',
)
