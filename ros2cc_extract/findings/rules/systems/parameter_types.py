"""CC709: a parameter of the launch file has another type than the code declares."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.model import Remark
from ros2cc_extract.findings.base.rule import Hit, Rule
from ros2cc_extract.spec.node_graph import DeclaredParameter
from ros2cc_extract.spec.system.launched import SetParameter
from ros2cc_extract.spec.system.model import Process, System, SystemNode
from ros2cc_extract.spec.system.parameter_types import type_set
from ros2cc_extract.spec.system.parameters import are_all_known, set_for


def find(system: System) -> Iterator[Hit]:
    for process in system.processes:
        if not are_all_known(process.launched):
            continue
        for node in process.nodes:
            values = set_for(process.launched, node)
            for declared in node.declared:
                given = values.get(declared.name)
                if given is not None:
                    yield from _hit(declared, given, node, process)


def _hit(
    declared: DeclaredParameter, given: SetParameter, node: SystemNode, process: Process
) -> Iterator[Hit]:
    has = type_set(given.value)
    if has in (None, declared.type):
        return
    yield Hit(
        place=given.source or process.launched.source,
        message=f'parameter {declared.name} is {_shown(given.value)}, {_called(has)}, and '
        f'{node.name} declares {_called(declared.type)}: it ends there with '
        'InvalidParameterTypeException',
        help=_help(declared, given),
        severity=Severity.WARNING if declared.conditional else None,
        subjects=(process.name, declared.name),
        related=(Remark(declared.source, f'{declared.name} is declared here'),),
    )


def _shown(value: object) -> str:
    if isinstance(value, tuple):
        return f'[{", ".join(map(_shown, value))}]'
    return str(value).lower() if isinstance(value, bool) else repr(value)


def _called(type_name: str | None) -> str:
    article = 'an' if (type_name or '').startswith('integer') else 'a'
    return f'{article} {type_name}'


def _help(declared: DeclaredParameter, given: SetParameter) -> str:
    is_whole = isinstance(given.value, int) and not isinstance(given.value, bool)
    if declared.type == 'double' and is_whole:
        return f'write {given.value}.0'
    return f'set {_called(declared.type)}, or declare it with dynamic_typing'


RULE = Rule(
    code='CC709',
    slug='parameter-type',
    severity=Severity.ERROR,
    title='Parameter of another type than the code declares',
    what='A launch file, or a YAML file that it names, sets a parameter to a value of another '
    'type than that of the value with which the node declares it. A warning where a branch may '
    'skip the declaration.',
    why='A parameter keeps the type with which it is declared: `10` is no double, and `"10"` is '
    'no number. `declare_parameter` raises InvalidParameterTypeException, and the node does not '
    'come up; not with `dynamic_typing` or `ignore_override`, and not for an empty list. '
    'Observed on rclpy 7.1.6 and 9.1.2 for 22 values and 18 declarations. Source: rclpy 7.1.6, '
    '`node.py` (`declare_parameters`); rcl, `rcl_yaml_param_parser`.',
    bad="""\
Node(package='arm', executable='driver', parameters=[{'rate': 10}])   # declares it as 10.0
""",
    good="""\
Node(package='arm', executable='driver', parameters=[{'rate': 10.0}])
""",
    mend='Write the value as the code declares it: `10.0`, not `10`.',
)
