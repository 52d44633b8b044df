# SPDX-License-Identifier: Apache-2.0
"""Make a URDF from the humanoid's xacro files, or from others."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from xml.parsers.expat import ExpatError

from humanoid_description.errors import DescriptionError
from humanoid_description.files import share


def humanoid_urdf(scale: float = 1.0, prefix: str = '', upper_body_only: bool = False) -> str:
    """Return the URDF of the humanoid."""
    return expand(
        share() / 'urdf' / 'humanoid.urdf.xacro',
        {
            'scale': repr(scale),
            'prefix': prefix,
            'upper_body_only': str(upper_body_only).lower(),
        },
    )


def expand(path: Path, arguments: Mapping[str, str]) -> str:
    """Return the URDF that a xacro file describes."""
    import xacro

    try:
        document = xacro.process_file(str(path), mappings=dict(arguments))
    except (xacro.XacroException, ExpatError, RecursionError) as error:
        raise DescriptionError(f'xacro cannot expand {_places()}: {_reason(error)}.') from error
    text: str = document.toprettyxml(indent='  ')
    return text


def _reason(error: Exception) -> str:
    """Return in one line why xacro has stopped."""
    if isinstance(error, RecursionError):
        return 'a file includes itself, or a macro calls itself, without an end'
    return ' '.join(str(error).split()).rstrip('.')


def _places() -> str:
    """Name the file in which xacro has stopped, and those that include it, each once."""
    import xacro

    return ', included from '.join(dict.fromkeys(map(str, reversed(xacro.filestack))))
