# SPDX-License-Identifier: Apache-2.0
"""Facts about OpenGL rendering on this machine."""

from __future__ import annotations

from collections.abc import Mapping
from ctypes.util import find_library
from dataclasses import dataclass
import os
from pathlib import Path

DRIVER_FOLDERS = ('/etc/glvnd/egl_vendor.d', '/usr/share/glvnd/egl_vendor.d')
LIBRARIES = ('GL', 'EGL', 'OSMesa')


@dataclass(frozen=True)
class Graphics:
    """
    Libraries and devices for OpenGL.

    :param libraries: file of each library, '' if it is missing
    :param drivers: the drivers that libEGL knows
    :param devices: devices of graphics cards, and whether they may be used
    """

    variables: Mapping[str, str]
    libraries: Mapping[str, str]
    drivers: tuple[str, ...]
    devices: Mapping[str, bool]


def read_graphics() -> Graphics:
    """Return the OpenGL libraries, drivers and devices of this machine."""
    drivers = [path.stem for folder in DRIVER_FOLDERS for path in Path(folder).glob('*.json')]
    devices = [*Path('/dev/dri').glob('renderD*'), *Path('/dev').glob('nvidia[0-9]*')]
    return Graphics(
        variables=dict(os.environ),
        libraries={name: find_library(name) or '' for name in LIBRARIES},
        drivers=tuple(sorted(drivers)),
        devices={str(path): os.access(path, os.R_OK | os.W_OK) for path in sorted(devices)},
    )
