"""The table of all rules, in the order of their codes."""

from __future__ import annotations

from ros2cc_extract.findings.rule import Rule
from ros2cc_extract.findings.rules import (
    asyncio_sleep,
    execute_holds_thread,
    executor_spun_twice,
    group_overload,
    groups_on_one_thread,
    idle_threads,
    long_sleep,
    lost_update,
    nested_spin,
    never_ends,
    of_diagnostics,
    of_requirements,
    one_group,
    one_thread_call,
    outside_groups,
    own_group_await,
    own_group_call,
    pool_exhausted,
    rate_on_one_thread,
    self_overlap,
    unordered_write,
    unresolved,
    unused_group,
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
    long_sleep.RULE,
    group_overload.RULE,
    execute_holds_thread.RULE,
    lost_update.RULE,
    unordered_write.RULE,
    outside_groups.RULE,
    self_overlap.RULE,
    one_group.RULE,
    groups_on_one_thread.RULE,
    idle_threads.RULE,
    unused_group.RULE,
    of_diagnostics.NOT_SPUN,
    of_diagnostics.TAKEN_OUT,
    of_diagnostics.UNREADABLE,
    unresolved.RULE,
    of_diagnostics.UNUSED_IGNORE,
    of_requirements.VIOLATED,
    of_requirements.UNKNOWN_NAME,
    of_requirements.UNDECIDED,
)
BY_CODE = {rule.code: rule for rule in RULES}
BY_SLUG = {rule.slug: rule for rule in RULES}
