# SPDX-License-Identifier: Apache-2.0
"""Paths that users give."""

from __future__ import annotations

from pathlib import Path

from humanoid_common.errors import UserError
from humanoid_common.naming import shortened


def expanded_path(given: str) -> Path:
    """
    Replace `~` or `~user` at the beginning of a path by that home folder.

    Parameters
    ----------
    given
        The path as the user gave it.

    Raises
    ------
    UserError
        There is no such home folder.

    """
    path = Path(given)
    try:
        return path.expanduser()
    except RuntimeError:
        raise UserError(
            f"'{shortened(given)}' cannot be found: there is no home folder "
            f"'{shortened(path.parts[0])}'. Give the whole path, from / on."
        ) from None
