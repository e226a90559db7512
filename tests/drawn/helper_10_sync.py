"""Small helpers for stores which are used from several threads."""
import functools


def synchronized(method):
    """Run the method while the object's own lock is held."""
    @functools.wraps(method)
    def wrapper(self, *args, **kwargs):
        with self.guard:
            return method(self, *args, **kwargs)
    return wrapper
