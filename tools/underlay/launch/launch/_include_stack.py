# SPDX-License-Identifier: Apache-2.0
"""The include stack: the launch files being read, each included by the previous one."""

from __future__ import annotations

import os
from typing import Optional, TYPE_CHECKING

from launch.failures import CallSite, OpenFile
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.substitution import SubstitutionFailure

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

MAX_NESTED = 64
_PATH = 'current_launch_file_path'
_FOLDER = 'current_launch_file_directory'
_RELATIVE = (
    "A relative path starts at the current folder, '{folder}'. Beside this launch file is "
    '$(dirname)/..., or ThisLaunchFileDir() in Python; in a package is '
    '$(find-pkg-share PACKAGE)/..., or FindPackageShare().'
)


class CircularIncludeError(RuntimeError):
    """A launch file includes itself without any change of state in between."""


def open_file(context: LaunchContext, path: str, call_site: Optional[CallSite]) -> OpenFile:
    """
    Create the include stack entry of a launch file, and detect circular includes.

    Parameters
    ----------
    context
        The context of the launch; its include stack is not modified.
    path
        The absolute path of the launch file.
    call_site
        The line that includes it, if it is known.

    Raises
    ------
    CircularIncludeError
        The file is being read already with the same launch configurations and environment, or
        `MAX_NESTED` times.

    """
    configurations = context.launch_configurations.snapshot()
    before = [each for each in context.run.include_stack if each.path == path]
    if not before or not os.path.isfile(path):
        return OpenFile(path, call_site, configurations, None)
    file = OpenFile(path, call_site, configurations, dict(os.environ))
    if len(before) >= MAX_NESTED or any(_same_state(each, file) for each in before):
        raise CircularIncludeError(_circle(context.run.include_stack, file))
    return file


def missing_launch_file(context: LaunchContext, path: str) -> FileNotFoundError:
    """
    Create the error about an included launch file that does not exist.

    Parameters
    ----------
    context
        The launch context; the launch files being read are not suggested instead.
    path
        The path of the file, as requested; for a relative one the error states where it is looked
        up.

    """
    from ros_environment.missing_file import explain_missing_file

    reading = {each.path for each in context.run.include_stack}
    text = explain_missing_file('launch file', path, reading)
    relative = '' if os.path.isabs(path) else _RELATIVE.format(folder=os.getcwd())
    return FileNotFoundError('\n'.join(filter(None, [text, relative])))


def _same_state(one: OpenFile, other: OpenFile) -> bool:
    return (one.configurations, one.environment) == (other.configurations, other.environment)


def _circle(files: tuple[OpenFile, ...], last: OpenFile) -> str:
    """Format the chain of a circular include, starting at the last include of the same file."""
    start = 1 + max(index for index, each in enumerate(files) if each.path == last.path)
    steps = [*files[start:], last]
    lines = [f"circular include: '{last.path}' includes itself endlessly"]
    lines += [f"  {_line(each.call_site)} includes '{each.path}'" for each in steps]
    lines.append('  Remove one of these lines, or give it a condition that breaks the cycle.')
    return '\n'.join(lines)


def _line(call_site: Optional[CallSite]) -> str:
    return 'an unknown line' if call_site is None else str(call_site)


def enter_launch_file(context: LaunchContext, file: OpenFile) -> LeaveLaunchFile:
    """
    Make a launch file the current one.

    Parameters
    ----------
    context
        The launch context; its local variables are set to the path and the directory of the file.
    file
        The entry of the include stack.

    Returns
    -------
    LeaveLaunchFile
        The entity that leaves the file; visit it after the contents of the file.

    """
    known = context.get_locals_as_dict()
    before = {name: known[name] for name in (_PATH, _FOLDER) if name in known}
    leave = LeaveLaunchFile(before, context.run.include_stack)
    context.extend_locals({_PATH: file.path, _FOLDER: os.path.dirname(file.path)})
    context.run.include_stack = (*context.run.include_stack, file)
    context.run.note_file(file.path)
    return leave


class LeaveLaunchFile(LaunchDescriptionEntity):
    """
    Entity that makes the including file the current one again.

    In ROS 2 Jazzy, ThisLaunchFile and ThisLaunchFileDir continue to refer to the included file.
    They do the same here, unless the context scopes the location.

    Parameters
    ----------
    before
        The local variables about the including file; empty if there is none.
    include_stack
        The include stack without the included file.

    """

    def __init__(self, before: dict[str, str], include_stack: tuple[OpenFile, ...]) -> None:
        self._before = before
        self._include_stack = include_stack

    def visit(self, context: LaunchContext) -> None:
        """
        Restore the include stack, and the location of the launch file if the context scopes it.

        Parameters
        ----------
        context
            The launch context.

        """
        context.run.include_stack = self._include_stack
        if self._before and context.run.scopes_location:
            context.extend_locals(self._before)


def launch_file_location(context: LaunchContext, variable: str, name: str) -> str:
    """
    Look up the location of the launch file that is being read.

    It warns if the location is that of a file that was included before.

    Parameters
    ----------
    context
        The launch context, whose local variables are read.
    variable
        The local variable, `current_launch_file_path` or `current_launch_file_directory`.
    name
        The name of the substitution, for messages.

    Raises
    ------
    SubstitutionFailure
        No launch file is being read.

    """
    known = context.get_locals_as_dict()
    if variable not in known:
        raise SubstitutionFailure(
            f'{name} cannot be used in a script: no launch file is being read'
        )
    if context.run.include_stack:
        _warn_of_another_file(
            context, name, context.run.include_stack[-1].path, known['current_launch_file_path']
        )
    return str(known[variable])


def _warn_of_another_file(context: LaunchContext, name: str, reading: str, meant: str) -> None:
    """Warn, once for each pair of files, that the location is that of an earlier include."""
    if reading == meant or (reading, meant) in context.run.warned_locations:
        return
    from launch.logging import get_logger

    context.run.warned_locations.add((reading, meant))
    get_logger('launch').warning(
        "%s in '%s' stands for '%s', which has been included before; pass --scoped-location to "
        'ros2 launch, or use the substitution before the include',
        name,
        reading,
        meant,
    )
