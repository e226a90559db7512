"""
Lists the nodes of the ROS graph with their endpoints, as JSON on standard output.

As ``python listing.py SECONDS``: looks until nothing new has been seen for four seconds, for
SECONDS at most. Runs with the user's interpreter: the standard library and rclpy only. Joins the
domain of its environment with a node of its own, which is hidden and offers nothing.
"""

from __future__ import annotations

import importlib
import json
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

NODE = '_ros2cc_listing'
# If a first announcement is lost, the next follows after 3 s (Fast DDS documentation, general
# discovery settings: default of `leaseDuration_announcementperiod`).
SETTLED_S = 4.0
ROUND_S = 0.1
_HIDDEN = '/_action/'
Row = dict[str, Any]


class Listing:
    """The graph as one node sees it."""

    def __init__(self, node: Any, qos_of: Callable[[Any], Row | None]) -> None:
        self._node = node
        self._qos_of = qos_of
        self._actions = importlib.import_module('rclpy.action.graph')

    def nodes(self) -> list[tuple[str, str]]:
        """Name and namespace of each node but our own; of equal ones each."""
        found = self._node.get_node_names_and_namespaces()
        return sorted((name, space) for name, space in found if name != NODE)

    def everything(self) -> list[Row]:
        """Each node with its endpoints."""
        topics = list(self._of_topics())
        return [
            {
                'name': name,
                'namespace': space,
                'endpoints': [
                    *(row for owner, row in topics if owner == (name, space)),
                    *self._of_node(name, space),
                ],
            }
            for name, space in dict.fromkeys(self.nodes())
        ]

    def _of_topics(self) -> Iterator[tuple[tuple[str, str], Row]]:
        for topic, _ in self._node.get_topic_names_and_types():
            if _HIDDEN in topic:
                continue
            for kind, asked in (
                ('publisher', self._node.get_publishers_info_by_topic),
                ('subscription', self._node.get_subscriptions_info_by_topic),
            ):
                for info in asked(topic):
                    owner = info.node_name, info.node_namespace
                    qos = self._qos_of(info)
                    yield owner, _row(kind, topic, info.topic_type, qos)

    def _of_node(self, name: str, space: str) -> Iterator[Row]:
        actions = self._actions
        for kind, asked in (
            ('service', self._node.get_service_names_and_types_by_node),
            ('client', self._node.get_client_names_and_types_by_node),
            (
                'action_server',
                self._of_node_by(actions.get_action_server_names_and_types_by_node),
            ),
            (
                'action_client',
                self._of_node_by(actions.get_action_client_names_and_types_by_node),
            ),
        ):
            try:
                found = asked(name, space)
            except Exception:  # NodeNameNonExistentError cannot be imported here: it has just gone
                continue
            for known, types in found:
                if _HIDDEN not in known:
                    yield from (_row(kind, known, each, None) for each in types)

    def _of_node_by(self, function: Callable[..., Any]) -> Callable[[str, str], Any]:
        return lambda name, space: function(self._node, name, space)


def _row(kind: str, name: str, type_name: str, qos: Row | None) -> Row:
    return {'kind': kind, 'name': name, 'type': type_name, 'qos': qos}


def main(seconds: float) -> None:
    """Print the graph."""
    sys.path.append(str(Path(__file__).resolve().parents[1]))
    qos_of = importlib.import_module('recorder.interfaces').qos_of
    rclpy = importlib.import_module('rclpy')
    rclpy.init(args=[])
    node = rclpy.create_node(NODE, enable_rosout=False, start_parameter_services=False)
    listing = Listing(node, qos_of)
    end, before, since = time.monotonic() + seconds, None, time.monotonic()
    while time.monotonic() < end:
        names = node.get_topic_names_and_types(), node.get_service_names_and_types()
        seen = listing.nodes(), sorted(name for known in names for name, _ in known)
        if seen != before:
            before, since = seen, time.monotonic()
        if seen[0] and time.monotonic() - since > SETTLED_S:
            break
        time.sleep(ROUND_S)
    print(json.dumps(listing.everything()))
    node.destroy_node()
    rclpy.try_shutdown()


if __name__ == '__main__':
    main(float(sys.argv[1]))
