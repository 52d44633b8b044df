# SPDX-License-Identifier: Apache-2.0
"""Format errors of xacro with their location, cause and trace."""

from __future__ import annotations

from xacro_program.causes import explain
from xacro_program.trail import Trail


def report(error: BaseException, path: str) -> str:
    """
    Format an error in the expansion of a file: its location, cause and trace.

    Parameters
    ----------
    error
        The exception that xacro raised.
    path
        The file that is expanded, for errors without a location.

    """
    trail = Trail(error)
    place = trail.exact_place()
    where = f'{place.file}:{place.line}:{place.column}' if place else path
    is_intended = trail.code.startswith('${xacro.fatal(')
    code = f'in {trail.code}: ' if trail.code and not is_intended else ''
    first = f'{where}: error: {code}{explain(error, trail)}'
    return '\n'.join([first, *(f'  {step}' for step in trail.steps())])
