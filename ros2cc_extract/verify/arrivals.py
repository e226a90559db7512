"""Claims that one arrival for each callback would leave empty."""

from __future__ import annotations

from ros2cc_extract.generator.build import Family, Profile, Query
from ros2cc_extract.generator.serving import ExecutorKind, executor_kind
from ros2cc_extract.spec.model import GroupType, Spec

TWO_ARRIVALS = 2


def needs_two_arrivals(query: Query, spec: Spec, profile: Profile) -> bool:
    """
    Tell whether a callback may overlap itself as far as groups and threads go.

    With one arrival it runs once, and nothing could refute that it never does. A member of a
    mutually exclusive group, and whoever runs on an only thread, cannot whatever arrives.
    """
    if profile is not Profile.RCLPY or query.family is not Family.SELF_OVERLAP:
        return False
    if executor_kind(spec) is not ExecutorKind.MULTI_THREADED or len(spec.executor.threads) < 2:
        return False
    callback = next(c for c in spec.callbacks if c.name == query.callbacks[0])
    return spec.group_of(callback).type is GroupType.REENTRANT
