# SPDX-License-Identifier: Apache-2.0
"""Resolution of the positional arguments to a launch file."""

from __future__ import annotations

import os
from typing import NoReturn

from ros2launch.api.share_files import get_share_file_path_from_package, MultipleLaunchFilesError

_SUFFIXES = ('.launch', '.py', '.xml', '.yaml', '.yml')


def find_target(
    package_or_path: str,
    file_name: str | None,
    arguments: list[str],
) -> tuple[str, list[str]]:
    """
    Find the launch file named by the positional arguments.

    Parameters
    ----------
    package_or_path
        The path of a launch file, which takes precedence if it exists, or the name of a package.
    file_name
        The name of a launch file of the package; after a path the first launch argument, if any.
    arguments : list[str]
        The launch arguments that follow.

    Returns
    -------
    tuple
        The path of the launch file, and all launch arguments.

    Raises
    ------
    RuntimeError
        There is no such file or package, or several files of the package have this name.

    """
    if os.path.isfile(package_or_path):
        first = [file_name] if file_name is not None else []
        return package_or_path, first + arguments
    if os.sep in package_or_path or package_or_path.endswith(_SUFFIXES):
        _refuse_file(package_or_path)
    return _find_in_package(package_or_path, file_name), list(arguments)


def _refuse_file(path: str) -> NoReturn:
    """Raise an error about a missing file."""
    from launch._missing_file import explain_missing_file

    lines = [explain_missing_file('launch file', path)]
    if not os.path.isabs(path) and not os.path.lexists(path):
        lines.append(f"It is looked up from '{os.getcwd()}'.")
    raise RuntimeError('\n'.join(lines))


def _find_in_package(package: str, file_name: str | None) -> str:
    from ros2pkg.api import PackageNotFoundError
    from ros2pkg.api.missing import missing_package_by_name

    try:
        return get_share_file_path_from_package(package_name=package, file_name=file_name)
    except PackageNotFoundError as error:
        raise RuntimeError(missing_package_by_name(package, str(error))) from error
    except FileNotFoundError as error:
        raise RuntimeError(_with_advice(str(error), package, file_name)) from error
    except MultipleLaunchFilesError as error:
        raise RuntimeError(str(error)) from error


def _with_advice(text: str, package: str, file_name: str | None) -> str:
    from ros2pkg.api import get_share_directory
    from ros_environment.workspace import explain_missing_share_file

    share = get_share_directory(package)
    return f'{text}\n{explain_missing_share_file(package, file_name or "", share)}'.rstrip()
