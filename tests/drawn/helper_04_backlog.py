import queue


class Backlog:
    """Samples kept between two uploads, oldest first."""

    def __init__(self, limit):
        self._items = queue.Queue(maxsize=limit)
        self.dropped = 0

    def __len__(self):
        return self._items.qsize()

    def push(self, item):
        self._items.put(item)

    def push_latest(self, item):
        while True:
            try:
                self._items.put_nowait(item)
                return
            except queue.Full:
                self._items.get_nowait()
                self.dropped += 1

    def drain(self):
        batch = []
        while not self._items.empty():
            batch.append(self._items.get_nowait())
        return batch
