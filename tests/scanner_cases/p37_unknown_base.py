"""P37: an unknown base class: a node, and the base may add more."""
# live: no, imports a package nobody has

from some_vendor_package import VendorNode


class A(VendorNode):
    def __init__(self):
        super().__init__('a')
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass

# expect:
# unit a: no executor
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
#   ? executor executor
#   ? a node_name
#   ? a entities
