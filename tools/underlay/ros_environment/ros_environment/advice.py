# SPDX-License-Identifier: Apache-2.0
"""Sentences that several explanations share: commands to run and names that come close."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches
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
    """Return the command that makes a built workspace known to the shell."""
    return f'source {_reach(workspace, "install/setup.bash")}'


def build_command(workspace: Path, package: str) -> str:
    """Return the commands that build one package and make it known to the shell."""
    build = f'colcon build --packages-select {package}'
    if current_folder() != workspace:
        build = f'cd {shlex.quote(str(workspace))} && {build}'
    return f'{build} && source install/setup.bash'


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """Return a question that names the closest known name, or '' if none is close."""
    matches = get_close_matches(name, sorted(known), n=1)
    return f"Did you mean '{matches[0]}'?" if matches else ''


def listing(names: list[str]) -> str:
    """Return names as one text, cut when there are many."""
    more = len(names) - MAX_LISTED
    return ', '.join(names[:MAX_LISTED]) + (f' and {more} more' if more > 0 else '')


def _reach(workspace: Path, relative: str) -> str:
    return relative if current_folder() == workspace else shlex.quote(str(workspace / relative))
