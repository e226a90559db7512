from .nodes import *
from .groups import make_group
