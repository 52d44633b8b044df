# SPDX-License-Identifier: Apache-2.0
"""
Run a launch file: `python3 -m humanoid_common.testing.launch_file FILE [name:=value ...]`.

It is interrupted when the process that started it is no more.
"""

from __future__ import annotations

from collections.abc import Sequence
import signal
import sys

from humanoid_common.interrupts import end_with_parent
from launch import LaunchDescription, LaunchService
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import AnyLaunchDescriptionSource


def main(arguments: Sequence[str]) -> int:
    """
    Run a launch file, and return the exit status.

    Parameters
    ----------
    arguments : Sequence[str]
        The path of the file, and then launch arguments in the form `name:=value`.

    """
    end_with_parent(signal.SIGINT)
    path, *settings = arguments
    pairs = [(name, value) for name, _, value in (text.partition(':=') for text in settings)]
    service = LaunchService(argv=settings, noninteractive=True)
    service.include_launch_description(
        LaunchDescription(
            [IncludeLaunchDescription(AnyLaunchDescriptionSource(path), launch_arguments=pairs)]
        )
    )
    return int(service.run())


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
