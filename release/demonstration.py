"""An example whose findings and verdicts are known, for whoever tries an installed package."""

from __future__ import annotations

EXAMPLE = 'launch_free_examples/service_deadlock/node.py'
FINDING = f'{EXAMPLE}:44:9: error CC101'
FOUND = 'Found 1 error, 1 note in 1 file'
CHECKER = 'native checker'


def differing(status: int, stdout: str, stderr: str) -> str:
    """Tell in what a run differs from what it has to say; nothing where it does not."""
    faults = [f'exit status {status}'] if status != 1 else []
    faults += [f'no "{wanted}"' for wanted in (FINDING, FOUND, CHECKER) if wanted not in stdout]
    faults += [f'stderr: {stderr.strip()}'] if stderr.strip() else []
    return '; '.join(faults)
