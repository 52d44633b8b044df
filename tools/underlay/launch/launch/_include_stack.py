# SPDX-License-Identifier: Apache-2.0
"""The include stack: the launch files being read, each included by the previous one."""

from __future__ import annotations

import os
from typing import Any, NamedTuple, Optional, TYPE_CHECKING

from launch._call_site import CallSite

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

MAX_NESTED = 64


class OpenFile(NamedTuple):
    """Entry of the include stack: a launch file, the including line, and the state then."""

    path: str
    call_site: Optional[CallSite]
    configurations: dict[str, Any]
    environment: Optional[dict[str, str]]


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
    """Format the chain of a circular include, starting at the last include of the same file."""
    start = 1 + max(index for index, each in enumerate(files) if each.path == last.path)
    steps = [*files[start:], last]
    lines = [f"circular include: '{last.path}' includes itself for ever"]
    lines += [f"  {_line(each.call_site)} includes '{each.path}'" for each in steps]
    lines.append('  Take one of these lines out, or give it a condition that ends the circle.')
    return '\n'.join(lines)


def _line(call_site: Optional[CallSite]) -> str:
    return 'a line that is not known' if call_site is None else str(call_site)
