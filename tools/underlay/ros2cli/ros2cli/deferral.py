# SPDX-License-Identifier: Apache-2.0
"""
Deferred import: execute modules when one of their names is first used.

Libraries import all that they may ever use. The parts that a command hardly ever uses take a
third of its startup time.
"""

from __future__ import annotations

from importlib.machinery import ModuleSpec, PathFinder
from importlib.util import module_from_spec
import sys
from threading import RLock
from types import ModuleType
from typing import Any


def defer(*names: str, **ready: Any) -> None:
    """
    Install top-level modules that are executed on first use; loaded modules stay as they are.

    Parameters
    ----------
    *names
        The modules.
    **ready
        Functions that are imported by name and work without executing the modules.

    """
    for name in names:
        module = defer_found(PathFinder.find_spec(name))
        if module is not None:
            module.__dict__.update(ready)


class _Deferred(ModuleType):
    """Module that is executed on the first attribute access."""

    def __getattr__(self, name: str) -> Any:
        if name == '__path__':  # queried by the import system, to detect a package
            raise AttributeError(name)
        with _lock:
            if type(self) is _Deferred and self not in _in_execution:
                _execute(self)
        if name in self.__dict__:
            return self.__dict__[name]
        raise AttributeError(f"module '{self.__name__}' has no attribute '{name}'")


_lock = RLock()
_in_execution: list[ModuleType] = []


def _execute(module: ModuleType) -> None:
    """Execute a deferred module, which turns it into an ordinary one; other threads wait."""
    spec = module.__spec__
    _in_execution.append(module)
    try:
        if spec is not None and spec.loader is not None:
            spec.loader.exec_module(module)
        module.__class__ = ModuleType
    finally:
        _in_execution.remove(module)


def defer_found(spec: ModuleSpec | None) -> ModuleType | None:
    """
    Install a module that is executed on first use.

    Parameters
    ----------
    spec
        The module spec; None if there is none.

    Returns
    -------
    ModuleType or None
        The module; None without a spec, or if the module is loaded already.

    """
    if spec is None or spec.name in sys.modules:
        return None
    module = module_from_spec(spec)
    module.__class__ = _Deferred
    sys.modules[spec.name] = module
    return module
