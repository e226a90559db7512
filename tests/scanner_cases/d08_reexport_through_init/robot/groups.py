from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup


def make_group(parallel):
    return ReentrantCallbackGroup() if parallel else MutuallyExclusiveCallbackGroup()
