"""
What every node has in the graph by itself, without user code.

Source: rclpy and rclcpp (Jazzy): parameters, time, logging, type descriptions, life cycle.
"""

from __future__ import annotations

from ros2cc_extract.spec.node_graph import EndpointKind

_TOPICS = ('/rosout', '/parameter_events')
_OF_NODE = frozenset(
    """
    describe_parameters get_parameter_types get_parameters list_parameters set_parameters
    set_parameters_atomically get_type_description get_logger_levels set_logger_levels
    change_state get_state get_available_states get_available_transitions get_transition_graph
    """.split()  # noqa: SIM905
)
_TOPICS_OF_NODE = ('transition_event',)


def is_builtin(kind: EndpointKind, name: str, node: str) -> bool:
    """
    Whether a client library has made an endpoint by itself.

    :param name: resolved.
    :param node: fully qualified.
    """
    above, _, last = name.rpartition('/')
    if kind is EndpointKind.SERVICE:
        return above == node and last in _OF_NODE
    if kind is EndpointKind.PUBLISHER:
        return name in _TOPICS or (above == node and last in _TOPICS_OF_NODE)
    return kind is EndpointKind.SUBSCRIPTION and name in ('/clock', '/parameter_events')
