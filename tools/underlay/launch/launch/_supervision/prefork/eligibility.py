# SPDX-License-Identifier: Apache-2.0
"""Determine which programs can be forked from a template, and which can share one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from importlib import import_module
import os
import sys
from typing import Optional

from launch._supervision.program import Program

# Variables read before a program starts, by the loader, by Python, or by libraries as they load.
_EARLY_NAMES = frozenset(('HOME', 'LANG', 'LANGUAGE', 'SETUPTOOLS_USE_DISTUTILS', 'TZ'))
_EARLY_PREFIXES = (
    *('GFORTRAN_', 'GLIBC_', 'GOTO_', 'LC_', 'LD_', 'LTTNG_', 'MALLOC_', 'NPY_', 'NUMPY_'),
    *('OMP_', 'OPENBLAS_', 'OPENSSL_', 'PYTHON', '_'),
)
# Variables that affect a process over its whole lifetime.
_EXECUTED_ONLY = frozenset(
    ('COVERAGE_PROCESS_CONFIG', 'COVERAGE_PROCESS_START', 'LD_AUDIT', 'LD_DEBUG', 'LD_PRELOAD')
    + ('PYTHONDUMPREFS', 'PYTHONINSPECT', 'PYTHONPERFSUPPORT', 'PYTHONPROFILEIMPORTTIME')
)
_MOST_BYTES = 100_000  # of command line and environment, which must fit into a socket


@dataclass(frozen=True)
class Kind:
    """Key of a program; programs with equal keys can be forked from the same template."""

    interpreter: str
    preloader: str
    environment: tuple[tuple[str, str], ...]


def kind_of(program: Program, environment: Mapping[str, str]) -> Optional[Kind]:
    """
    Determine the kind of a program; one template serves all programs of a kind.

    Parameters
    ----------
    program
        The program to start.
    environment
        The environment variables of its process.

    Returns
    -------
    Kind or None
        None if the program has to be executed.

    """
    if program.shell or program.preloader is None or not _is_plain(environment):
        return None
    if program.cwd is not None and not os.path.isdir(program.cwd):
        return None
    interpreter = _interpreter(program.command[0])
    if interpreter is None or _size(program, environment) > _MOST_BYTES:
        return None
    names = _EARLY_NAMES | import_module(program.preloader).EARLY_VARIABLES
    early = sorted(item for item in environment.items() if _is_early(item[0], names))
    return Kind(interpreter, program.preloader, tuple(early))


def _is_plain(environment: Mapping[str, str]) -> bool:
    return sys.platform == 'linux' and not any(environment.get(name) for name in _EXECUTED_ONLY)


def _is_early(name: str, names: frozenset[str]) -> bool:
    return name in names or name.startswith(_EARLY_PREFIXES)


def _size(program: Program, environment: Mapping[str, str]) -> int:
    words = [*program.command, *environment.keys(), *environment.values()]
    return sum(len(word) + 8 for word in words)


def _interpreter(script: str) -> Optional[str]:
    """Return the interpreter in the shebang of a script, if it is the one running."""
    if not os.path.isabs(script) or not os.access(script, os.X_OK):
        return None
    try:
        with open(script, 'rb') as file:
            line = file.readline(256)
    except OSError:
        return None
    if not line.startswith(b'#!') or not line.endswith(b'\n'):
        return None
    interpreter = os.fsdecode(line[2:].strip())
    return interpreter if _is_running(interpreter) else None


def _is_running(interpreter: str) -> bool:
    if interpreter == sys.executable:
        return True
    try:
        return os.path.samefile(
            os.path.dirname(interpreter), os.path.dirname(sys.executable)
        ) and os.path.samefile(interpreter, sys.executable)
    except OSError:
        return False
