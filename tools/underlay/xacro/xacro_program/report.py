# SPDX-License-Identifier: Apache-2.0
"""Say what went wrong, where, and how xacro came there."""

from __future__ import annotations

from xacro_program.causes import explain
from xacro_program.trail import Trail


def report(error: BaseException, path: str) -> str:
    """
    Format an error in the expansion of a file: where it is, its cause, and how xacro came there.

    Parameters
    ----------
    error
        What xacro raised.
    path
        The file that is expanded, for an error without a place.

    """
    trail = Trail(error)
    place = trail.exact_place()
    where = f'{place.file}:{place.line}:{place.column}' if place else path
    is_intended = trail.code.startswith('${xacro.fatal(')
    code = f'in {trail.code}: ' if trail.code and not is_intended else ''
    first = f'{where}: error: {code}{explain(error, trail)}'
    return '\n'.join([first, *(f'  {step}' for step in trail.steps())])
