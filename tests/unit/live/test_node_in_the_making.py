"""A node whose constructor has not ended is looked at as far as it is there."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.extract.live.hang_analysis import probe


class Node:
    """As of rclpy, before its constructor has made the lists."""

    def get_fully_qualified_name(self) -> str:
        return '/early'

    @property
    def timers(self) -> Iterator[object]:
        yield from self._timers  # type: ignore[attr-defined]


def test_a_node_that_is_being_made_is_said_to_be_unread() -> None:
    row = probe._node(Node())
    assert (row['name'], row['entities']) == ('/early', [])
    assert row['unread'].startswith('a node that is being made: AttributeError')
