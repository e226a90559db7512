"""On which behaviours of releases the model of a unit depends."""

from __future__ import annotations

from dataclasses import replace

from ros2cc_extract.generator.executor_kinds import TASK_RANK, executor_kind, rank_of
from ros2cc_extract.generator.nested_spins import is_spin
from ros2cc_extract.generator.resources import is_foreign, may_pass_unseen
from ros2cc_extract.generator.template_files import Profile
from ros2cc_extract.spec.late_spins import late_spins
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.spec.releases.behaviour import Behaviour
from ros2cc_extract.spec.releases.table import (
    FUTURE_YIELDS_ITSELF,
    NODE_STAYS,
    SPIN_REFUSED_TWICE,
    TASKS_OLDEST_FIRST,
    UNTIL_ASKS_FUTURE,
)


def felt(spec: Spec) -> tuple[Behaviour, ...]:
    """
    Give the rows of the table that change the model of a unit, or what is said of its waits.

    The order of tasks is not among them: where no release is named, the model has either order.
    """
    waits = [(block, callback) for callback in spec.callbacks for block in callback.blocking]
    spins = (NODE_STAYS, SPIN_REFUSED_TWICE) if any(is_spin(block) for block, _ in waits) else ()
    is_woken = executor_kind(spec).has_laps and any(
        is_foreign(block, spec) or may_pass_unseen(block, callback, spec)
        for block, callback in waits
    )
    asks = (UNTIL_ASKS_FUTURE,) if any(late_spins(spec)) else ()
    return (*spins, *asks, *((FUTURE_YIELDS_ITSELF,) if is_woken else ()))


def model_setting(spec: Spec) -> tuple[tuple[str, bool | None], ...]:
    """
    Say how the release of a unit sets the switches that its model reads.

    Units that differ in nothing but their release have one model where these are equal.
    """
    has_tasks = any(rank_of(callback) == TASK_RANK for callback in spec.callbacks)
    rows = (*felt(replace(spec, rclpy=None)), *((TASKS_OLDEST_FIRST,) if has_tasks else ()))
    return tuple((row.name, row.holds(spec.rclpy)) for row in rows if row is not UNTIL_ASKS_FUTURE)


def differing(spec: Spec, profile: Profile) -> tuple[Behaviour, ...]:
    """What differs between the releases a unit is judged for; nothing where one is named."""
    is_for_one = spec.rclpy is not None or profile is not Profile.RCLPY
    return () if is_for_one else felt(spec)
