# SPDX-License-Identifier: Apache-2.0
"""The program that an action runs, its start, and the options of its process."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from typing import Any, IO, Optional, Protocol, TYPE_CHECKING

from launch.substitution import Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch.utilities.type_utils import perform_typed_substitution

if TYPE_CHECKING:
    import subprocess

    from launch.launch_context import LaunchContext


@dataclass(frozen=True)
class Program:
    """Command with the working directory, environment and options of its process."""

    command: Sequence[str]
    cwd: Optional[str]
    env: Optional[Mapping[str, str]]
    shell: bool
    preloader: Optional[str] = None  # the module that imports what such a process needs
    detached: bool = False  # whether it outlives the launch
    marking: Callable[[], AbstractContextManager[None]] = nullcontext  # entered at its start


class ProgramOwner(Protocol):
    """Action that runs a program, as the supervisor of its process knows it."""

    @property
    def preloader(self) -> Optional[str]:
        """Return the module that imports what the program needs; without it, none is forked."""

    def description_of_process(self) -> dict[str, Any]:
        """Return the final name, cmd, cwd and env."""


class Child(Protocol):
    """A child process that leads a session of its own."""

    @property
    def pid(self) -> int:
        """Return the id of the process."""

    @property
    def stdin(self) -> Optional[IO[bytes]]:
        """Return the write end of the standard input pipe."""

    def wait(self) -> int:
        """Wait for the process to exit; return the exit status, negative for a signal."""


Spawn = Callable[[Program, int, int], Awaitable[Child]]


async def execute(program: Program, stdout: int, stderr: int) -> subprocess.Popen[bytes]:
    """
    Start a program in a session of its own.

    Parameters
    ----------
    program
        The program to start.
    stdout, stderr
        The file descriptors for its output.

    Returns
    -------
    Popen
        The process, whose standard input is a pipe unless it is detached.

    Raises
    ------
    OSError
        The program cannot be started.

    """
    import subprocess

    with program.marking():
        return subprocess.Popen(
            ' '.join(program.command) if program.shell else list(program.command),
            shell=program.shell,
            cwd=program.cwd,
            env=program.env,
            stdin=subprocess.DEVNULL if program.detached else subprocess.PIPE,
            stdout=stdout,
            stderr=stderr,
            bufsize=0,
            start_new_session=True,
        )


@dataclass(frozen=True)
class ProcessOptions:
    """Options of a process as passed to its action, some of them with substitutions."""

    shell: bool
    emulate_tty: Any
    cached_output: bool
    log_cmd: bool
    output: Any
    output_format: str
    sigterm_timeout: list[Substitution]
    sigkill_timeout: list[Substitution]
    respawn: Any
    detached: Any
    respawn_delay: Optional[float]
    respawn_max_retries: int

    def perform(self, context: LaunchContext, label: str) -> PerformedOptions:
        """
        Perform all substitutions in the options, in the current scope.

        Call this once, when the action is executed: the process may start and respawn long after
        the scope has been closed.

        Parameters
        ----------
        context
            The launch context; its configuration `emulate_tty` overrides the option.
        label
            The label of the process, for errors.

        Raises
        ------
        ValueError
            A timeout is not a number, or a switch is not a boolean.
        InvalidConditionExpressionError
            The launch configuration `emulate_tty` is not a boolean.

        """
        return PerformedOptions(
            shell=self.shell,
            emulate_tty=self._wants_tty(context),
            cached_output=self.cached_output,
            log_cmd=self.log_cmd,
            output=self._performed_output(context),
            output_format=self.output_format,
            sigterm_timeout=_timeout(context, label, 'sigterm_timeout', self.sigterm_timeout),
            sigkill_timeout=_timeout(context, label, 'sigkill_timeout', self.sigkill_timeout),
            respawn=perform_typed_substitution(context, self.respawn, bool),
            detached=perform_typed_substitution(context, self.detached, bool),
            respawn_delay=self.respawn_delay,
            respawn_max_retries=self.respawn_max_retries,
        )

    def _wants_tty(self, context: LaunchContext) -> bool:
        """Whether to emulate a TTY; the launch configuration overrides the option."""
        override = context.launch_configurations.get('emulate_tty')
        if override is None:
            return bool(perform_typed_substitution(context, self.emulate_tty, bool))
        from launch.conditions import evaluate_condition_expression

        return evaluate_condition_expression(
            context, normalize_to_list_of_substitutions(str(override))
        )

    def _performed_output(self, context: LaunchContext) -> Any:
        if not isinstance(self.output, list):
            return self.output
        return perform_substitutions(context, self.output)


@dataclass(frozen=True)
class PerformedOptions:
    """Options of a process with performed substitutions; the timeouts remain strings."""

    shell: bool
    emulate_tty: bool
    cached_output: bool
    log_cmd: bool
    output: Any
    output_format: str
    sigterm_timeout: str
    sigkill_timeout: str
    respawn: bool
    detached: bool
    respawn_delay: Optional[float]
    respawn_max_retries: int

    @property
    def timeouts_s(self) -> tuple[float, float]:
        """Return the time from SIGINT to SIGTERM, and from SIGTERM to SIGKILL."""
        return float(self.sigterm_timeout), float(self.sigkill_timeout)

    def may_respawn(self, respawned: int) -> bool:
        """
        Whether to respawn the process after it has exited.

        Parameters
        ----------
        respawned
            How many times it has already been respawned.

        """
        return self.respawn and (
            self.respawn_max_retries < 0 or respawned < self.respawn_max_retries
        )


def _timeout(
    context: LaunchContext,
    label: str,
    keyword: str,
    substitutions: list[Substitution],
) -> str:
    """Perform a timeout, and check that it is a number of seconds."""
    text = perform_substitutions(context, substitutions)
    try:
        float(text)
    except ValueError:
        raise ValueError(
            f"the {keyword} of process[{label}] must be a number of seconds, but it is '{text}'"
        ) from None
    return text
