# SPDX-License-Identifier: Apache-2.0
"""The folders in which the dynamic linker looks for libraries."""

from __future__ import annotations

from dataclasses import dataclass
import os
from pathlib import Path

from ros2doctor.facts.prefix import environment_prefix

MIDDLEWARE_LIBRARIES = ('librcl.so', 'librmw.so', 'libfastrtps.so', 'libfastcdr.so')
SYSTEM_LIBRARIES = ('libstdc++.so.6', 'libssl.so.3', 'libz.so.1')


@dataclass(frozen=True)
class LibraryFolder:
    """
    A folder of LD_LIBRARY_PATH.

    :param has_ros: whether it contains libraries of ROS
    :param system_libraries: system libraries that it shadows
    """

    path: str
    has_ros: bool
    system_libraries: tuple[str, ...]


@dataclass(frozen=True)
class Libraries:
    """
    Search path of libraries.

    :param own: the folder with the libraries of the wheels
    :param search: the folders of LD_LIBRARY_PATH in their order
    :param set_by_shell: whether Python relies on the shell for the path
    """

    own: str
    search: tuple[LibraryFolder, ...]
    set_by_shell: bool


def read_libraries() -> Libraries:
    """Return the library path of this process."""
    texts = os.environ.get('LD_LIBRARY_PATH', '').split(os.pathsep)
    return Libraries(
        own=os.path.join(environment_prefix(), 'lib'),
        search=tuple(_read_folder(Path(text)) for text in texts if text),
        set_by_shell=os.environ.get('_ROS_WHEELS_BOOTSTRAP_COMPLETE') == '1',
    )


def _read_folder(path: Path) -> LibraryFolder:
    return LibraryFolder(
        path=str(path),
        has_ros=any((path / name).exists() for name in MIDDLEWARE_LIBRARIES),
        system_libraries=tuple(name for name in SYSTEM_LIBRARIES if (path / name).exists()),
    )
