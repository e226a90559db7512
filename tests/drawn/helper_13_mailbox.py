"""A bounded box between callbacks."""

import queue


class Box:
    """Jobs wait here."""

    def __init__(self, size):
        self._jobs = queue.Queue(maxsize=size)

    def __lshift__(self, job):
        self._jobs.put(job)
        return self

    def __iter__(self):
        while not self._jobs.empty():
            yield self._jobs.get_nowait()
