# SPDX-License-Identifier: Apache-2.0
"""Show what a launch file would start."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import redirect_stdout
import json
import sys
from typing import Any

from ros2launch.api.running import LaunchOptions, make_service

HEADER = """\
Nothing is started; this is what would be. To find it out, the commands in
Command substitutions were run and the functions in launch files were called.
"""


def rehearse_launch_file(
    *,
    launch_file_path: str,
    launch_file_arguments: Sequence[str],
    as_json: bool,
    **options: bool,
) -> int:
    """
    Print what a launch file would do; return the status, 1 if it cannot be launched.

    The other arguments are those of LaunchOptions.
    """
    service = make_service(
        launch_file_path, launch_file_arguments, LaunchOptions(**options, noninteractive=True)
    )
    from launch._rehearsal.rehearsal import rehearse

    with redirect_stdout(sys.stderr if as_json else sys.stdout):
        root, status = rehearse(service)
    if as_json:
        print(json.dumps({'status': status, **root.as_data()}, indent=2, default=_plain))
    elif status == 0:
        _print_tree(root)
    return status


def _print_tree(root: Any) -> None:
    from launch._rehearsal.tree_text import tree_lines

    print(HEADER)
    print('\n'.join(tree_lines(root)))


def _plain(value: Any) -> Any:
    """Return a value that JSON does not know as one that it knows."""
    return value.decode('utf-8', 'replace') if isinstance(value, bytes) else str(value)
