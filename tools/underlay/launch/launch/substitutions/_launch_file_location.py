# SPDX-License-Identifier: Apache-2.0
"""The location of the launch file that is being read."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.substitutions.substitution_failure import SubstitutionFailure

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


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
    if context._open_files:
        _warn_of_another_file(
            context, name, context._open_files[-1].path, known['current_launch_file_path']
        )
    return str(known[variable])


def _warn_of_another_file(context: LaunchContext, name: str, reading: str, meant: str) -> None:
    """Warn, once for each pair of files, that the location is that of an earlier include."""
    if reading == meant or (reading, meant) in context._warned_locations:
        return
    from launch.logging import get_logger

    context._warned_locations.add((reading, meant))
    get_logger('launch').warning(
        "%s in '%s' stands for '%s', which has been included before; pass --scoped-location to "
        'ros2 launch, or use the substitution before the include',
        name,
        reading,
        meant,
    )
