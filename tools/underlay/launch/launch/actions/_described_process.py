# SPDX-License-Identifier: Apache-2.0
"""What is known of the process of an action before it starts."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, TYPE_CHECKING

from launch.action import Action

if TYPE_CHECKING:
    from launch.descriptions.executable import Executable
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.launch_run import VisitObserver


class DescribedProcess(Action):
    """
    Action with a process, as far as it is known before it starts.

    Its name, command, directory and environment are substitutions until `prepare` performs them;
    they are outlined, listed by a dry run, and checked in advance.
    """

    @property
    def process_description(self) -> Executable:
        """Return the description of the executable."""
        raise NotImplementedError

    @property
    def shell(self) -> bool:
        """Whether a shell runs the command line."""
        raise NotImplementedError

    @property
    def name(self) -> Any:
        """Return the label once it is known, until then the substitutions of the name."""
        return self.process_description.final_name or self.process_description.name

    @property
    def cmd(self) -> Any:
        """Return the command line once it is known, until then the substitutions of its words."""
        return self.process_description.final_cmd or self.process_description.cmd

    @property
    def cwd(self) -> Any:
        """Return the working directory once it is known, until then its substitutions."""
        return self.process_description.final_cwd or self.process_description.cwd

    @property
    def env(self) -> Any:
        """Return the environment once it is known, until then its substitutions."""
        return self.process_description.final_env or self.process_description.env

    def description_of_process(self) -> dict[str, Any]:
        """Return the final name, cmd, cwd and env."""
        description = self.process_description
        return {
            'name': description.final_name,
            'cmd': description.final_cmd,
            'cwd': description.final_cwd,
            'env': description.final_env,
        }

    def prepare(self, context: LaunchContext) -> None:
        """
        Determine the final command, label, working directory and environment of the process.

        Parameters
        ----------
        context
            The launch context, in which substitutions are performed.

        """
        self.process_description.prepare(context, self, shell=self.shell)

    def outline(self) -> dict[str, Any]:
        """Return the description of the command."""
        words = (' + '.join(part.describe() for part in word) for word in self.cmd)
        return {'command': list(words)}

    def outline_of_waiting(self) -> list[tuple[str, Iterable[LaunchDescriptionEntity]]]:
        """Return the entities that wait for the process to exit."""
        entities = self.get_sub_entities()
        return [('its end', entities)] if entities else []

    def check_in_advance(self, context: LaunchContext) -> None:
        """
        Raise an error if the program is already known and does not exist.

        Parameters
        ----------
        context
            The launch context.

        Raises
        ------
        ProgramNotFoundError
            The program does not exist.

        """
        from launch.preflight import require_later_program

        description = self.process_description
        if not self.shell and description.cmd:
            require_later_program(description.cmd[0], description.env, context)

    def _check_program(self, context: LaunchContext) -> None:
        """Raise an error if the program does not exist and nothing has been started yet."""
        checks = context.run.before_start
        if checks is not None and checks.resolves_programs and not self.shell:
            from launch._before_start import require_program
            from launch.logging import get_logger

            require_program(self.description_of_process(), get_logger('launch'))

    def _tell(self, observer: VisitObserver) -> None:
        """Notify the observer of the process that would be started."""
        details = self.description_of_process()
        observer.note(
            label=details['name'],
            argv=details['cmd'],
            shell=self.shell or None,
            cwd=details['cwd'],
            environment=observer.environment_changes(details['env']),
        )
        for event, entities in self.outline_of_waiting():
            observer.note_waiting(event, entities)
