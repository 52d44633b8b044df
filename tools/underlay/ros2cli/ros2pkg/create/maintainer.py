# SPDX-License-Identifier: Apache-2.0
"""The default email address of the maintainer."""

from __future__ import annotations

import subprocess


def default_email(name: str) -> str:
    """
    Determine the maintainer's email address when none is given.

    Parameters
    ----------
    name
        The maintainer's name.

    Returns
    -------
    str
        Git's `user.email`, or else the placeholder `<name>@todo.todo`.

    """
    try:
        result = subprocess.run(
            ['git', 'config', '--get', 'user.email'], capture_output=True, text=True, check=False
        )
    except OSError:
        return f'{name}@todo.todo'
    return result.stdout.strip() or f'{name}@todo.todo'
