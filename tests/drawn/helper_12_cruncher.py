"""Crunching in another process."""

import multiprocessing
import threading
import time

CONTEXT = multiprocessing.get_context('fork')


class Cruncher:
    """Starts a process, and tells when it has done."""

    def __init__(self):
        self.finished = threading.Event()

    def _crunch(self):
        time.sleep(0.1)
        self.finished.set()

    def run(self):
        self.finished.clear()
        process = CONTEXT.Process(target=self._crunch, daemon=True)
        process.start()
        self.finished.wait()
