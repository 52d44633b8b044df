# SPDX-License-Identifier: Apache-2.0
"""Requirements of the machine, checked before any download, each with a remedy.

Every check returns an error message, or None on success.
"""

import os
import platform
import shutil
import sys
import sysconfig
from typing import List, Optional, Tuple

OLDEST_PYTHON = (3, 10)
NEWEST_PYTHON = (3, 13)
OLDEST_GLIBC = (2, 28)
NEEDED_FOR_WHEELS = 2000 * 1000 * 1000
NEEDED_FOR_BUILD = 100 * 1000 * 1000
COMPILERS = ('c++', 'g++', 'clang++')
UNUSABLE_CHARACTERS = ':;"\'`$\\\n'


def python_problem(
    version: Optional[Tuple[int, int]] = None, implementation: Optional[str] = None
) -> Optional[str]:
    """
    Report a Python for which the wheels do not exist.

    Parameters
    ----------
    version, implementation
        (major, minor), and a name such as CPython; by default those of the running interpreter.

    """
    version = version or sys.version_info[:2]
    implementation = implementation or platform.python_implementation()
    if implementation == 'CPython' and OLDEST_PYTHON <= version <= NEWEST_PYTHON:
        return None
    return (
        'This is {} {}.{}, but the ROS 2 wheels exist for CPython 3.10 to 3.13 only: install '
        'one of these (Debian, Ubuntu: sudo apt install python3 python3-venv python3-dev) and '
        'name it, as in: make setup PYTHON=python3.12'
    ).format(implementation, *version)


def platform_problem(
    system: Optional[str] = None,
    machine: Optional[str] = None,
    libc: Optional[Tuple[str, str]] = None,
) -> Optional[str]:
    """
    Report a platform for which the wheels do not exist.

    Parameters
    ----------
    system, machine
        As `sys.platform` and `platform.machine` name them; by default those of this machine.
    libc
        Name and version, as from `platform.libc_ver`; by default those of this machine.

    """
    system, machine = system or sys.platform, machine or platform.machine()
    if system != 'linux' or machine != 'x86_64':
        return (
            'This machine is {} on {}, but the ROS 2 wheels exist for Linux on x86_64 only: use '
            'such a machine, or a virtual machine or container of that kind'
        ).format(system, machine)
    name, version = libc or platform.libc_ver()
    if name == 'glibc' and tuple(int(part) for part in version.split('.')[:2]) >= OLDEST_GLIBC:
        return None
    found = '{} {}'.format(name or 'not glibc', version).strip()
    return (
        'The C library here is {}, but the ROS 2 wheels need glibc 2.28 or newer: use Debian 10, '
        'Ubuntu 20.04, Fedora 29 or a newer release of these'
    ).format(found)


def venv_problem() -> Optional[str]:
    """Report a Python that cannot create virtual environments."""
    try:
        import ensurepip
        import venv
    except ImportError:
        package = 'python{}.{}-venv'.format(*sys.version_info[:2])
        return 'Python has no venv module here: sudo apt install ' + package
    return None


def compiler_problem(path: Optional[str] = None) -> Optional[str]:
    """
    Report a missing C++ compiler.

    Parameters
    ----------
    path
        The search path for programs; by default that of this process.

    """
    if any(shutil.which(name, path=path) for name in COMPILERS):
        return None
    return 'There is no C++ compiler here: sudo apt install g++'


def headers_problem(include: Optional[str] = None) -> Optional[str]:
    """
    Report missing C headers of Python, which message packages compile against.

    Parameters
    ----------
    include
        The folder that should contain Python.h; by default that of the running interpreter.

    """
    include = include or sysconfig.get_path('include')
    if os.path.isfile(os.path.join(include, 'Python.h')):
        return None
    package = 'python{}.{}-dev'.format(*sys.version_info[:2])
    return 'The C headers of Python are missing ({}/Python.h): sudo apt install {}'.format(
        include, package
    )


def path_problem(path: str) -> Optional[str]:
    """
    Report a character in a path that search paths and build tools cannot hold.

    Parameters
    ----------
    path
        The folder of the workspace, or that of its environment.

    """
    found = sorted(set(path) & set(UNUSABLE_CHARACTERS))
    if not found:
        return None
    return (
        'The path {!r} has the character {!r}, which search paths and build tools cannot hold: '
        'move or rename the folder'
    ).format(path, found[0])


def space_problem(folder: str, needed: int) -> Optional[str]:
    """
    Report a disk without room for the environment.

    Parameters
    ----------
    folder
        The folder of the environment, which need not exist yet.
    needed
        The required free space, in bytes.

    """
    while not os.path.isdir(folder):
        folder = os.path.dirname(folder)
    free = shutil.disk_usage(folder).free
    if free >= needed:
        return None
    return (
        'There are {} MB free in {}, but the environment and the build need {} MB: free some, or '
        'keep the environment on another disk, as in: make setup VENV=/other/disk/venv'
    ).format(free // 10**6, folder, needed // 10**6)


def problems(root: str, environment: str, has_wheels: bool) -> List[str]:
    """
    Check all requirements of a workspace and its environment.

    Parameters
    ----------
    root, environment
        Their folders.
    has_wheels
        Whether the wheels are installed already, so that less disk space is needed.

    Returns
    -------
    list of str
        A message for each problem.

    """
    checks = [
        platform_problem(),
        venv_problem(),
        compiler_problem(),
        headers_problem(),
        path_problem(root),
        path_problem(environment),
        space_problem(environment, NEEDED_FOR_BUILD if has_wheels else NEEDED_FOR_WHEELS),
    ]
    return [problem for problem in checks if problem]
