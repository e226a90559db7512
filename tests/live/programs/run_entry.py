"""Imports a file under its own name and calls a function of it: FILE ENTRY."""

import importlib.util
import sys

file, entry = sys.argv[1:]
spec = importlib.util.spec_from_file_location('case', file)
module = importlib.util.module_from_spec(spec)
spec.loader.exec_module(module)
getattr(module, entry)()
