# SPDX-License-Identifier: Apache-2.0
"""Dry run of a launch file."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager, nullcontext, redirect_stdout
import json
import os
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
    Print what a launch file would do (a dry run).

    No process of the launch is started, but command substitutions are run, and functions in
    launch files are called.

    Parameters
    ----------
    launch_file_path
        The path of the launch file.
    launch_file_arguments
        Launch arguments as `name:=value`.
    as_json
        Whether to print JSON, even on failure; all other output then goes to stderr.
    **options
        Fields of `LaunchOptions`, other than `noninteractive`.

    Returns
    -------
    int
        The exit status: 0, or 1 if the file cannot be launched.

    Raises
    ------
    RuntimeError
        A launch argument is malformed.

    """
    service = make_service(
        launch_file_path, launch_file_arguments, LaunchOptions(**options, noninteractive=True)
    )
    from launch._rehearsal.rehearsal import rehearse

    with _output_to_stderr() if as_json else nullcontext():
        root, status = rehearse(service)
    if as_json:
        print(json.dumps({'status': status, **root.as_data()}, indent=2, default=_plain))
    elif status == 0:
        _print_tree(root)
    return status


@contextmanager
def _output_to_stderr() -> Iterator[None]:
    """Redirect standard output to stderr, including that of functions and child processes."""
    with redirect_stdout(sys.stderr):
        if sys.__stdout__ is None or sys.__stderr__ is None:
            yield
            return
        sys.__stdout__.flush()
        kept = os.dup(1)
        os.dup2(2, 1)
        try:
            yield
        finally:
            os.dup2(kept, 1)
            os.close(kept)


def _print_tree(root: Any) -> None:
    from launch._rehearsal.tree_text import tree_lines

    print(HEADER)
    print('\n'.join(tree_lines(root)))


def _plain(value: Any) -> Any:
    """Convert a value that is not JSON-serializable."""
    return value.decode('utf-8', 'replace') if isinstance(value, bytes) else str(value)
