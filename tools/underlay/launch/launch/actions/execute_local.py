# SPDX-License-Identifier: Apache-2.0
"""The action that runs a process on this machine."""

from __future__ import annotations

from collections.abc import Callable, Iterable
import os
from typing import Any, Optional, TYPE_CHECKING, Union

from launch.actions._described_process import DescribedProcess
from launch.descriptions.executable import Executable
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.substitution import SomeSubstitutionsType
from launch.substitutions.context_values import LaunchConfiguration
from launch.utilities.arguments import list_like, of_type, output_like, seconds_like, typed

if TYPE_CHECKING:
    import asyncio

    from launch._supervision.program import PerformedOptions, ProcessOptions
    from launch._supervision.supervisor import Supervisor
    from launch.launch_context import LaunchContext

OnExit = Union[LaunchDescriptionEntity, Iterable[LaunchDescriptionEntity], Callable[..., Any]]
Output = Union[SomeSubstitutionsType, dict[str, Any]]

_OVERRIDE_OUTPUT = 'OVERRIDE_LAUNCH_PROCESS_OUTPUT'


class ExecuteLocal(DescribedProcess):
    """
    Action that runs the program that a description stands for, and watches over it.

    Parameters
    ----------
    process_description
        The description of the executable.
    shell
        Whether a shell runs the command line.
    sigterm_timeout
        The time from SIGINT to SIGTERM in s, when the process is to be terminated.
    sigkill_timeout
        The time from SIGTERM to SIGKILL in s.
    emulate_tty
        Whether to emulate a TTY for the output of the process.
    output
        Where the output goes: screen, log, both, own_log, full, or a dictionary by stream.
    output_format
        The format of output lines: a brace-style format of `line` and `this`, the action.
    cached_output
        Whether the output is cached for get_stdout() and get_stderr().
    log_cmd
        Whether the command line is logged.
    on_exit
        The entities to visit, or the function to call, when the process has exited.
    respawn
        Whether to respawn the process when it has exited.
    respawn_delay
        The delay before the respawn in s.
    respawn_max_retries
        The maximum number of respawns; negative for no limit.
    detached
        Whether the process outlives the launch; it then has no standard input, and writes to a
        file in the log directory (not in ROS 2 Jazzy).
    **kwargs
        Keyword arguments of `Action`.

    Raises
    ------
    TypeError
        An argument has the wrong type; the error names it.

    """

    preloader: Optional[str] = None
    """The module that imports what these Python programs need; without it, none is forked."""

    def __init__(
        self,
        *,
        process_description: Executable,
        shell: bool = False,
        sigterm_timeout: Union[float, SomeSubstitutionsType] = LaunchConfiguration(
            'sigterm_timeout', default=5
        ),
        sigkill_timeout: Union[float, SomeSubstitutionsType] = LaunchConfiguration(
            'sigkill_timeout', default=5
        ),
        emulate_tty: Union[bool, SomeSubstitutionsType] = False,
        output: Output = 'log',
        output_format: str = '[{this.process_description.final_name}] {line}',
        cached_output: bool = False,
        log_cmd: bool = False,
        on_exit: Optional[OnExit] = None,
        respawn: Union[bool, SomeSubstitutionsType] = False,
        respawn_delay: Optional[float] = None,
        respawn_max_retries: int = -1,
        detached: Union[bool, SomeSubstitutionsType] = False,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        _check_plain_options(shell, respawn_delay, respawn_max_retries)
        self.__process_description = process_description
        self.__shell = shell
        self.__emulate_tty = typed('emulate_tty', emulate_tty, bool, 'a bool or a substitution')
        self.__cached_output = cached_output
        self.__log_cmd = log_cmd
        self.__output = output_like(os.environ.get(_OVERRIDE_OUTPUT) or output)
        self.__output_format = output_format
        self.__sigterm_timeout = seconds_like('sigterm_timeout', sigterm_timeout)
        self.__sigkill_timeout = seconds_like('sigkill_timeout', sigkill_timeout)
        self.__respawn = typed('respawn', respawn, bool, 'a bool or a substitution')
        self.__detached = typed('detached', detached, bool, 'a bool or a substitution')
        self.__respawn_delay = respawn_delay
        self.__respawn_max_retries = respawn_max_retries
        self.__on_exit = on_exit if on_exit is None or callable(on_exit) else _reaction(on_exit)
        self.__executed = False
        self.__supervisor: Optional[Supervisor] = None

    # Properties of the action.

    @property
    def process_description(self) -> Executable:
        """Return the description of the executable."""
        return self.__process_description

    @property
    def shell(self) -> bool:
        """Whether a shell runs the command line."""
        return self.__shell

    @property
    def emulate_tty(self) -> Any:
        """Whether to emulate a TTY for the output, as a bool or as substitutions."""
        return self.__emulate_tty

    @property
    def output(self) -> Any:
        """Return the output configuration."""
        return self.__output

    # State of the process.

    @property
    def process_details(self) -> Optional[dict[str, Any]]:
        """Return name, cmd, cwd, env and pid of the process, None before the execution."""
        return self.__supervisor.details if self.__supervisor is not None else None

    @property
    def return_code(self) -> Optional[int]:
        """Return the exit status of the process, None before it has exited."""
        return self.__supervisor.return_code if self.__supervisor is not None else None

    def get_stdout(self) -> str:
        """Return the cached standard output of the process."""
        return self._kept_output(1)

    def get_stderr(self) -> str:
        """Return the cached standard error of the process."""
        return self._kept_output(2)

    def _kept_output(self, stream: int) -> str:
        if not self.__cached_output:
            raise RuntimeError(
                f'the output of {self!r} was not kept: create the action with cached_output=True'
            )
        return '' if self.__supervisor is None else self.__supervisor.output.kept(stream)

    # Execution.

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the entities that are visited when the process has exited."""
        if self.__on_exit is None or callable(self.__on_exit):
            return []
        return list(self.__on_exit)

    def execute(self, context: LaunchContext) -> Optional[list[LaunchDescriptionEntity]]:
        """
        Start the process as soon as the current visit is complete.

        Parameters
        ----------
        context
            The context of a running launch, in which substitutions are performed.

        Raises
        ------
        RuntimeError
            The action was executed before, or the launch is not running.
        ProgramNotFoundError
            The program does not exist, which is checked before the first process starts.
        ValueError
            The command is empty, or an option resolves to an invalid value.

        """
        if self.__executed:
            raise RuntimeError(
                f"ExecuteProcess action '{self.name}': executed more than once: {self!r}; a "
                'process that is to run again needs an action of its own, or respawn=True'
            )
        self.prepare(context)
        self.__executed = True
        self._check_program(context)
        if context.run.observer is not None:
            self._tell(context.run.observer)
        options = self._options().perform(context, self.name)
        if not context.is_shutdown:
            self._begin_supervision(context, options)
        return None

    def _options(self) -> ProcessOptions:
        """Return the current options: public code modifies some of them after construction."""
        from launch._supervision.program import ProcessOptions

        return ProcessOptions(
            shell=self.__shell,
            emulate_tty=self.__emulate_tty,
            cached_output=self.__cached_output,
            log_cmd=self.__log_cmd,
            output=self.__output,
            output_format=self.__output_format,
            sigterm_timeout=self.__sigterm_timeout,
            sigkill_timeout=self.__sigkill_timeout,
            respawn=self.__respawn,
            detached=self.__detached,
            respawn_delay=self.__respawn_delay,
            respawn_max_retries=self.__respawn_max_retries,
        )

    def _begin_supervision(self, context: LaunchContext, options: PerformedOptions) -> None:
        from launch._supervision.supervisor import ProcessControl, Supervisor

        loop = context.asyncio_loop
        if loop is None:
            raise RuntimeError(
                f"the process '{self.name}' can only be started by a running launch"
            )
        self.__supervisor = Supervisor(self, options, context, loop)
        context.register_event_handler(ProcessControl(self, self.__supervisor))
        if self.__on_exit is not None:
            from launch.event_handlers.process_event_handlers import OnProcessExit

            context.register_event_handler(
                OnProcessExit(target_action=self, on_exit=self.__on_exit)
            )

    def get_asyncio_future(self) -> Optional[asyncio.Future[None]]:
        """Return a future that is done when the process has exited and is not respawned."""
        return None if self.__supervisor is None else self.__supervisor.task


def _reaction(on_exit: Any) -> list[LaunchDescriptionEntity]:
    """Normalise the entities to visit when the process has exited to a list."""
    if isinstance(on_exit, LaunchDescriptionEntity):
        return [on_exit]
    entities = list_like('on_exit', on_exit, 'actions, an action or a callable')
    for entity in entities:
        of_type('on_exit', entity, (LaunchDescriptionEntity,), 'a list of actions')
    return entities


def _check_plain_options(shell: Any, respawn_delay: Any, respawn_max_retries: Any) -> None:
    """Validate the types of options; errors name the keyword."""
    of_type('shell', shell, (bool,), 'True or False')
    if respawn_delay is not None:
        of_type('respawn_delay', respawn_delay, (int, float), 'a number of seconds')
    of_type('respawn_max_retries', respawn_max_retries, (int,), 'a whole number')
