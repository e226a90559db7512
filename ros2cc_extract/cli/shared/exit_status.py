"""
What the exit status says: 0 clean, 1 findings or a violated requirement, 2 usage, input or tool
error, 3 a verdict stayed undecided (with ``--strict`` also: something stayed unresolved).
"""

EXIT_CLEAN, EXIT_FINDINGS, EXIT_ERROR, EXIT_UNDECIDED = 0, 1, 2, 3
EXIT_INTERRUPTED = 130
