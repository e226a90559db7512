"""The table of all rules, in the order of their codes."""

from __future__ import annotations

from ros2cc_extract.findings.base.rule import Rule
from ros2cc_extract.findings.rules.configuration import (
    groups_on_one_thread,
    idle_threads,
    not_served,
    one_group,
    unused_group,
)
from ros2cc_extract.findings.rules.deadlocks import (
    lock_order,
    lock_over_wait,
    nested_spin,
    never_ends,
    one_thread_call,
    own_group_await,
    own_group_call,
    pool_exhausted,
    rate_on_one_thread,
    undecided_wait,
)
from ros2cc_extract.findings.rules.executor_use import (
    asyncio_sleep,
    events_coroutine,
    executor_spun_twice,
    foreign_loop,
    lost_task,
    set_up,
    shutdown,
)
from ros2cc_extract.findings.rules.races import (
    cleared_in_use,
    lost_update,
    outside_groups,
    self_overlap,
    unordered_write,
)
from ros2cc_extract.findings.rules.reading import diagnostics, requirements, unresolved
from ros2cc_extract.findings.rules.starvation import (
    absent_service,
    endless_reader,
    execute_holds_thread,
    group_overload,
    long_sleep,
    timeout_harvest,
    transform_wait,
)
from ros2cc_extract.findings.rules.systems import (
    near_names,
    qos,
    same_node_name,
    sim_time,
    start_order,
    two_types,
    unused_settings,
)

RULES: tuple[Rule, ...] = (
    own_group_call.RULE,
    one_thread_call.RULE,
    pool_exhausted.RULE,
    own_group_await.RULE,
    rate_on_one_thread.RULE,
    nested_spin.RULE,
    executor_spun_twice.RULE,
    asyncio_sleep.RULE,
    never_ends.RULE,
    set_up.NOBODY_SPINS,
    lock_order.RULE,
    set_up.LOCK_KEPT,
    events_coroutine.RULE,
    set_up.ASYNCIO_AWAIT,
    lock_over_wait.RULE,
    shutdown.SERVED_NO_MORE,
    shutdown.DESTROYED_WHILE_SPUN,
    shutdown.SHUT_DOWN_IN_CALLBACK,
    foreign_loop.RULE,
    undecided_wait.UNDECIDED,
    undecided_wait.OUTSIDE_WAIT,
    diagnostics.MESSAGE_TAKEN,
    lost_task.RULE,
    long_sleep.RULE,
    group_overload.RULE,
    execute_holds_thread.RULE,
    absent_service.RULE,
    transform_wait.RULE,
    timeout_harvest.RULE,
    endless_reader.RULE,
    lost_update.RULE,
    unordered_write.RULE,
    outside_groups.RULE,
    self_overlap.RULE,
    cleared_in_use.RULE,
    one_group.RULE,
    groups_on_one_thread.RULE,
    idle_threads.RULE,
    unused_group.RULE,
    diagnostics.NOT_SPUN,
    diagnostics.TAKEN_OUT,
    not_served.RULE,
    diagnostics.UNREADABLE,
    unresolved.RULE,
    diagnostics.UNUSED_IGNORE,
    requirements.VIOLATED,
    requirements.UNKNOWN_NAME,
    requirements.UNDECIDED,
    near_names.RULE,
    two_types.RULE,
    qos.RULE,
    sim_time.RULE,
    same_node_name.RULE,
    unused_settings.RULE,
    start_order.RULE,
)
BY_CODE = {rule.code: rule for rule in RULES}
BY_SLUG = {rule.slug: rule for rule in RULES}
