# SPDX-License-Identifier: Apache-2.0
"""Run launch files for tests, or inspect them without running them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from humanoid_common.testing.processes import module_command, running_program, RunningProgram
from launch import LaunchContext, LaunchDescription, LaunchDescriptionEntity
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.launch_description_sources import AnyLaunchDescriptionSource
from launch_testing import IoHandler, ProcInfoHandler
from launch_testing.actions import ReadyToTest
from launch_testing.asserts import assertExitCodes


@contextmanager
def running_launch_file(
    path: Path,
    *arguments: str,
    environment: Mapping[str, str] = {},
) -> Iterator[RunningProgram]:
    """
    Run a launch file in a process of its own for the length of a `with` block.

    Parameters
    ----------
    path
        The launch file.
    *arguments
        Launch arguments in the form `name:=value`.
    environment
        Environment variables, added to those of this process.

    Yields
    ------
    RunningProgram
        The process; what is left of it is killed after the block.

    """
    command = module_command('humanoid_common.testing.launch_file', str(path), *arguments)
    with running_program(command, environment) as program:
        yield program


def description_under_test(path: Path, **arguments: str) -> LaunchDescription:
    """
    Build the launch description of a launch test, whose tests start at once.

    Parameters
    ----------
    path
        The launch file to test.
    **arguments
        Its launch arguments, by name.

    """
    source = AnyLaunchDescriptionSource(str(path))
    include = IncludeLaunchDescription(source, launch_arguments=arguments.items())
    return LaunchDescription([include, ReadyToTest()])


def assert_clean_end(proc_info: ProcInfoHandler, proc_output: IoHandler) -> None:
    """
    Assert that every process of a launch test ended with status 0 and without a traceback.

    Parameters
    ----------
    proc_info, proc_output
        The exit statuses and the output of the processes, as launch_testing gives them to tests.

    Raises
    ------
    AssertionError
        A process ended otherwise; the message names it.

    """
    assertExitCodes(proc_info)
    names = {event.process_name for event in proc_output if b'Traceback' in event.text}
    assert not names, f'there is a traceback in the output of {", ".join(sorted(names))}'


def load_launch_file(path: Path) -> LaunchDescription:
    """
    Load a launch file without running it.

    Parameters
    ----------
    path
        The launch file, in Python, XML or YAML.

    """
    return AnyLaunchDescriptionSource(str(path)).get_launch_description(LaunchContext())


def argument_defaults(description: LaunchDescription) -> dict[str, str]:
    """
    Read the defaults of the launch arguments that a launch file declares.

    Parameters
    ----------
    description
        What `load_launch_file` returned.

    Returns
    -------
    dict
        The default of each argument, by name; '' for one without a default.

    """
    context = LaunchContext()
    return {
        argument.name: ''.join(
            context.perform_substitution(part) for part in argument.default_value or ()
        )
        for argument in _arguments(description.entities)
    }


def argument_choices(description: LaunchDescription) -> dict[str, list[str]]:
    """
    Read the choices of the launch arguments that a launch file declares.

    Parameters
    ----------
    description
        What `load_launch_file` returned.

    Returns
    -------
    dict
        The choices of each argument that has some, by name.

    """
    found: dict[str, list[str]] = {}
    for argument in _arguments(description.entities):
        choices = argument.choices
        if isinstance(choices, Iterable):
            found[argument.name] = [str(choice) for choice in choices]
    return found


def undescribed_arguments(description: LaunchDescription) -> list[str]:
    """
    List the names of the launch arguments that lack a description.

    Parameters
    ----------
    description
        What `load_launch_file` returned.

    """
    return [
        argument.name
        for argument in _arguments(description.entities)
        if argument.description in ('', 'no description given')
    ]


def _arguments(
    entities: Iterable[LaunchDescriptionEntity],
) -> Iterator[DeclareLaunchArgument]:
    """Yield the argument declarations among the entities."""
    return (entity for entity in entities if isinstance(entity, DeclareLaunchArgument))
