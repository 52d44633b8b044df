# SPDX-License-Identifier: Apache-2.0
"""Check that a simulator can render camera images and windows."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from ctypes.util import find_library
from dataclasses import dataclass
import os
from pathlib import Path

from ros2doctor.api.extension import DoctorCheck, DoctorReport, Finding, Report, Result, Severity

DRIVER_FOLDERS = ('/etc/glvnd/egl_vendor.d', '/usr/share/glvnd/egl_vendor.d')
LIBRARIES = ('GL', 'EGL', 'OSMesa')
DEFAULT_BACKEND = 'egl'
BACKENDS = {'egl': 'EGL', 'glfw': 'GL', 'osmesa': 'OSMesa'}
PACKAGES = {
    'EGL': 'libegl1 libegl-mesa0 libgl1-mesa-dri',
    'GL': 'libgl1 libgl1-mesa-dri',
    'OSMesa': 'libosmesa6',
}
VARIABLES = ('DISPLAY', 'WAYLAND_DISPLAY', 'MUJOCO_GL', 'LIBGL_ALWAYS_SOFTWARE')


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


class GraphicsCheck(DoctorCheck):
    """Check of the rendering of a simulator."""

    def category(self) -> str:
        """Return the category."""
        return 'graphics'

    def check(self) -> Result:
        """Check for problems that prevent a simulator from rendering."""
        return Result(graphics_findings(read_graphics()))


def graphics_findings(facts: Graphics) -> Iterator[Finding]:
    """
    Report problems that prevent a simulator from rendering, or slow it down.

    Parameters
    ----------
    facts
        The OpenGL libraries, drivers and devices, as `read_graphics` gives them.

    Yields
    ------
    Finding
        A warning each, since simulation works without rendering.

    """
    if not any(facts.libraries.values()):
        yield Finding(
            Severity.WARNING,
            'there is no OpenGL library: neither libGL nor libEGL nor libOSMesa',
            'simulated cameras render nothing; physics, sensors and control work without it',
            _install('EGL'),
        )
    else:
        yield from _backend(facts)
        yield from _drivers(facts)
    for device, is_accessible in facts.devices.items():
        if not is_accessible:
            yield Finding(
                Severity.WARNING,
                f"this user has no permission to use the graphics card '{device}'",
                'the CPU renders instead, several times slower',
                'sudo usermod -aG render,video "$USER", then log in again',
            )


def _backend(facts: Graphics) -> Iterator[Finding]:
    name = facts.variables.get('MUJOCO_GL', '').lower()
    if not name:
        return
    library = BACKENDS.get(name)
    if library is None:
        yield Finding(
            Severity.WARNING,
            f"MUJOCO_GL is '{name}', which is not one of {', '.join(BACKENDS)}",
            'the simulator does not start, or renders nothing',
            'export MUJOCO_GL=egl',
        )
    elif not facts.libraries.get(library):
        yield Finding(
            Severity.WARNING,
            f'MUJOCO_GL is {name}, but there is no lib{library}',
            'simulated cameras render nothing',
            _install(library),
        )
    elif name == 'glfw' and not _has_display(facts):
        yield Finding(
            Severity.WARNING,
            'MUJOCO_GL is glfw, which needs a display, but there is none',
            'the simulator ends with an error when it opens its window',
            'export MUJOCO_GL=egl',
        )


def _drivers(facts: Graphics) -> Iterator[Finding]:
    backend = facts.variables.get('MUJOCO_GL', '').lower() or DEFAULT_BACKEND
    if backend == DEFAULT_BACKEND and facts.libraries.get('EGL') and not facts.drivers:
        yield Finding(
            Severity.WARNING,
            'libEGL is installed, but no driver for it',
            'simulated cameras render nothing; physics, sensors and control work without it',
            _install('EGL'),
        )


def _has_display(facts: Graphics) -> bool:
    return any(facts.variables.get(name) for name in ('DISPLAY', 'WAYLAND_DISPLAY'))


def _install(library: str) -> str:
    return f'sudo apt install {PACKAGES[library]}'


class GraphicsReport(DoctorReport):
    """Report of the rendering of a simulator."""

    def category(self) -> str:
        """Return the category."""
        return 'graphics'

    def report(self) -> Report:
        """Return the section."""
        facts = read_graphics()
        report = Report('GRAPHICS')
        for name, file in facts.libraries.items():
            report.add_to_report(f'lib{name}', file or 'missing')
        report.add_to_report('drivers of libEGL', ', '.join(facts.drivers))
        for device, is_accessible in facts.devices.items():
            report.add_to_report(device, 'usable' if is_accessible else 'not for this user')
        for name in VARIABLES:
            report.add_to_report(name, facts.variables.get(name, ''))
        return report
