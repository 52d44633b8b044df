# SPDX-License-Identifier: Apache-2.0
"""Explain why a package, an executable or a file is missing, from the workspace at hand."""

from __future__ import annotations

from collections.abc import Iterable
import os
from pathlib import Path

from ros_environment import installed
from ros_environment.source_tree import (
    defines_main,
    find_workspace,
    read_setup_script,
    SetupScript,
    source_packages,
    SourcePackage,
)
from ros_environment.suggestions import did_you_mean, listing


def workspaces() -> list[Path]:
    """Return the workspace around the current folder, then those that have been sourced."""
    candidates = [installed.current_folder()]
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
                f"'{package}' is built in '{workspace}', but not sourced in this shell. "
                f'Run: {installed.source_command(workspace)}'
            )
        source = source_packages(workspace).get(package)
        if source:
            return (
                f"The source of '{package}' is in '{source.folder}', but it has not been "
                f'built. Run: {installed.build_command(workspace, package)}'
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
    lines = [_misplaced_script(package, executable, Path(prefix))]
    workspace, source = _find_source(package)
    if workspace and source and not lines[0]:
        rebuild = installed.build_command(workspace, package)
        lines.append(_explain_source_executable(source, executable, rebuild))
    text = f"'{package}' has no installed executables."
    if names:
        text = f"The executables of '{package}': {listing(names)}."
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
        rebuild = installed.build_command(workspace, package)
        lines.append(_explain_source_file(source, file_name, rebuild))
    text = f"'{package}' has no installed launch files."
    if names:
        text = f"The installed launch files of '{package}': {listing(names)}."
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
    rebuild = installed.build_command(workspace, source.name)
    return _explain_source_file(source, Path(path).name, rebuild)


def _explain_unknown_package(package: str) -> str:
    if not installed.prefixes():
        return (
            'AMENT_PREFIX_PATH contains no existing folder: neither a ROS 2 installation nor a '
            'workspace has been sourced. Run: source install/setup.bash'
        )
    waiting = installed.built_on_demand(package)
    if waiting:
        return f"'{package}' is not available yet: {waiting}"
    known = installed.known_packages()
    for workspace in workspaces():
        known.update(source_packages(workspace))
    places = ''.join(f", nor in the source tree of '{folder}'" for folder in workspaces())
    text = f'It is not in any folder of AMENT_PREFIX_PATH{places}.'
    return _with_suggestion(text, package, known)


def _find_source(package: str) -> tuple[Path, SourcePackage] | tuple[None, None]:
    for workspace in workspaces():
        source = source_packages(workspace).get(package)
        if source:
            return workspace, source
    return None, None


def _with_suggestion(text: str, name: str, known: Iterable[str]) -> str:
    return ' '.join(part for part in (text, did_you_mean(name, known)) if part)


def _explain_source_executable(source: SourcePackage, executable: str, rebuild: str) -> str:
    """
    Explain from the source of a package why it has no such executable.

    Parameters
    ----------
    source
        The package in the source tree.
    executable
        The name that was asked for, with or without `.py`.
    rebuild
        The command that builds the package.

    Returns
    -------
    str
        The explanation; '' if neither setup.py nor a module has such a name.

    """
    setup_py = source.folder / 'setup.py'
    script = read_setup_script(setup_py)
    if script is None:
        return ''
    if executable in script.scripts:
        return (
            f"'{setup_py}' declares '{executable}', but the installed package does not have "
            f'it yet. Rebuild: {rebuild}'
        )
    stem = executable[:-3] if executable.endswith('.py') else executable
    if not (source.folder / source.name / f'{stem}.py').is_file():
        return ''
    return _other_name(script, source, stem) or _missing_entry(script, source, stem, rebuild)


def _misplaced_script(package: str, executable: str, prefix: Path) -> str:
    """
    Explain an executable that was installed to `bin`, where `ros2 run` does not look.

    Parameters
    ----------
    package, executable
        The package, and the name that was asked for.
    prefix
        The install prefix of the package.

    Returns
    -------
    str
        The lines that setup.cfg lacks; '' if that is not the reason.

    """
    if not (prefix / 'bin' / executable).is_file() or (prefix / 'lib' / package).is_dir():
        return ''
    return (
        f"'{executable}' was installed to '{prefix / 'bin'}' instead of "
        f"'{prefix / 'lib' / package}', because setup.cfg lacks these lines:\n"
        f'    [develop]\n    script_dir=$base/lib/{package}\n'
        f'    [install]\n    install_scripts=$base/lib/{package}'
    )


def _other_name(script: SetupScript, source: SourcePackage, stem: str) -> str:
    """Return a sentence if the module's executable exists under another name."""
    target = f'{source.name}.{stem}:'
    names = [name for name, value in script.scripts.items() if value.startswith(target)]
    if not names:
        return ''
    return f"The module '{source.name}.{stem}' is the executable '{names[0]}' in setup.py."


def _missing_entry(script: SetupScript, source: SourcePackage, stem: str, rebuild: str) -> str:
    module = source.folder / source.name / f'{stem}.py'
    entry = f"'{stem} = {source.name}.{stem}:main',"
    if not script.has_console_scripts:
        entry = f"entry_points={{'console_scripts': [{entry[:-1]}]}},"
    place = "the list 'console_scripts' of" if script.has_console_scripts else 'setup() in'
    text = (
        f"The module '{module}' exists, but setup.py has no entry point for it. "
        f"Add this line to {place} '{source.folder / 'setup.py'}':\n    {entry}\n"
        f'Then rebuild: {rebuild}'
    )
    if defines_main(module):
        return text
    return f"{text}\nThe module also needs a function 'main()', which it does not define."


def _explain_source_file(source: SourcePackage, file_name: str, rebuild: str) -> str:
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
