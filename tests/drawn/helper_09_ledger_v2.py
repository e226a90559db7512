import tempfile
import threading


class EnergyLedger:
    """Running total of the energy booked by all chargers, kept in a journal."""

    def __init__(self):
        self.total = 0
        self._guard = threading.Lock()
        self._journal = tempfile.TemporaryFile('w+')

    def book(self, joules):
        with self._guard:
            total = self.total + joules
            self._journal.write('%d\n' % total)
            self._journal.flush()
            self.total = total
            return total
