# SPDX-License-Identifier: Apache-2.0
"""Decide which programs are forked, and which are executed as usual."""

from __future__ import annotations

import asyncio
from collections import Counter
from dataclasses import dataclass
import os
from typing import Optional, TYPE_CHECKING

from launch._supervision.prefork.eligibility import Kind, kind_of
from launch._supervision.prefork.template_failure import TemplateFailure
from launch._supervision.program import Child, execute, Program
from launch.logging import get_logger

if TYPE_CHECKING:
    from launch._supervision.orphan_guard import OrphanGuard
    from launch._supervision.prefork.template_handle import TemplateHandle

WORTHWHILE = 3
"""Minimum number of programs: a template costs as much as executing one, plus memory."""


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
