"""
The system that runs, by the ROS graph: nodes of any language, hooked or not.

The graph knows nodes, their endpoints, types and quality of service; it does not know processes,
lines of code, or callbacks.
"""

from __future__ import annotations

import os
import subprocess
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ros2cc_extract.errors import InputError, ToolNotFoundError
from ros2cc_extract.json_text import read_json
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.node_graph import Endpoint, EndpointKind, Qos
from ros2cc_extract.spec.system.builtin_names import is_builtin
from ros2cc_extract.spec.system.launched import RUNNING, Launched
from ros2cc_extract.spec.system.model import Process, System, SystemEndpoint, SystemNode
from ros2cc_extract.spec.system.names import full_name

LISTING = Path(__file__).with_name('listing.py')
GRAPH = Place('ROS graph')
_STARTS_WITHIN_S = 60.0
_NO_CODE = Unknown('it is known by the ROS graph alone')
_MEND = 'source your ROS 2 environment, or name an interpreter that has rclpy with --python'
_OF_DAMAGE = (KeyError, TypeError, ValueError, AttributeError)


def running_system(python: str, seconds: float) -> System:
    """
    Look at the domain of the environment.

    :param python: an interpreter that has rclpy.
    :param seconds: wait so long for nodes to be discovered.
    :raises ToolNotFoundError: when the interpreter cannot be started, or has no rclpy.
    :raises InputError: when no node is there.
    """
    nodes = _listed(python, seconds)
    try:
        processes = tuple(map(_process, nodes))
    except _OF_DAMAGE as error:
        raise ToolNotFoundError(f'{python} listed the graph in another form: {error!r}') from error
    domain = os.environ.get('ROS_DOMAIN_ID', '0')
    if not processes:
        what = f'no node is found in ROS domain {domain} within {seconds:g} s'
        mend = (
            'compare ROS_DOMAIN_ID and ROS_AUTOMATIC_DISCOVERY_RANGE, or wait longer by --seconds'
        )
        raise InputError(what, None, mend)
    return System(name=f'domain {domain}', processes=processes, sources=(GRAPH.file,))


def _listed(python: str, seconds: float) -> list[Any]:
    command = [python, str(LISTING), f'{seconds:g}']
    try:
        found = subprocess.run(
            command, capture_output=True, stdin=subprocess.DEVNULL,
            timeout=seconds + _STARTS_WITHIN_S, check=False,
        )  # fmt: skip
    except (OSError, subprocess.TimeoutExpired) as error:
        raise ToolNotFoundError(
            f'{python} cannot look at the graph: {error}', None, _MEND
        ) from error
    if found.returncode:
        said = found.stderr.decode(errors='replace').strip().splitlines()[-1:]
        why = f': {said[0]}' if said else ''
        raise ToolNotFoundError(f'{python} cannot look at the graph{why}', None, _MEND)
    # What a middleware prints comes before the one line that is ours.
    line = found.stdout.strip().rpartition(b'\n')[2]
    try:
        listed = read_json(line)
    except ValueError as error:
        raise ToolNotFoundError(f'{python} listed no graph: {error}', None, _MEND) from error
    return listed if isinstance(listed, list) else []


def _process(row: Mapping[str, Any]) -> Process:
    name = full_name(row['namespace'], row['name'])
    return Process(
        name=name,
        launched=Launched(kind=RUNNING, source=GRAPH),
        outside=_NO_CODE,
        nodes=(
            SystemNode(
                name=name,
                own_name=row['name'],
                endpoints=tuple(
                    _endpoint(each)
                    for each in row['endpoints']
                    if not is_builtin(EndpointKind(each['kind']), each['name'], name)
                ),
                parameters=None,
                source=GRAPH,
            ),
        ),
    )


def _endpoint(row: Mapping[str, Any]) -> SystemEndpoint:
    qos = row['qos']
    of = Endpoint(
        kind=EndpointKind(row['kind']),
        name=row['name'],
        type=row['type'],
        qos=None if qos is None else Qos(**qos),
    )
    return SystemEndpoint(kind=of.kind, name=row['name'], written=of.name, type=of.type, of=of)
