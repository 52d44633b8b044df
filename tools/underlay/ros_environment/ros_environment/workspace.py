# SPDX-License-Identifier: Apache-2.0
"""Explain why a package, an executable or a file is missing, from the workspace at hand."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from ros_environment import advice, installed
from ros_environment.missing_executable import explain_source_executable, misplaced_script
from ros_environment.missing_file import explain_source_file
from ros_environment.source_tree import find_workspace, source_packages, SourcePackage


def workspaces() -> list[Path]:
    """Return the workspace around the current folder, then those that have been sourced."""
    candidates = [advice.current_folder()]
    candidates += [prefix.parent for prefix in installed.prefixes('COLCON_PREFIX_PATH')]
    found = (find_workspace(folder) for folder in candidates)
    return list(dict.fromkeys(folder for folder in found if folder))


def explain_missing_package(package: str) -> str:
    """
    Explain why a package is not found, with the command that helps.

    Parameters
    ----------
    package
        The name that was asked for.

    Returns
    -------
    str
        The explanation: the package is not sourced, not built, or unknown in the places searched.

    """
    for workspace in workspaces():
        if installed.is_installed_in(workspace / 'install', package):
            return (
                f"'{package}' is built in '{workspace}', but this shell does not know it. "
                f'Run: {advice.source_command(workspace)}'
            )
        source = source_packages(workspace).get(package)
        if source:
            return (
                f"The source of '{package}' is in '{source.folder}', but it has not been "
                f'built. Run: {advice.build_command(workspace, package)}'
            )
    return _explain_unknown_package(package)


def explain_missing_executable(package: str, executable: str, prefix: str) -> str:
    """
    Explain why a package has no such executable: entry point, rebuild or misspelling.

    Parameters
    ----------
    package, executable
        The package, which is installed, and the name that was asked for.
    prefix
        The install prefix of the package.

    Returns
    -------
    str
        One or more lines; the last one lists the executables that there are.

    """
    names = installed.executables(Path(prefix), package)
    lines = [misplaced_script(package, executable, Path(prefix))]
    workspace, source = _find_source(package)
    if workspace and source and not lines[0]:
        rebuild = advice.build_command(workspace, package)
        lines.append(explain_source_executable(source, executable, rebuild))
    text = f"'{package}' has no installed executables."
    if names:
        text = f"The executables of '{package}': {advice.listing(names)}."
    lines.append(_with_suggestion(text, executable, names))
    return '\n'.join(line for line in lines if line)


def explain_missing_share_file(package: str, file_name: str, share: str) -> str:
    """
    Explain why a package has no such launch file: data_files, rebuild or misspelling.

    Parameters
    ----------
    package, file_name
        The package, which is installed, and the name that was asked for.
    share
        The share folder of the package.

    Returns
    -------
    str
        One or more lines; the last one lists the launch files that there are.

    """
    names = installed.launch_files(Path(share))
    lines = []
    workspace, source = _find_source(package)
    if workspace and source:
        rebuild = advice.build_command(workspace, package)
        lines.append(explain_source_file(source, file_name, rebuild))
    text = f"'{package}' has no installed launch files."
    if names:
        text = f"The installed launch files of '{package}': {advice.listing(names)}."
    lines.append(_with_suggestion(text, file_name, names))
    return '\n'.join(line for line in lines if line)


def explain_uninstalled_file(path: str) -> str:
    """
    Explain how a missing file of an installed package gets there from its source.

    Parameters
    ----------
    path
        Where the file was looked for, in the share folder of the package.

    Returns
    -------
    str
        The explanation; '' if the package has no source here, or no file of that name.

    """
    package = installed.package_of_share_file(Path(path))
    workspace, source = _find_source(package) if package else (None, None)
    if not workspace or not source:
        return ''
    rebuild = advice.build_command(workspace, source.name)
    return explain_source_file(source, Path(path).name, rebuild)


def _explain_unknown_package(package: str) -> str:
    if not installed.prefixes():
        return (
            'AMENT_PREFIX_PATH names no folder: neither a ROS 2 installation nor a workspace '
            'has been sourced. Run: source install/setup.bash'
        )
    waiting = installed.built_on_demand(package)
    if waiting:
        return f"'{package}' belongs to what is not built yet: {waiting}"
    known = installed.known_packages()
    for workspace in workspaces():
        known.update(source_packages(workspace))
    places = ''.join(f", nor in the source tree of '{folder}'" for folder in workspaces())
    text = f'It is in none of the folders of AMENT_PREFIX_PATH{places}.'
    return _with_suggestion(text, package, known)


def _find_source(package: str) -> tuple[Path, SourcePackage] | tuple[None, None]:
    for workspace in workspaces():
        source = source_packages(workspace).get(package)
        if source:
            return workspace, source
    return None, None


def _with_suggestion(text: str, name: str, known: Iterable[str]) -> str:
    return ' '.join(part for part in (text, advice.did_you_mean(name, known)) if part)
