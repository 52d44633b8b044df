# SPDX-License-Identifier: Apache-2.0
"""Write docs/reference from what the commands say of themselves: `make docs`."""

from __future__ import annotations

import os
from pathlib import Path
import re
import subprocess

import displays
import launch_names
import node_parameters
from own_packages import is_own_package
import skills

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / 'docs' / 'reference'
NOTE = '<!-- Made by `make docs`; an edit here is overwritten. -->\n'
ENVIRONMENT = {**os.environ, 'COLUMNS': '100', 'TERM': 'dumb'}
TRANSFORM_PACKAGES = ('tf2_ros', 'tf2_py', 'tf2_geometry_msgs', 'tf2_sensor_msgs', 'tf2_tools')


def output(*command: str) -> str:
    """
    Return the output of a command, with the home folder and the workspace as variables.

    Parameters
    ----------
    *command
        The program and its arguments.

    Raises
    ------
    CalledProcessError
        The command fails.

    """
    text = subprocess.check_output(command, env=ENVIRONMENT, encoding='utf-8')
    return text.replace(str(ROOT), '$HUMANOID').replace(str(Path.home()), '~').strip('\n')


def block(text: str) -> str:
    """
    Format a text as a block of Markdown.

    Parameters
    ----------
    text
        What to show as it is.

    """
    return f'```text\n{text}\n```\n'


def listed(help_text: str) -> list[str]:
    """
    Extract the names that the help of `ros2`, or of a command, lists at its end, if any.

    Parameters
    ----------
    help_text
        What `--help` prints.

    """
    _, *listing = re.split('^Commands:$', help_text, flags=re.MULTILINE)
    return re.findall(r'^  (\w+)  ', ''.join(listing), flags=re.MULTILINE)


def commands_page() -> str:
    """Describe `ros2` and every verb of its commands."""
    parts = [NOTE, '# The `ros2` commands\n']
    for command in listed(output('ros2', '--help')):
        help_text = output('ros2', command, '--help')
        parts += [f'## ros2 {command}\n', block(help_text)]
        for verb in listed(help_text):
            help_of_verb = output('ros2', command, verb, '--help')
            parts += [f'### ros2 {command} {verb}\n', block(help_of_verb)]
    return '\n'.join(parts)


def launch_page() -> str:
    """Describe every launch file of the project's own packages and its arguments."""
    parts = [NOTE, '# The launch files\n']
    for path in sorted(ROOT.glob('src/*/launch/*.launch.*')):
        if not is_own_package(path.parents[1]):
            continue
        package = path.parents[1].name
        arguments = output('ros2', 'launch', package, path.name, '--show-args')
        parts += [f'## ros2 launch {package} {path.name}\n', block(arguments)]
    return '\n'.join(parts)


def names_page() -> str:
    """Describe the names that launch files use."""
    title = '# The names of launch files\n\nArguments with `=` may be left out.\n'
    return '\n'.join([NOTE, title, *launch_names.lines()])


def transforms_page() -> str:
    """Collect what of the interface of tf2 exists, from the tables of the packages."""
    parts = [NOTE, '# The packages for transforms\n']
    for package in TRANSFORM_PACKAGES:
        text = (ROOT / 'tools' / 'underlay' / package / 'README.md').read_text()
        tables = re.findall(r'(?:^\|.*\n)+', text, flags=re.MULTILINE)
        parts += [f'## {package}\n', *tables]
    return '\n'.join(parts)


def parameters_page() -> str:
    """Describe the parameters of the nodes."""
    return '\n'.join([NOTE, *node_parameters.lines()])


def displays_page() -> str:
    """Describe the displays, panels, tools and views of RViz in the browser."""
    return '\n'.join([NOTE, *displays.lines()])


def skills_page() -> str:
    """Describe what the robot can be asked for."""
    return '\n'.join([NOTE, *skills.lines(ROOT)])


def pages() -> dict[str, str]:
    """Return the text of each page by file name."""
    return {
        'commands.md': commands_page(),
        'displays.md': displays_page(),
        'launch_files.md': launch_page(),
        'launch_names.md': names_page(),
        'parameters.md': parameters_page(),
        'skills.md': skills_page(),
        'transforms.md': transforms_page(),
    }


def main() -> None:
    """Write the pages."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    for name, text in pages().items():
        (FOLDER / name).write_text(text)
        print(FOLDER / name)


if __name__ == '__main__':
    main()
