"""Is there an ``EventsExecutor``?"""

try:
    from rclpy.experimental import EventsExecutor
except ImportError:
    print('no', flush=True)
else:
    print('yes' if EventsExecutor else 'no', flush=True)
