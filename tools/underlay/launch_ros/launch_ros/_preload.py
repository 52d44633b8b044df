# SPDX-License-Identifier: Apache-2.0
"""Preload the imports of Python nodes once, before their processes are forked."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from importlib.util import find_spec
import os
import sys
from typing import Any

from launch_ros._tracing import Tracing

EARLY_VARIABLES = frozenset(
    ('RCL_ASSERT_RMW_ID_MATCHES', 'RMW_IMPLEMENTATION', 'ROS_PYTHON_CHECK_FIELDS')
)
"""Environment variables that are read when rclpy and messages are imported."""

# Modules and interfaces that every rclpy node uses.
_COMMON = (
    ('rclpy', ()),
    ('rclpy.executors', ()),
    ('rclpy.node', ()),
    ('rcl_interfaces.msg', ('ParameterEvent',)),
    ('rcl_interfaces.srv', ('DescribeParameters', 'GetParameters', 'GetParameterTypes')),
    ('rcl_interfaces.srv', ('ListParameters', 'SetParameters', 'SetParametersAtomically')),
)
# Importing these has no side effects apart from memory use.
_HARMLESS = frozenset(('numpy', 'rclpy', 'yaml'))

_tracing = Tracing()


def preload(scripts: Sequence[str]) -> None:
    """
    Import what Python nodes need: rclpy, numpy, yaml and the type supports of interfaces.

    None of it is initialised, so that processes can be forked afterwards.

    Parameters
    ----------
    scripts
        Paths of the Python programs that will be forked from this process.

    """
    from launch_ros._imports import imports_of

    for module, names in (*_COMMON, *imports_of(scripts)):
        package = module.partition('.')[0]
        if package in _HARMLESS:
            _import(module)
        elif _holds_interfaces(package):
            _load_type_supports(_import(module), names)
    sys.modules['rclpy'].get_rmw_implementation_identifier()


def before_fork() -> None:
    """Prepare libraries for a fork of the process."""
    _tracing.before_fork()


def after_fork() -> None:
    """Restore libraries in the child process after a fork."""
    _tracing.after_fork()
    if 'numpy.random' in sys.modules:
        sys.modules['numpy.random'].seed()


def _import(module: str) -> Any:
    """Import a module; None if that fails, as the node itself will report the error."""
    try:
        return import_module(module)
    except ImportError:
        return None


def _holds_interfaces(package: str) -> bool:
    """Whether a package holds generated interfaces (messages, services or actions)."""
    spec = find_spec(package)
    folders = (spec.submodule_search_locations or ()) if spec is not None else ()
    library = f'{package}_s__rosidl_typesupport_c.'
    return any(name.startswith(library) for folder in folders for name in os.listdir(folder))


def _load_type_supports(module: Any, names: Sequence[str]) -> None:
    """Load the type support libraries of interfaces."""
    from rclpy.type_support import check_for_type_support

    for name in names:
        interface = getattr(module, name, None)
        if isinstance(interface, type):
            check_for_type_support(interface)
