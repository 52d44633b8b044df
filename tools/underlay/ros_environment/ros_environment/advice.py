# SPDX-License-Identifier: Apache-2.0
"""Sentences that several explanations share: commands to run and lists of names."""

from __future__ import annotations

import os
from pathlib import Path
import shlex

MAX_LISTED = 12


def current_folder() -> Path:
    """Return the current folder, or where it was if it has been deleted."""
    try:
        return Path.cwd()
    except FileNotFoundError:
        return Path(os.environ.get('PWD') or '/')


def source_command(workspace: Path) -> str:
    """
    Format the shell command that sources a built workspace.

    Parameters
    ----------
    workspace
        The folder of the workspace; the path is relative if it is the current folder.

    """
    return f'source {_reach(workspace, "install/setup.bash")}'


def build_command(workspace: Path, package: str) -> str:
    """
    Format the shell commands that build one package and source its workspace.

    Parameters
    ----------
    workspace
        The folder of the workspace.
    package
        The package that is built.

    """
    build = f'colcon build --packages-select {package}'
    if current_folder() != workspace:
        build = f'cd {shlex.quote(str(workspace))} && {build}'
    return f'{build} && source install/setup.bash'


def listing(names: list[str]) -> str:
    """
    Join names with commas; those after the twelfth are only counted.

    Parameters
    ----------
    names
        The names, in their order.

    """
    more = len(names) - MAX_LISTED
    return ', '.join(names[:MAX_LISTED]) + (f' and {more} more' if more > 0 else '')


def _reach(workspace: Path, relative: str) -> str:
    return relative if current_folder() == workspace else shlex.quote(str(workspace / relative))
