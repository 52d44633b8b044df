# SPDX-License-Identifier: Apache-2.0
"""Why a file of the source tree is not in the installed share folder."""

from __future__ import annotations

import os
from pathlib import Path

from ros_environment.setup_script import read_setup_script, SetupScript
from ros_environment.source_tree import SourcePackage


def explain_source_file(source: SourcePackage, file_name: str, rebuild: str) -> str:
    """
    Explain from the source of a package why a file of it is not installed.

    Parameters
    ----------
    source
        The package in the source tree.
    file_name
        The name that was asked for, without folders.
    rebuild
        The command that builds the package.

    Returns
    -------
    str
        The explanation; '' if the package has no such file, or neither setup.py nor
        CMakeLists.txt.

    """
    path = _find_file(source.folder, file_name)
    if path is None:
        return ''
    relative = path.relative_to(source.folder)
    script = read_setup_script(source.folder / 'setup.py')
    if script is None:
        return _explain_cmake(source, path, relative, rebuild)
    if script.installs(relative.as_posix()):
        return f"'{path}' exists, but it is not installed yet. Rebuild: {rebuild}"
    if script.data_is_computed:
        return (
            f"'{path}' exists, but it is not installed. If 'data_files' in setup.py covers it, "
            f'a rebuild is enough: {rebuild}'
        )
    return _missing_data_file(source, script, path, relative, rebuild)


def _missing_data_file(
    source: SourcePackage,
    script: SetupScript,
    path: Path,
    relative: Path,
    rebuild: str,
) -> str:
    folder = '' if relative.parent == Path('.') else f'/{relative.parent.as_posix()}'
    share = f"'share/{source.name}{folder}'"
    if script.has_package_name:
        share = "'share/' + package_name" + (f" + '{folder}'" if folder else '')
    return (
        f"'{path}' exists, but setup.py does not install it. Add this line to the list "
        f"'data_files' of '{source.folder / 'setup.py'}':\n"
        f"    ({share}, ['{relative.as_posix()}']),\nThen rebuild: {rebuild}"
    )


def _explain_cmake(source: SourcePackage, path: Path, relative: Path, rebuild: str) -> str:
    lists = source.folder / 'CMakeLists.txt'
    if not lists.is_file():
        return ''
    return (
        f"'{path}' exists, but it is not installed. '{lists}' needs this line before "
        f'ament_package():\n    install(DIRECTORY {relative.parts[0]} DESTINATION '
        f'share/${{PROJECT_NAME}})\nThen rebuild: {rebuild}'
    )


def _find_file(folder: Path, file_name: str) -> Path | None:
    for root, folders, names in os.walk(folder):
        folders[:] = sorted(name for name in folders if not name.startswith('.'))
        if file_name in names:
            return Path(root, file_name)
    return None
