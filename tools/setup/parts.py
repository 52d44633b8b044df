# SPDX-License-Identifier: Apache-2.0
"""Wheels that only some parts of the robot need, which are installed on demand.

`make bringup` without navigation needs no OpenCV, and 190 MB less than everything. Missing
modules are replaced by stubs: importing one reports the command that installs it.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
import re
import sysconfig

from console import Steps
from locations import Locations
from stamp import digest, Stamp
import wheels

_HEADER = re.compile(r'^# \[(?P<name>\w+)\] words: (?P<words>.*); modules: (?P<modules>.*)$')
IN_PYTHON = """\
raise ImportError(
    '{sentence}',
    name='{name}',
)
"""


@dataclass(frozen=True)
class Part:
    """A part of the robot with its own wheels.

    words: a command whose arguments contain one of them needs the part; modules: the import names
    of its wheels; pins: the lines of its requirements.
    """

    name: str
    words: tuple[str, ...]
    modules: tuple[str, ...]
    pins: tuple[str, ...]

    def is_asked_for(self, arguments: str) -> bool:
        """
        Whether the arguments of a command name the part.

        Parameters
        ----------
        arguments : str
            All of them, separated by spaces; those that end in `:=false` are ignored.

        """
        given = [word for word in arguments.lower().split() if not word.endswith(':=false')]
        return any(word in each for word in self.words for each in given)


def read_parts(requirements: str) -> list[Part]:
    """
    Parse the parts of a requirements file, in which each starts with a line that names it.

    Parameters
    ----------
    requirements
        The text of the file.

    """
    found: list[tuple[re.Match[str], list[str]]] = []
    for line in requirements.splitlines():
        header = _HEADER.match(line)
        if header:
            found.append((header, []))
        elif found and line and not line.startswith('#'):
            found[-1][1].append(line)
    return [
        Part(
            header['name'], tuple(header['words'].split()), tuple(header['modules'].split()),
            tuple(pins),
        )
        for header, pins in found
    ]  # fmt: skip


class Parts:
    """
    The parts of a requirements file in an environment, each with a stamp once installed.

    Parameters
    ----------
    locations
        The workspace and its environment.
    requirements
        The file, which is read immediately.
    asked_for
        The arguments of the command, which may name parts.
    command
        The command that installs all parts of the file.

    """

    def __init__(
        self,
        locations: Locations,
        requirements: Path,
        asked_for: str = '',
        command: str = 'make setup',
    ) -> None:
        self._locations = locations
        self._asked_for, self._command = asked_for, command
        self._parts = read_parts(requirements.read_text(encoding='utf-8'))

    def to_install(self, *, everything: bool) -> list[Part]:
        """
        List the parts that are wanted or were installed before, and do not match their pins.

        Parameters
        ----------
        everything
            Whether all parts are wanted, instead of those that the command names.

        """
        return [
            part
            for part in self._parts
            if (everything or part.is_asked_for(self._asked_for) or self._stamp(part).exists())
            and not self._stamp(part).matches(_digest(part))
        ]

    def install(self, parts: list[Part], steps: Steps) -> None:
        """
        Install the wheels of parts and delete the stubs that reported them as missing.

        Parameters
        ----------
        parts
            The parts to install.
        steps
            Shows the progress.

        Raises
        ------
        SetupError
            The wheels of a part could not be installed.

        """
        folder = self._locations.environment / 'requirements'
        folder.mkdir(exist_ok=True)
        for part in parts:
            steps.note(f'what {part.name} needs')
            pins = folder / f'{part.name}.txt'
            pins.write_text('\n'.join(part.pins) + '\n', encoding='utf-8')
            wheels.install_wheels(self._locations, steps, sysconfig.get_path('include'), pins)
            for module in part.modules:
                stub = self._stub(module)
                if stub.with_suffix('').is_dir():
                    stub.unlink(missing_ok=True)
            self._stamp(part).write(_digest(part))

    def describe_others(self) -> None:
        """Write stubs for the modules of missing parts, which report how to install them."""
        packages = wheels.site_packages(self._locations)
        for part in self._parts:
            if self._stamp(part).exists():
                continue
            for module in part.modules:
                if (packages / module).is_dir() or self._stub(module).exists():
                    continue
                sentence = (
                    f'{module} is not installed yet, because only {part.name} needs it: run '
                    f'`{self._command}` in {self._locations.root}'
                )
                self._stub(module).write_text(
                    IN_PYTHON.format(sentence=sentence, name=module), encoding='utf-8'
                )

    def _stub(self, module: str) -> Path:
        return wheels.site_packages(self._locations) / f'{module}.py'

    def _stamp(self, part: Part) -> Stamp:
        return Stamp(self._locations.environment / 'stamp' / 'parts' / part.name)


def _digest(part: Part) -> str:
    return digest([], part.name, *part.pins)
