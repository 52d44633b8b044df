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
    except (xacro.XacroException, ExpatError) as error:
        reason = ' '.join(str(error).split()).rstrip('.')
        raise DescriptionError(f'xacro cannot expand {_places()}: {reason}.') from error
    text: str = document.toprettyxml(indent='  ')
    return text


def _places() -> str:
    """Name the file in which xacro has stopped, and those that include it."""
    import xacro

    return ', included from '.join(map(str, reversed(xacro.filestack)))
