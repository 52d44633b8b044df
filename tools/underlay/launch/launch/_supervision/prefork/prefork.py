# SPDX-License-Identifier: Apache-2.0
"""Decide which programs are forked from a template, and which are executed as usual."""

from __future__ import annotations

import asyncio
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from importlib import import_module
import os
import sys
from typing import Optional, TYPE_CHECKING

from launch._supervision.program import Child, execute, Program
from launch.logging import get_logger

if TYPE_CHECKING:
    from launch._supervision.orphan_guard import OrphanGuard
    from launch._supervision.prefork.template_handle import TemplateHandle

WORTHWHILE = 3
"""Minimum number of programs: a template costs as much as executing one, plus memory."""
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


class TemplateFailure(Exception):
    """The template cannot fork a process; the message states why."""


@dataclass
class _Waiting:
    """Program that waits for the decision whether to fork it."""

    program: Program
    kind: Kind


class Prefork:
    """
    Starter of programs that forks programs of the same kind from a template.

    Parameters
    ----------
    guard
        The guard that kills the template if it is left behind.

    """

    def __init__(self, guard: OrphanGuard) -> None:
        self._guard = guard
        self._waiting: list[_Waiting] = []
        self._decision: Optional[asyncio.Future[None]] = None
        self._template: Optional[TemplateHandle] = None
        self._kind: Optional[Kind] = None

    async def spawn(self, program: Program, stdout: int, stderr: int) -> Child:
        """
        Start a program by forking it, or by executing it if it cannot be forked.

        Parameters
        ----------
        program
            The program to start.
        stdout, stderr
            The file descriptors for its output.

        Raises
        ------
        OSError
            The program cannot be started.

        """
        environment = os.environ if program.env is None else program.env
        kind = kind_of(program, environment)
        await self._take_turn(program, kind)
        if kind is not None:
            child = await self._fork(program, kind, stdout, stderr)
            if child is not None:
                return child
        return await execute(program, stdout, stderr)

    async def _fork(
        self, program: Program, kind: Kind, stdout: int, stderr: int
    ) -> Optional[Child]:
        template = self._template
        if template is None or not template.is_open or kind != self._kind:
            return None
        try:
            return await template.fork(program, stdout, stderr)
        except TemplateFailure as error:
            get_logger('launch').debug(
                "'%s' is executed, as it cannot be forked: %s", program.command[0], error
            )
            return None

    async def _take_turn(self, program: Program, kind: Optional[Kind]) -> None:
        """Wait for the decision on earlier programs, so that they are executed first."""
        if kind is not None and self._template is None:
            self._ask(program, kind)
        if self._decision is not None:
            await asyncio.shield(self._decision)

    def _ask(self, program: Program, kind: Kind) -> None:
        """Queue a program for the decision, made once for all programs that start together."""
        loop = asyncio.get_running_loop()
        self._waiting.append(_Waiting(program, kind))
        if self._decision is None:
            self._decision = loop.create_future()
            loop.call_soon(self._close_the_list, self._decision)

    def _close_the_list(self, decision: asyncio.Future[None]) -> None:
        waiting, self._waiting, self._decision = self._waiting, [], None
        kind, count = Counter(item.kind for item in waiting).most_common(1)[0]
        try:
            if count >= WORTHWHILE:
                self._start_template(kind, [w.program for w in waiting if w.kind == kind])
        finally:
            if not decision.done():
                decision.set_result(None)

    def _start_template(self, kind: Kind, programs: list[Program]) -> None:
        from launch._supervision.prefork.template_handle import TemplateHandle

        scripts = sorted({program.command[0] for program in programs})
        environment = os.environ if programs[0].env is None else programs[0].env
        try:
            with programs[0].marking():
                self._template = TemplateHandle(kind, environment, scripts, self._guard)
        except OSError as error:
            get_logger('launch').debug('nothing is forked: %s', error)
            return
        self._kind = kind

    def groups(self) -> set[int]:
        """Return the process group of the template, if there is one."""
        return {self._template.group} if self._template is not None else set()

    def close(self) -> None:
        """Terminate the template."""
        if self._template is not None:
            self._template.close()


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
