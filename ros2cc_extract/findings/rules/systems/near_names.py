"""CC701: what no node in the system offers, or wants, though nearly the same name is there."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.model import Remark
from ros2cc_extract.findings.base.rule import Hit, Rule
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.node_graph import EndpointKind
from ros2cc_extract.spec.system.model import Connection, End, System
from ros2cc_extract.spec.system.near_names import NAMESPACE, how_near

_WANTS = (EndpointKind.CLIENT, EndpointKind.ACTION_CLIENT, EndpointKind.SUBSCRIPTION)
_VERBS = {
    EndpointKind.CLIENT: ('is asked for', 'is offered'),
    EndpointKind.ACTION_CLIENT: ('is asked for', 'is offered'),
    EndpointKind.SUBSCRIPTION: ('is subscribed to', 'is published'),
}


def find(system: System) -> Iterator[Hit]:
    lone = [each for each in system.connections if _is_lone(each)]
    for wanted in lone:
        kind = wanted.ends[0].endpoint.kind
        if kind not in _WANTS:
            continue
        near = [
            (each, why)
            for each in lone
            if each.what == wanted.what
            and each.ends[0].endpoint.kind is kind.counterpart
            and _types_agree(wanted, each)
            and _processes(wanted).isdisjoint(_processes(each))
            and (why := how_near(wanted.name, each.name)) is not None
            and not (why == NAMESPACE and _may_be_offered(wanted, system))
        ]
        if near:
            yield _hit(wanted, near, system)


def _may_be_offered(wanted: Connection, system: System) -> bool:
    """
    Whether a process that is not in sight may offer a name, as it runs in its namespace.

    A robot has many topics that differ by the namespace only, as those of its sensors and what is
    made of them: that alone is no slip.
    """
    above = wanted.name.rpartition('/')[0] or '/'
    return any(
        isinstance(space := process.launched.namespace, Unknown) or (space or '/') == above
        for process in system.processes
        if process.outside is not None
    )


def _is_lone(connection: Connection) -> bool:
    return len({end.endpoint.kind for end in connection.ends}) == 1


def _processes(connection: Connection) -> set[str]:
    return {end.process.name for end in connection.ends}


def _types_agree(one: Connection, other: Connection) -> bool:
    types = {end.endpoint.type for end in (*one.ends, *other.ends)} - {None}
    return len(types) <= 1


def _hit(wanted: Connection, near: list[tuple[Connection, str]], system: System) -> Hit:
    end = wanted.ends[0]
    first, why = near[0]
    wants, offers = _VERBS[end.endpoint.kind]
    place = end.endpoint.source or end.process.launched.source
    nobody = 'nobody' if system.is_whole else 'no known node'
    return Hit(
        place=place,
        message=f'{wanted.what} {wanted.name} {wants} by {end.node.name}, and {nobody} '
        f'offers it; {first.name} {offers} by {first.ends[0].node.name} and nobody wants that: '
        f'they differ by {why}',
        help=f'let both resolve to one name: write it alike, or remap {wanted.name} to '
        f'{first.name} in the launch file',
        severity=None if system.is_whole else Severity.NOTE,
        subjects=(wanted.name, first.name),
        related=tuple(_remarks(wanted, near)),
    )


def _remarks(wanted: Connection, near: list[tuple[Connection, str]]) -> Iterator[Remark]:
    for end in wanted.ends:
        yield Remark(end.process.launched.source, f'{end.node.name} is started here')
    for each, _ in near:
        for end in each.ends:
            yield Remark(_place(end), f'{each.name} stands here')
            yield Remark(end.process.launched.source, f'{end.node.name} is started here')


def _place(end: End) -> Place:
    return end.endpoint.source or end.process.launched.source


RULE = Rule(
    code='CC701',
    slug='near-name',
    severity=Severity.WARNING,
    title='A name that nobody offers, and nearly the same one that nobody wants',
    what='In the system of a launch file a service, action or topic is wanted by one node and '
    'offered by none, while another node offers one that nobody wants and whose name differs by '
    'the namespace, a slash, a `~`, upper and lower case, or one letter. Code that waits for it '
    'waits forever. A note where code of the system, or a name in it, is not known; another '
    'namespace is not reported if a process of unknown code runs in the one that is wanted.',
    why='Names are expanded with the namespace and the name of their node and then remapped; '
    'endpoints are connected only where the result is the same. Source: design.ros2.org, '
    '"Topic and Service name mapping to DDS"; rcl (Jazzy), `expand_topic_name.c`, `remap.c`.',
    bad="""\
def generate_launch_description():
    return LaunchDescription([
        Node(package='arm', executable='planner', namespace='arm'),   # offers 'plan'
        Node(package='arm', executable='driver'),                     # asks for 'plan'
    ])
""",
    good="""\
def generate_launch_description():
    return LaunchDescription([
        Node(package='arm', executable='planner', namespace='arm'),
        Node(package='arm', executable='driver', namespace='arm'),
    ])
""",
    mend='Write the name alike in both, start both nodes in one namespace, or remap the one to '
    'the other in the launch file.',
)
