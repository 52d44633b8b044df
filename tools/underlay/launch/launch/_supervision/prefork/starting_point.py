# SPDX-License-Identifier: Apache-2.0
"""Set up a clone of the template as a program that has just started."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from importlib.machinery import SourceFileLoader
import os
import sys
import threading
import types
from typing import Any

from launch._supervision.prefork.standard_streams import take_over
from launch._supervision.prefork.title import set_title


def enter(program: Mapping[str, Any], descriptors: tuple[int, int, int]) -> None:
    """
    Set up this process as a program that has just started.

    It leads a session of its own, and gets the streams, the working directory, the environment,
    the arguments and the title of the program.

    Parameters
    ----------
    program
        `interpreter`, `command`, `cwd` and `env`, as `ForkRequest` sends them.
    descriptors
        The standard input, output and error; they are closed.

    """
    os.setsid()
    os.chdir(program['cwd'])
    os.environ.clear()
    os.environ.update(program['env'])
    take_over(descriptors)
    _number_main_thread()
    command = [program['interpreter'], *program['command']]
    sys.argv = list(program['command'])
    sys.orig_argv = command
    script = program['command'][0]
    if not getattr(sys.flags, 'safe_path', False):
        sys.path.insert(0, os.path.dirname(os.path.realpath(script)))
    set_title(os.path.basename(script), command, program['env'])


def main_module(script: str) -> tuple[types.CodeType, dict[str, Any]]:
    """
    Create the module `__main__` for a script.

    Parameters
    ----------
    script
        The path of the script.

    Returns
    -------
    tuple
        The compiled code, and the namespace of the module in which to execute it.

    """
    module = types.ModuleType('__main__')
    names = vars(module)
    names.update(
        __annotations__={},
        __builtins__=sys.modules['builtins'],
        __cached__=None,
        __file__=script,
        __loader__=SourceFileLoader('__main__', script),
    )
    sys.modules['__main__'] = module
    with open(script, 'rb') as file:
        code = compile(file.read(), script, 'exec', dont_inherit=True)
    return code, names


def forget_packages(names: Iterable[str]) -> None:
    """
    Remove packages that only the template needs from `sys.modules`.

    Parameters
    ----------
    names
        The names of top-level packages, whose modules are removed as well.

    """
    unwanted = set(names)
    for name in [name for name in sys.modules if name.partition('.')[0] in unwanted]:
        del sys.modules[name]


def _number_main_thread() -> None:
    """Update the native id of the main thread, which is outdated after a fork."""
    threading.main_thread()._set_native_id()  # type: ignore[attr-defined]
