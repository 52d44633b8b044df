# SPDX-License-Identifier: Apache-2.0
"""Why an executable that the source tree suggests is not among the installed ones."""

from __future__ import annotations

from pathlib import Path

from ros_environment.setup_script import defines_main, read_setup_script, SetupScript
from ros_environment.source_tree import SourcePackage


def explain_source_executable(source: SourcePackage, executable: str, rebuild: str) -> str:
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


def misplaced_script(package: str, executable: str, prefix: Path) -> str:
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
