import one


def fill(node: 'one.A'):
    node.create_timer(0.5, node.tick)
