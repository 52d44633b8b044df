# SPDX-License-Identifier: Apache-2.0
"""The action that runs a process on this machine."""

from __future__ import annotations

from collections.abc import Callable, Iterable
import os
from typing import Any, Optional, TYPE_CHECKING, Union

from launch._checked import list_like, of_type, typed
from launch.action import Action
from launch.descriptions.executable import Executable
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.some_substitutions_type import SomeSubstitutionsType
from launch.substitutions.launch_configuration import LaunchConfiguration

if TYPE_CHECKING:
    import asyncio

    from launch._supervision.process_options import PerformedOptions, ProcessOptions
    from launch._supervision.supervisor import Supervisor
    from launch._visit_observer import VisitObserver
    from launch.launch_context import LaunchContext

OnExit = Union[LaunchDescriptionEntity, Iterable[LaunchDescriptionEntity], Callable[..., Any]]
Output = Union[SomeSubstitutionsType, dict[str, Any]]

_OVERRIDE_OUTPUT = 'OVERRIDE_LAUNCH_PROCESS_OUTPUT'


class ExecuteLocal(Action):
    """
    Action that runs the program that a description stands for, and watches over it.

    Parameters
    ----------
    process_description
        What is executed.
    shell
        Whether a shell reads the command line.
    sigterm_timeout
        The seconds from SIGINT to SIGTERM when the process is to end.
    sigkill_timeout
        The seconds from then to SIGKILL.
    emulate_tty
        Whether the output is a terminal for the process.
    output
        Where the output goes: screen, log, both, own_log, full, or a dictionary by stream.
    output_format
        How a line of the output looks: a brace-style format of `line` and `this`, the action.
    cached_output
        Whether the output is kept for get_stdout() and get_stderr().
    log_cmd
        Whether the command line is logged.
    on_exit
        What is visited, or called, when the process has ended.
    respawn
        Whether the process is started again when it has ended.
    respawn_delay
        The seconds before that.
    respawn_max_retries
        How many times at most; negative stands for always.
    detached
        Whether the process goes on when the launch ends; it has no standard input then, and writes
        to a file in the folder of the log (not in ROS 2 Jazzy).
    **kwargs
        Keyword arguments of `Action`.

    Raises
    ------
    TypeError
        An argument has the wrong type; the error names it.

    """

    preloader: Optional[str] = None
    """The module that knows what Python programs of this kind import; without, none is forked."""

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
        from launch._supervision.process_options import (
            output_substitutions,
            timeout_substitutions,
        )

        _check_plain_options(shell, respawn_delay, respawn_max_retries)
        self.__process_description = process_description
        self.__shell = shell
        self.__emulate_tty = typed('emulate_tty', emulate_tty, bool, 'a bool or a substitution')
        self.__cached_output = cached_output
        self.__log_cmd = log_cmd
        self.__output = output_substitutions(os.environ.get(_OVERRIDE_OUTPUT) or output)
        self.__output_format = output_format
        self.__sigterm_timeout = timeout_substitutions('sigterm_timeout', sigterm_timeout)
        self.__sigkill_timeout = timeout_substitutions('sigkill_timeout', sigkill_timeout)
        self.__respawn = typed('respawn', respawn, bool, 'a bool or a substitution')
        self.__detached = typed('detached', detached, bool, 'a bool or a substitution')
        self.__respawn_delay = respawn_delay
        self.__respawn_max_retries = respawn_max_retries
        self.__on_exit = on_exit if on_exit is None or callable(on_exit) else _reaction(on_exit)
        self.__executed = False
        self.__supervisor: Optional[Supervisor] = None

    # What the action is about.

    @property
    def process_description(self) -> Executable:
        """Return the description of what is executed."""
        return self.__process_description

    @property
    def shell(self) -> bool:
        """Return whether a shell reads the command line."""
        return self.__shell

    @property
    def emulate_tty(self) -> Any:
        """Return whether the output is a terminal, or the substitutions that stand for it."""
        return self.__emulate_tty

    @property
    def output(self) -> Any:
        """Return where the output goes."""
        return self.__output

    @property
    def name(self) -> Any:
        """Return the label once it is known, and before the parts of the name."""
        return self.__process_description.final_name or self.__process_description.name

    @property
    def cmd(self) -> Any:
        """Return the command line once it is known, and before the parts of its words."""
        return self.__process_description.final_cmd or self.__process_description.cmd

    @property
    def cwd(self) -> Any:
        """Return the folder once it is known, and before its parts."""
        return self.__process_description.final_cwd or self.__process_description.cwd

    @property
    def env(self) -> Any:
        """Return the environment once it is known, and before its parts."""
        return self.__process_description.final_env or self.__process_description.env

    # What became of it.

    @property
    def process_details(self) -> Optional[dict[str, Any]]:
        """Return name, cmd, cwd, env and pid of the process, None before it was executed."""
        return self.__supervisor.details if self.__supervisor is not None else None

    @property
    def return_code(self) -> Optional[int]:
        """Return how the process ended, None before that."""
        return self.__supervisor.return_code if self.__supervisor is not None else None

    def get_stdout(self) -> str:
        """Return what the process has written to its standard output, if it is kept."""
        return self._kept_output(1)

    def get_stderr(self) -> str:
        """Return what the process has written to its standard error, if it is kept."""
        return self._kept_output(2)

    def _kept_output(self, stream: int) -> str:
        if not self.__cached_output:
            raise RuntimeError(
                f'the output of {self!r} was not kept: create the action with cached_output=True'
            )
        return '' if self.__supervisor is None else self.__supervisor.output.kept(stream)

    # What it does.

    def description_of_process(self) -> dict[str, Any]:
        """Return the final name, cmd, cwd and env."""
        description = self.__process_description
        return {
            'name': description.final_name,
            'cmd': description.final_cmd,
            'cwd': description.final_cwd,
            'env': description.final_env,
        }

    def prepare(self, context: LaunchContext) -> None:
        """
        Determine the final command, label, folder and environment of the process.

        Parameters
        ----------
        context
            The state of the launch, in which substitutions are performed.

        """
        self.__process_description.prepare(context, self, shell=self.__shell)

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the entities that are visited when the process has ended."""
        if self.__on_exit is None or callable(self.__on_exit):
            return []
        return list(self.__on_exit)

    def execute(self, context: LaunchContext) -> Optional[list[LaunchDescriptionEntity]]:
        """
        Start the process as soon as all that is being visited is done.

        Parameters
        ----------
        context
            The state of a running launch, in which substitutions are performed.

        Raises
        ------
        RuntimeError
            The action was executed before, or the launch is not running.
        ProgramNotFoundError
            The program is not there, which is checked before the first process starts.
        ValueError
            The command is empty, or an option becomes something that cannot be used.

        """
        if self.__executed:
            raise RuntimeError(
                f"ExecuteProcess action '{self.name}': executed more than once: {self!r}; a "
                'process that is to run again needs an action of its own, or respawn=True'
            )
        self.prepare(context)
        self.__executed = True
        self._check_program(context)
        if context._observer is not None:
            self._tell(context._observer)
        options = self._options().perform(context, self.name)
        if not context.is_shutdown:
            self._begin_supervision(context, options)
        return None

    def _options(self) -> ProcessOptions:
        """Return the options as they are now: public code changes some after the construction."""
        from launch._supervision.process_options import ProcessOptions

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

    def _check_program(self, context: LaunchContext) -> None:
        """Raise an error if nothing has been started yet and the program is not there."""
        checks = context._before_start
        if checks is not None and checks.resolves_programs and not self.shell:
            from launch._programs import require_program

            require_program(self.description_of_process())

    def _tell(self, observer: VisitObserver) -> None:
        """Tell who watches what would be started."""
        details = self.description_of_process()
        observer.note(
            label=details['name'],
            argv=details['cmd'],
            shell=self.shell or None,
            cwd=details['cwd'],
            environment=observer.environment_changes(details['env']),
        )
        for event, entities in self._outline_of_waiting():
            observer.note_waiting(event, entities)

    def _outline(self) -> dict[str, Any]:
        words = (' + '.join(part.describe() for part in word) for word in self.cmd)
        return {'command': list(words)}

    def _outline_of_waiting(self) -> list[tuple[str, Iterable[LaunchDescriptionEntity]]]:
        entities = self.get_sub_entities()
        return [('its end', entities)] if entities else []

    def _check_in_advance(self, context: LaunchContext) -> None:
        from launch._programs import require_later_program

        description = self.__process_description
        if not self.shell and description.cmd:
            require_later_program(description.cmd[0], description.env, context)

    def _begin_supervision(self, context: LaunchContext, options: PerformedOptions) -> None:
        from launch._supervision.process_control import ProcessControl
        from launch._supervision.supervisor import Supervisor

        loop = context.asyncio_loop
        if loop is None:
            raise RuntimeError(
                f"the process '{self.name}' can only be started by a running launch"
            )
        self.__supervisor = Supervisor(self, options, context, loop)
        context.register_event_handler(ProcessControl(self, self.__supervisor))
        if self.__on_exit is not None:
            from launch.event_handlers.on_process_exit import OnProcessExit

            context.register_event_handler(
                OnProcessExit(target_action=self, on_exit=self.__on_exit)
            )

    def get_asyncio_future(self) -> Optional[asyncio.Future[None]]:
        """Return a future that is done when the process has ended for good."""
        return None if self.__supervisor is None else self.__supervisor.task


def _reaction(on_exit: Any) -> list[LaunchDescriptionEntity]:
    """Return what is visited when the process has ended as a list."""
    if isinstance(on_exit, LaunchDescriptionEntity):
        return [on_exit]
    entities = list_like('on_exit', on_exit, 'actions, an action or a callable')
    for entity in entities:
        of_type('on_exit', entity, (LaunchDescriptionEntity,), 'a list of actions')
    return entities


def _check_plain_options(shell: Any, respawn_delay: Any, respawn_max_retries: Any) -> None:
    """Raise an error that names the keyword if an option cannot be used."""
    of_type('shell', shell, (bool,), 'True or False')
    if respawn_delay is not None:
        of_type('respawn_delay', respawn_delay, (int, float), 'a number of seconds')
    of_type('respawn_max_retries', respawn_max_retries, (int,), 'a whole number')
