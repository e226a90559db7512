"""From what came out of a check to what reports get of it."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ros2cc_extract.pipeline.check import Job, Outcome
    from ros2cc_extract.report.shared.checked import Checked


def checked_of(outcome: Outcome, job: Job, *, with_verdicts: bool = False) -> Checked:
    """Leave what no report shows; with the tables of queries where they are wanted."""
    from ros2cc_extract.pipeline import shards
    from ros2cc_extract.report.shared.checked import Checked

    shard = job.shard
    return Checked(
        units=outcome.units,
        verifications=outcome.verifications,
        findings=outcome.findings,
        summary=outcome.summary,
        promises=outcome.promises,
        files=outcome.extraction.files_seen,
        sources=outcome.sources,
        root=job.root.as_posix(),
        package=job.root.name,
        docs_url=job.config.docs_url,
        with_verdicts=with_verdicts,
        system=outcome.system,
        more={shards.KEY: shards.shard_data(shard, outcome.answers)} if shard else {},
    )
