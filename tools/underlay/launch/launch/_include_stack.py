# SPDX-License-Identifier: Apache-2.0
"""The launch files that are being read, one inside the other."""

from __future__ import annotations

import os
from typing import Any, NamedTuple, Optional, TYPE_CHECKING

from launch._call_site import CallSite

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

MAX_NESTED = 64


class OpenFile(NamedTuple):
    """A launch file, the line that included it, and the state in which it was included."""

    path: str
    call_site: Optional[CallSite]
    configurations: dict[str, Any]
    environment: Optional[dict[str, str]]


class CircularIncludeError(RuntimeError):
    """A launch file includes itself, and nothing has changed since the last time."""


def open_file(context: LaunchContext, path: str, call_site: Optional[CallSite]) -> OpenFile:
    """
    Create the entry of the include stack for a launch file that is to be read.

    Parameters
    ----------
    context
        The context of the launch; its stack is read only.
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
    before = [each for each in context._open_files if each.path == path]
    if not before or not os.path.isfile(path):
        return OpenFile(path, call_site, configurations, None)
    file = OpenFile(path, call_site, configurations, dict(os.environ))
    if len(before) >= MAX_NESTED or any(_same_state(each, file) for each in before):
        raise CircularIncludeError(_circle(context._open_files, file))
    return file


def _same_state(one: OpenFile, other: OpenFile) -> bool:
    return (one.configurations, one.environment) == (other.configurations, other.environment)


def _circle(files: tuple[OpenFile, ...], last: OpenFile) -> str:
    """Say which file includes which, from the last time that this file was included on."""
    start = 1 + max(index for index, each in enumerate(files) if each.path == last.path)
    steps = [*files[start:], last]
    lines = [f"circular include: '{last.path}' includes itself for ever"]
    lines += [f"  {_line(each.call_site)} includes '{each.path}'" for each in steps]
    lines.append('  Take one of these lines out, or give it a condition that ends the circle.')
    return '\n'.join(lines)


def _line(call_site: Optional[CallSite]) -> str:
    return 'a line that is not known' if call_site is None else str(call_site)
