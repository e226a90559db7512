"""CC705: two nodes with one fully qualified name."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.model import Remark
from ros2cc_extract.findings.base.rule import Hit, Rule
from ros2cc_extract.spec.system.model import Process, System, SystemNode


def find(system: System) -> Iterator[Hit]:
    known: dict[str, tuple[Process, SystemNode]] = {}
    reported: set[str] = set()
    for process in system.processes:
        launched = process.launched
        if launched.conditional is not None or not launched.is_beside_others:
            continue
        for node in process.nodes:
            if not isinstance(node.name, str) or node.name in reported:
                continue
            first = known.setdefault(node.name, (process, node))
            if first[1] is not node:
                reported.add(node.name)
                yield _hit(node.name, process, *first)


def _hit(name: str, process: Process, first: Process, node: SystemNode) -> Hit:
    if first is process:
        message = f'the launch file names every node of a process {name}, and this one has several'
        mend = 'leave the name out, or remap each node by its own: own_name:__node:=new_name'
    else:
        message = f'two nodes are called {name}'
        mend = 'give one of them another name or namespace'
    return Hit(
        place=process.launched.source,
        message=message,
        help=mend,
        subjects=(name,),
        related=(
            Remark(first.launched.source, f'{name} is started here too'),
            *((Remark(node.source, 'this is the code of one of them'),) if node.source else ()),
        ),
    )


RULE = Rule(
    code='CC705',
    slug='same-node-name',
    severity=Severity.WARNING,
    title='Two nodes with one name',
    what='Two nodes of the system have the same fully qualified name. Not '
    'reported for processes that a condition may leave out.',
    why='Node names must be unique: parameters, life-cycle services and tools find a node by its '
    'name, and reach one of the two. A name in a launch file is given to every node of the '
    'process. Source: design.ros2.org, "ROS 2 Node naming"; launch_ros (Jazzy), '
    '`actions/node.py`; rcl (Jazzy), `remap.c`.',
    bad="""\
Node(package='camera', executable='driver', name='camera'),
Node(package='camera', executable='driver', name='camera'),
""",
    good="""\
Node(package='camera', executable='driver', name='camera', namespace='left'),
Node(package='camera', executable='driver', name='camera', namespace='right'),
""",
    mend='Give one of them another name or namespace. Where one process has several nodes, leave '
    'the name out of the launch file, or remap each: `own_name:__node:=new_name`.',
)
